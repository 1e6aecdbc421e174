// SPDX-License-Identifier: MIT
// The rows of strain.csv that one level leaves, by hand; and a method that has no equilibrium.
#include "homogenization/edges/edge_layers.h"
#include "meshes/files/temporary_folder.h"
#include "tests/homogenization/cell/cells.h"
#include "tests/verification/method/models.h"
#include "verification/strain/strain_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr double small_strain = 0.01;

/// Stripes of contrast 10 along the first axis.
homogenization::UnitCell stripes(const meshes::Lattice &lattice)
{
  return tests::cell_of(lattice, 4, 4,
                        {homogenization::isotropic("soft", 1e6, 0.3, 5e-4, 1.),
                         homogenization::isotropic("hard", 1e7, 0.3, 5e-4, 1.)},
                        [](double, const double y) { return y > 0.5; });
}

/// A level of the shear frame, 4 x 4 cells under `biot`, whose reference stands a given distance
/// from what `affine` says.
struct Level
{
  Level(const meshes::Lattice &lattice, std::vector<std::string> methods,
        const double slip_factor = 1.)
      : cell(stripes(lattice))
      , homogenized(homogenization::homogenized_cell(cell, tests::solved(cell), "test"))
      , edges{homogenization::edges_of(cell, {}), ""}
      , sheet(meshes::tile(cell.mesh, cell.lattice, 4, 4))
      , load("shear-frame")
      , folder(testing::TempDir())
  {
    for (meshes::CellEdge &edge : edges.edges->sides)
      edge.slip *= slip_factor;
    options.methods    = std::move(methods);
    options.references = {"biot"};
    options.loads      = {load.name};
    options.strains    = {small_strain};
    options.output     = folder.path;
    options.budget = options.run_time = false;
    std::filesystem::create_directory(folder.path + "/" + cell.name);
  }

  /// @param away of every vertex of the reference from `affine` [m]
  void compare(const Eigen::RowVector2d &away)
  {
    StrainOutput output(options, [&](const std::string &note) { notes.push_back(note); });
    MethodsOnSheet methods = methods_on_sheet(cell, homogenized, edges, sheet, load);
    ReferenceStep fine;
    fine.positions =
      tests::upsampled("affine", {homogenized}, sheet, load, Law::biot, small_strain);
    fine.positions.rowwise() += away;
    compare_methods(options, {cell.name, load.name, Law::biot, small_strain},
                    {sheet, fine, 0, 1, {}, Stability::every_triangle, 0.}, methods, output);
    rows = output.strain.rows();
  }

  const homogenization::UnitCell cell;
  const meshes::HomogenizedCell homogenized;
  KnownEdges edges;
  const meshes::Sheet sheet;
  const Load load;
  const meshes::TemporaryFolder folder;
  StrainStudyOptions options;
  std::vector<StrainRow> rows;
  std::vector<std::string> notes;
};
} // namespace

TEST(exact_strain_comparison, errors_are_distances_in_metres_and_in_cell_sides)
{
  Level level(tests::skewed_lattice(), {"affine", "localized"});
  level.compare({3e-5, 4e-5});
  ASSERT_EQ(level.rows.size(), 2u);
  const StrainRow &affine = level.rows.front();
  EXPECT_EQ(affine.method, "affine");
  for (const double error : {affine.mean, affine.rms, affine.max})
    EXPECT_NEAR(error, 5e-5, 1e-15);
  const double side = std::sqrt(0.01 * 0.012 - 0.001 * 0.004); // the root of the area
  EXPECT_NEAR(affine.per_cell, 5e-5 / side, 1e-12);
  EXPECT_GT(level.rows.back().mean, 0.);
}

// Clamped edges that slip by far more than the sheet is wide: from 1e5 on, of either sign, there is
// no equilibrium that the solver finds.
TEST(exact_strain_comparison, a_method_without_equilibrium_leaves_only_its_own_row_without_errors)
{
  Level level(tests::square_lattice(0.01), {"affine", "localized", "localized+edges"}, 1e7);
  level.compare({1e-5, 0.});
  ASSERT_EQ(level.rows.size(), 3u);
  for (const StrainRow &row : level.rows)
  {
    EXPECT_TRUE(row.is_reached()) << row.method;
    EXPECT_EQ(std::isnan(row.mean), row.method == "localized+edges") << row.method << row.mean;
  }
  EXPECT_EQ(std::count_if(level.notes.begin(), level.notes.end(),
                          [](const std::string &note)
                          {
                            return note.find("method localized+edges: its coarse cloth finds no "
                                             "equilibrium") != std::string::npos;
                          }),
            1);
}
