// SPDX-License-Identifier: MIT
// The library of cells: shapes that finite elements like, and stiffnesses with the symmetry of the
// drawing.
#include "homogenization/bracket/bending_bracket.h"
#include "homogenization/bracket/bracket.h"
#include "homogenization/lint/cell_reading.h"
#include "tests/homogenization/cell/cells.h"
#include "tests/homogenization/cell/shipped.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

using namespace homespun;
using namespace homespun::homogenization;
using tests::shipped;

namespace
{
/// What the drawing of a cell demands of C^H.
struct Symmetry
{
  const char *name;
  bool square; ///< C11 = C22
  double sign; ///< C16 = sign C26; both are zero where it is 0
  bool isotropic;
  double within; ///< of C11: how far the mesh is from the symmetry
};

const std::vector<Symmetry> symmetries = {
  {"plain-weave", true, 0., false, 1e-9},   {"twill", true, 1., false, 1e-9},
  {"satin", true, -1., false, 1e-9},        {"hexagonal-dots", true, 0., true, 2e-4},
  {"honeycomb", true, 0., true, 2e-3},      {"auxetic", false, 0., false, 5e-4},
  {"chevron", false, 0., false, 2e-4},      {"checkerboard", true, 0., false, 1e-9},
  {"printed-patch", false, 0., false, 2e-4}};

} // namespace

TEST(exact_shipped_cells, stiffness_has_the_symmetry_of_the_drawing)
{
  for (const Symmetry &symmetry : symmetries)
  {
    const Eigen::Matrix3d C = tests::solved(shipped(symmetry.name), 1).stiffness;
    const double within     = symmetry.within * C(0, 0);
    if (symmetry.square)
    {
      EXPECT_NEAR(C(0, 0), C(1, 1), within) << symmetry.name;
    }
    else
    {
      EXPECT_GT(std::abs(C(0, 0) - C(1, 1)), 0.05 * C(0, 0)) << symmetry.name;
    }
    EXPECT_NEAR(C(0, 2), symmetry.sign * C(1, 2), within) << symmetry.name;
    if (symmetry.sign == 0.)
    {
      EXPECT_NEAR(C(1, 2), 0., within) << symmetry.name;
    }
    if (symmetry.isotropic)
    {
      EXPECT_NEAR(C(2, 2), 0.5 * (C(0, 0) - C(0, 1)), within) << symmetry.name;
    }
    // Bow ties alone become wider when they are pulled.
    EXPECT_EQ(C(0, 1) < 0., std::string(symmetry.name) == "auxetic") << symmetry.name;
  }
}

TEST(exact_shipped_cells, floats_stiffen_a_weave_and_friction_alone_shears_it)
{
  double before = 0.;
  for (const char *name : {"plain-weave", "twill", "satin"}) // the fewer dives the stiffer
  {
    const Eigen::Matrix3d C = tests::solved(shipped(name), 1).stiffness;
    EXPECT_GT(C(0, 0), before) << name;
    EXPECT_LT(C(2, 2), 90.) << name; // G x thickness of all phases, the upper bound of Voigt
    before = C(0, 0);
  }
}

TEST(exact_shipped_cells, triangles_have_no_sharp_angles)
{
  for (const Symmetry &symmetry : symmetries)
    EXPECT_GT(tests::smallest_angle(shipped(symmetry.name).mesh), 25.) << symmetry.name;
  EXPECT_GT(tests::smallest_angle(shipped("random-dots").mesh), 25.);
}

TEST(exact_shipped_cells, a_checkerboard_of_one_bulk_modulus_obeys_duality)
{
  UnitCell cell  = shipped("checkerboard");
  const double t = cell.phases[0].thickness;
  cell.phases    = {isotropic("soft", 1e6, 0.5, t, 400.), isotropic("hard", 1.8e6, 0.1, t, 400.)};
  const Eigen::Matrix3d S = tests::solved(cell, 2).stiffness.inverse();
  const double E_axes     = 1. / S(0, 0) / t;
  const double E_diagonal = 4. / (2. * (S(0, 0) + S(0, 1)) + S(2, 2)) / t;
  // The mesh as shipped has a bracket of 1.5e-3.
  EXPECT_NEAR(E_axes * E_diagonal / (1e6 * 1.8e6), 1., 2e-3);
  EXPECT_GT(std::abs(E_axes / E_diagonal - 1.), 0.02); // or the product would say little
}

// Two solvers that share nothing: conjugate gradients, whose residual is that of the stiff dots,
// and factorization.
TEST(exact_shipped_cells, stiff_dots_in_a_soft_ground_are_solved_for_the_ground)
{
  UnitCell cell = shipped("random-dots");
  for (Phase &phase : cell.phases)
    if (phase.name == "dot")
      for (double *const modulus : {&phase.E1, &phase.E2, &phase.G12})
        *modulus *= 2e8; // 1e10 times the ground
  HomogenizationOptions options;
  options.order                      = 1;
  options.solver                     = CellSolver::multigrid;
  const Eigen::Matrix3d by_gradients = homogenize(cell, options, MPI_COMM_SELF).stiffness,
                        by_factors =
                          bracket(glued(cell.mesh, cell.lattice), cell.stiffness_of_phase(), 1)
                            .stiffness;
  EXPECT_LT(tests::relative_difference(by_gradients, by_factors), 1e-6);
}

TEST(bound_shipped_cells, bending_stiffness_has_both_sides_within_a_thousandth)
{
  std::map<std::string, Eigen::Matrix3d> upper;
  for (const auto &entry : std::filesystem::directory_iterator(CELLS))
  {
    if (entry.path().extension() != ".prm")
      continue;
    const UnitCell cell = read_unit_cell(entry.path().string());
    AdaptiveOptions options;
    options.tolerance                  = 1e-3;
    const AdaptiveBendingBracket found = adaptive_bending_bracket(
      glued(cell.mesh, cell.lattice, cell.curved_sides), cell.bending_stiffness_of_phase(), options,
      [](const BendingBracket &) {});
    EXPECT_EQ(found.ending, AdaptiveEnd::tolerance) << cell.name;
    EXPECT_LE(found.bracket.width, options.tolerance) << cell.name;
    upper[cell.name] = found.bracket.upper;
  }
  // Two sides of one thousandth apart: the bar of an entry D_ij of either is sqrt(D_ii D_jj)/1000.
  for (const Symmetry &symmetry : symmetries)
  {
    const Eigen::Matrix3d D = upper.at(symmetry.name);
    const double within     = (1e-3 + symmetry.within) * D.diagonal().maxCoeff();
    if (symmetry.square)
    {
      EXPECT_NEAR(D(0, 0), D(1, 1), 2. * within) << symmetry.name;
    }
    EXPECT_NEAR(D(0, 2), symmetry.sign * D(1, 2), 2. * within) << symmetry.name;
    if (symmetry.isotropic)
    {
      EXPECT_NEAR(D(2, 2), 0.5 * (D(0, 0) - D(0, 1)), 2. * within) << symmetry.name;
    }
  }
}
