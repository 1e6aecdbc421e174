// SPDX-License-Identifier: MIT
#include "meshes/files/cell_file.h"
#include "meshes/files/hdf5_reader.h"
#include "meshes/plain/errors.h"
#include "tests/meshes/files/temporary.h"
#include "tests/meshes/plain/plain_cell.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

using namespace homespun;
using namespace homespun::meshes;

namespace
{
HomogenizedCell some_cell()
{
  HomogenizedCell cell = tests::plain_cell(tests::skewed_lattice(), 3, 2);
  cell.mesh.material << 0, 1, 0, 1, 0, 1, 2, 2, 2, 2, 0, 0;
  for (Eigen::Index k = 0; k < cell.chi.size(); ++k)
    cell.chi.data()[k] = 1e-5 * static_cast<double>(k * k);
  cell.chi.rowwise() -= Eigen::Matrix<double, 1, 6>(cell.chi.row(0));
  cell.stiffness << 5., 1., 0.1, 1., 4., 0.2, 0.1, 0.2, 1.;
  cell.provenance   = "made for a test";
  cell.place_of_cut = "half of a side away from where it is drawn";
  return cell;
}

HomogenizedCell bent_cell()
{
  HomogenizedCell cell = some_cell();
  CellBendingModes bending;
  bending.stiffness << 5e-6, 1e-6, 1e-7, 1e-6, 4e-6, 2e-7, 1e-7, 2e-7, 1e-6;
  bending.deflection.setRandom(cell.mesh.n_vertices(), 3);
  cell.bending = bending;
  return cell;
}

HomogenizedCell second_order_cell()
{
  HomogenizedCell cell = some_cell();
  for (const char *law : {"biot", "green"})
  {
    SecondOrder &second = cell.second_order[law];
    second.energy.derivatives.setRandom();
    second.chi.setRandom(cell.mesh.n_vertices(), 12);
    second.chi.rowwise() -= Eigen::Matrix<double, 1, 12>(second.chi.row(0));
  }
  return cell;
}

/// The text of the refusal, empty where the file was read.
std::string refusal(const std::string &file)
{
  try
  {
    read_cell(file);
    return "";
  }
  catch (const BadInput &fault)
  {
    return fault.what();
  }
}
} // namespace

TEST(exact_cell_file, a_cell_comes_back_as_it_was_written)
{
  const HomogenizedCell cell = some_cell();
  const std::string file     = tests::temporary("round-trip.h5");
  write_cell(cell, file);
  const HomogenizedCell back = read_cell(file);
  EXPECT_EQ(back.mesh.vertices, cell.mesh.vertices);
  EXPECT_EQ(back.mesh.triangles, cell.mesh.triangles);
  EXPECT_EQ(back.mesh.material, cell.mesh.material);
  EXPECT_EQ(back.lattice.vectors, cell.lattice.vectors);
  EXPECT_EQ(back.chi, cell.chi);
  EXPECT_EQ(back.anchor, cell.anchor);
  EXPECT_EQ(back.stiffness, cell.stiffness);
  EXPECT_EQ(back.areal_density, cell.areal_density);
  EXPECT_EQ(back.provenance, cell.provenance);
  EXPECT_EQ(back.place_of_cut, cell.place_of_cut);
  EXPECT_FALSE(back.bending.has_value()); // files of versions that did not know it
  EXPECT_FALSE(std::filesystem::exists(file + ".part"));
}

// Other programs read the file: vertex, component, then load or product of loads.
TEST(exact_cell_file, modes_stand_in_the_file_as_it_says)
{
  const HomogenizedCell cell = second_order_cell();
  const std::string path     = tests::temporary("layout.h5");
  write_cell(cell, path);
  const Hdf5Reader file(path, "a cell");
  const auto n        = static_cast<unsigned long long>(cell.mesh.n_vertices());
  const auto chi      = file.numbers("/chi", {n, 2, 3});
  const auto products = file.numbers("/chi_quadratic/biot", {n, 2, 6});
  for (std::size_t v = 0; v < n; ++v)
    for (std::size_t component = 0; component < 2; ++component)
    {
      const auto row = static_cast<Eigen::Index>(v);
      for (std::size_t load = 0; load < 3; ++load)
        EXPECT_EQ(chi[(2 * v + component) * 3 + load],
                  cell.chi(row, static_cast<Eigen::Index>(2 * load + component)));
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_EQ(
          products[(2 * v + component) * 6 + k],
          cell.second_order.at("biot").chi(row, static_cast<Eigen::Index>(2 * k + component)));
    }
}

