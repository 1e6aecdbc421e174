// SPDX-License-Identifier: MIT
// Files say which format they have; newer ones are refused by name, older ones read.
#include "meshes/files/format_version.h"

#include "meshes/files/cell_file.h"
#include "meshes/files/hdf5_reader.h"
#include "meshes/files/state_file.h"
#include "meshes/plain/errors.h"
#include "tests/meshes/plain/plain_cell.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <hdf5.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

namespace homespun::meshes
{
namespace
{
/// A file of this process alone.
const std::string file = (std::filesystem::temp_directory_path() /
                          ("homespun-format-version-" + std::to_string(::getpid()) + ".h5"))
                           .string();

const struct Removed
{
  ~Removed()
  {
    std::filesystem::remove(file);
  }
} removed;

HomogenizedCell written_cell()
{
  HomogenizedCell cell = tests::plain_cell(tests::skewed_lattice(), 1, 1);
  write_cell(cell, file);
  return cell;
}

/// Replaces the attribute by others: none, or so many integers.
void plant(const std::vector<int> &versions)
{
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Adelete(id, "format_version");
  if (!versions.empty())
  {
    const hsize_t n   = versions.size();
    const hid_t space = H5Screate_simple(1, &n, nullptr);
    const hid_t attribute =
      H5Acreate2(id, "format_version", H5T_NATIVE_INT, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_INT, versions.data());
    H5Aclose(attribute);
    H5Sclose(space);
  }
  H5Fclose(id);
}

std::string refused()
{
  return tests::refusal([]() { read_cell(file); });
}
} // namespace

TEST(exact_format_version, every_file_says_its_own)
{
  written_cell();
  EXPECT_EQ(Hdf5Reader(file, "a cell").integer_attribute("/", "format_version"), format_version);
  ClothState state;
  state.positions.setZero(3, 3);
  state.velocities.setZero(3, 3);
  state.run = "a";
  write_state(state, file);
  EXPECT_EQ(Hdf5Reader(file, "a state").integer_attribute("/", "format_version"), format_version);
}

TEST(exact_format_version, a_file_without_one_is_read)
{
  const HomogenizedCell cell = written_cell();
  plant({});
  EXPECT_EQ(read_cell(file).stiffness, cell.stiffness);
  plant({0});
  EXPECT_EQ(read_cell(file).stiffness, cell.stiffness);
}

TEST(tripwire_format_version, a_newer_file_is_refused_with_both_numbers_and_what_to_do)
{
  written_cell();
  plant({format_version + 1});
  const std::string text = refused();
  EXPECT_NE(text.find(file + ": found format_version " + std::to_string(format_version + 1) +
                      "; expected at most " + std::to_string(format_version)),
            std::string::npos)
    << text;
  EXPECT_NE(text.find("a newer homespun wrote the file"), std::string::npos) << text;
}

TEST(tripwire_format_version, what_is_no_version_is_refused)
{
  written_cell();
  plant({-1});
  EXPECT_NE(refused().find("found format_version -1; expected a whole number from 0 to"),
            std::string::npos);
  plant({1, 1});
  EXPECT_NE(refused().find("found format_version that is no single number; expected a whole"),
            std::string::npos);
}
} // namespace homespun::meshes
