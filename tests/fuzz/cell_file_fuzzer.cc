// SPDX-License-Identifier: MIT
// A sound cell.h5, a checkpoint at the same time, whose datasets and attributes are replaced, as
// the bytes say, by others of any kind, shape and content. HDF5 itself is not under test: what it
// is handed is always a well-formed file.
#include "meshes/files/cell_file.h"
#include "meshes/files/state_file.h"
#include "tests/fuzz/input_file.h"
#include "tests/meshes/plain/plain_cell.h"

#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include <hdf5.h>
#include <hdf5_hl.h>

using namespace homespun;

namespace
{
/// The bytes of an input one by one, zeros after the last.
class Bytes
{
public:
  Bytes(const std::uint8_t *data, const std::size_t size)
      : data(data)
      , end(data + size)
  {
  }

  unsigned int next()
  {
    return data == end ? 0 : *data++;
  }

  bool is_empty() const
  {
    return data == end;
  }

private:
  const std::uint8_t *data, *const end;
};

/// A file that is a cell of 9 vertices, and a checkpoint of 9 vertices too.
std::vector<std::uint8_t> sound_file()
{
  meshes::HomogenizedCell cell = tests::plain_cell(tests::square_lattice(0.01), 2, 2);
  cell.provenance              = "made for the fuzzer";
  const tests::InputFile of_cell(nullptr, 0, "-cell.h5"), of_state(nullptr, 0, "-state.h5");
  meshes::write_cell(cell, of_cell.name);
  meshes::ClothState state;
  state.positions.setZero(9, 3);
  state.velocities.setZero(9, 3);
  state.step_seconds = {1.};
  state.run          = "a run";
  meshes::write_state(state, of_state.name);
  // One file that is both.
  const hid_t both = H5Fopen(of_cell.name.c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
              from = H5Fopen(of_state.name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  for (const char *const name : {"/positions", "/velocities", "/step_seconds"})
    H5Ocopy(from, name, both, name, H5P_DEFAULT, H5P_DEFAULT);
  H5LTset_attribute_string(both, "/", "run", "a run");
  H5LTset_attribute_double(both, "/", "time", &state.time, 1);
  H5LTset_attribute_int(both, "/", "frame", &state.frame, 1);
  H5Fclose(from);
  H5Fclose(both);
  std::ifstream bytes(of_cell.name, std::ios::binary);
  return {std::istreambuf_iterator<char>(bytes), std::istreambuf_iterator<char>()};
}

hid_t some_type(const unsigned int choice)
{
  static const hid_t text =
                       []()
  {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 8);
    return type;
  }(),
                     of_any_length = []()
  {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    return type;
  }();
  const std::array<hid_t, 6> types = {H5T_NATIVE_DOUBLE, H5T_NATIVE_INT,   H5T_NATIVE_FLOAT,
                                      H5T_NATIVE_INT64,  H5T_NATIVE_UINT8, text};
  return choice % 8 == 7 ? of_any_length : types[choice % types.size()];
}

/// Small shapes that may fit, and now and then one that no memory holds.
hid_t some_space(Bytes &bytes)
{
  static constexpr std::array<hsize_t, 10> sizes = {9, 8, 3, 2, 1, 0, 4, 6, 100, 1ull << 40};
  const unsigned int rank                        = bytes.next() % 5;
  std::array<hsize_t, 4> shape                   = {};
  for (unsigned int k = 0; k < rank; ++k)
    shape[k] = sizes[bytes.next() % sizes.size()];
  return rank == 0 ? H5Screate(H5S_SCALAR)
                   : H5Screate_simple(static_cast<int>(rank), shape.data(), nullptr);
}

/// As many bytes as a space of a type needs, up to a megabyte; nothing beyond, and nothing for
/// texts of any length.
std::vector<std::uint8_t> some_content(Bytes &bytes, const hid_t type, const hid_t space)
{
  const auto n = static_cast<double>(H5Sget_simple_extent_npoints(space)) *
                 static_cast<double>(H5Tget_size(type));
  if (n > 1e6 || H5Tis_variable_str(type) > 0)
    return {};
  std::vector<std::uint8_t> content(static_cast<std::size_t>(n));
  for (std::uint8_t &byte : content)
    byte = static_cast<std::uint8_t>(bytes.next());
  return content;
}

void replace_dataset(const hid_t file, const char *const name, Bytes &bytes)
{
  H5Ldelete(file, name, H5P_DEFAULT);
  const unsigned int kind = bytes.next() % 8;
  if (kind == 0)
    return;
  if (kind == 1)
  {
    H5Lcreate_external("/etc/hostname", "/x", file, name, H5P_DEFAULT, H5P_DEFAULT);
    return;
  }
  if (kind == 2)
  {
    H5Lcreate_soft("/C", file, name, H5P_DEFAULT, H5P_DEFAULT);
    return;
  }
  const hid_t type = some_type(bytes.next()), space = some_space(bytes),
              properties                  = H5Pcreate(H5P_DATASET_CREATE);
  const std::vector<std::uint8_t> content = some_content(bytes, type, space);
  if (kind == 3)
    H5Pset_external(properties, "/etc/passwd", 0, H5F_UNLIMITED);
  const hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  if (dataset >= 0 && !content.empty() && kind != 3)
    H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, content.data());
  if (dataset >= 0)
    H5Dclose(dataset);
  H5Pclose(properties);
  H5Sclose(space);
}

void replace_attribute(const hid_t file, const std::array<const char *, 2> &of, Bytes &bytes)
{
  const auto [object, name] = of;
  H5Adelete_by_name(file, object, name, H5P_DEFAULT);
  const hid_t type = some_type(bytes.next()), space = some_space(bytes);
  const std::vector<std::uint8_t> content = some_content(bytes, type, space);
  const hid_t attribute =
    H5Acreate_by_name(file, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (attribute >= 0 && !content.empty())
    H5Awrite(attribute, type, content.data());
  if (attribute >= 0)
    H5Aclose(attribute);
  H5Sclose(space);
}
} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const std::vector<std::uint8_t> sound = sound_file();
  const tests::InputFile input(sound.data(), sound.size(), ".h5");
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t file = H5Fopen(input.name.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  tests::must_hold(file >= 0, "the sound file is there");
  static constexpr std::array<const char *, 12> datasets = {
    "/vertices",      "/triangles", "/material",   "/lattice",      "/chi", "/C",
    "/areal_density", "/positions", "/velocities", "/step_seconds", "/D",   "/deflection"};
  static constexpr std::array<std::array<const char *, 2>, 5> attributes = {
    {{"/chi", "anchor"}, {"/", "provenance"}, {"/", "run"}, {"/", "time"}, {"/", "frame"}}};
  for (Bytes bytes(data, size); !bytes.is_empty();)
  {
    const std::size_t which = bytes.next() % (datasets.size() + attributes.size());
    if (which < datasets.size())
      replace_dataset(file, datasets[which], bytes);
    else
      replace_attribute(file, attributes[which - datasets.size()], bytes);
  }
  H5Fclose(file);
  tests::read_or_refuse(
    [&]()
    {
      const meshes::HomogenizedCell cell = meshes::read_cell(input.name);
      tests::must_hold(cell.chi.allFinite() && cell.stiffness.allFinite() &&
                         cell.mesh.vertices.allFinite() && cell.lattice.vectors.allFinite(),
                       "a cell is finite");
      tests::must_hold(!cell.bending || (cell.bending->stiffness.allFinite() &&
                                         cell.bending->deflection.allFinite() &&
                                         cell.bending->deflection.rows() == cell.mesh.n_vertices()),
                       "a cell bends by finite numbers");
      tests::must_hold(cell.chi.rows() == cell.mesh.n_vertices() && cell.anchor >= 0 &&
                         cell.anchor < cell.mesh.n_vertices(),
                       "a cell's shapes agree");
    });
  tests::read_or_refuse(
    [&]()
    {
      const auto state = meshes::read_state(input.name, 9, "a run");
      tests::must_hold(state && state->positions.rows() == 9 && state->positions.allFinite() &&
                         state->velocities.rows() == 9 && state->velocities.allFinite() &&
                         std::isfinite(state->time) && state->frame >= 0,
                       "a state is sound");
    });
  return 0;
}