TEST(exact_cell_file, second_order_comes_back_as_it_was_written)
{
  const HomogenizedCell cell = second_order_cell();
  const std::string file     = tests::temporary("second-order.h5");
  write_cell(cell, file);
  const HomogenizedCell back = read_cell(file);
  ASSERT_EQ(back.second_order.size(), 2u);
  for (const char *law : {"biot", "green"})
  {
    EXPECT_EQ(back.second_order.at(law).energy.derivatives,
              cell.second_order.at(law).energy.derivatives);
    EXPECT_EQ(back.second_order.at(law).chi, cell.second_order.at(law).chi);
  }
  // Absent in files of versions that did not know it.
  write_cell(some_cell(), file);
  EXPECT_TRUE(read_cell(file).second_order.empty());
}

TEST(exact_cell_file, a_second_order_that_is_not_whole_is_refused_by_name)
{
  HomogenizedCell cell                                = second_order_cell();
  cell.second_order.at("green").energy.derivatives(3) = std::numeric_limits<double>::quiet_NaN();
  cell.second_order.at("biot").chi.row(0).setOnes();
  const std::string file = tests::temporary("second-order-faults.h5");
  try
  {
    write_cell(cell, file);
    FAIL() << "written";
  }
  catch (const std::logic_error &fault)
  {
    EXPECT_NE(std::string(fault.what()).find("/W3/green holds values"), std::string::npos);
    EXPECT_NE(std::string(fault.what()).find("/chi_quadratic/biot is not zero"), std::string::npos);
  }
}

TEST(exact_cell_file, bending_comes_back_as_it_was_written)
{
  const HomogenizedCell cell = bent_cell();
  const std::string file     = tests::temporary("bent.h5");
  write_cell(cell, file);
  const HomogenizedCell back = read_cell(file);
  ASSERT_TRUE(back.bending.has_value());
  EXPECT_EQ(back.bending->stiffness, cell.bending->stiffness);
  EXPECT_EQ(back.bending->deflection, cell.bending->deflection);
}

TEST(tripwire_cell_file, every_truncation_is_refused_by_name)
{
  const std::string whole = tests::temporary("whole.h5"), cut = tests::temporary("cut.h5");
  write_cell(some_cell(), whole);
  const auto size = std::filesystem::file_size(whole);
  for (const double part : {0., 0.01, 0.3, 0.6, 0.9, 0.99})
  {
    std::filesystem::copy_file(whole, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut,
                                 static_cast<std::uintmax_t>(part * static_cast<double>(size)));
    EXPECT_NE(refusal(cut).find("cut.h5: is not a readable HDF5 file"), std::string::npos) << part;
  }
}

TEST(tripwire_cell_file, a_file_of_another_kind_and_an_absent_one_are_refused)
{
  const std::string text = tests::temporary("text.h5");
  std::ofstream(text) << "not HDF5\n";
  EXPECT_NE(refusal(text).find("not a readable HDF5 file"), std::string::npos);
  EXPECT_NE(refusal(tests::temporary("absent.h5")).find("no such file"), std::string::npos);
}

TEST(tripwire_cell_file, values_that_no_cell_has_are_not_written)
{
  const std::string file = tests::temporary("bad.h5");
  std::filesystem::remove(file);
  HomogenizedCell not_finite = some_cell();
  not_finite.chi(2, 3)       = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_cell(not_finite, file), std::logic_error);
  HomogenizedCell indefinite = some_cell();
  indefinite.stiffness(2, 2) = -1.;
  EXPECT_THROW(write_cell(indefinite, file), std::logic_error);
  HomogenizedCell bends_for_nothing          = bent_cell();
  bends_for_nothing.bending->stiffness(1, 1) = 0.;
  EXPECT_THROW(write_cell(bends_for_nothing, file), std::logic_error);
  HomogenizedCell not_everywhere = bent_cell();
  not_everywhere.bending->deflection.conservativeResize(2, 3);
  EXPECT_THROW(write_cell(not_everywhere, file), std::logic_error);
  HomogenizedCell not_anchored = some_cell();
  not_anchored.anchor          = 1;
  EXPECT_THROW(write_cell(not_anchored, file), std::logic_error);
  HomogenizedCell of_no_phase  = some_cell();
  of_no_phase.mesh.material(0) = -1;
  EXPECT_THROW(write_cell(of_no_phase, file), std::logic_error);
  HomogenizedCell without_bulk = some_cell();
  without_bulk.edges           = CellEdges();
  without_bulk.edges->bulk[1].setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(write_cell(without_bulk, file), std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_FALSE(std::filesystem::exists(file + ".part"));
}
