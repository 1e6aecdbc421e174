// SPDX-License-Identifier: MIT
// The coarse cloth under the law of yarns: the same law as the reference's, in its solve, its
// forces and what is measured beside it.
#include "tests/homogenization/cell/cells.h"
#include "verification/method/coarse_model.h"
#include "verification/method/fluctuation.h"
#include "verification/method/sheet_reading.h"
#include "verification/reference/fine_reference.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr double side = 1e-3;

/// A cell of two triangles of one yarn, E/G = 1000, the one of its axes that is stiffer at an
/// angle.
homogenization::UnitCell one_yarn(const double degrees)
{
  homogenization::Phase yarn = homogenization::isotropic("yarn", 1e9, 0.02, 1e-4, 1e3);
  yarn.E2                    = 0.8e9;
  yarn.G12                   = 1e6;
  yarn.angle                 = degrees;
  return tests::cell_of(tests::square_lattice(side), 1, 1, {yarn},
                        [](double, double) { return 0; });
}

/// Of one phase, so that C^H is its stiffness.
meshes::HomogenizedCell homogenized(const homogenization::UnitCell &cell)
{
  return homogenization::homogenized_cell(cell, tests::solved(cell), "test");
}
} // namespace

TEST(exact_yarn_cloth, only_a_stiffness_with_axes_has_the_law_and_only_against_it)
{
  const Eigen::Matrix3d woven = one_yarn(10.).stiffness_of_phase().front();
  const Eigen::Matrix3d alike =
    homogenization::plane_stress_stiffness(homogenization::isotropic("alike", 1e9, 0.3, 1e-4, 1.));
  EXPECT_EQ(homogenized_law(Law::yarn, woven), Law::yarn);
  EXPECT_EQ(homogenized_law(Law::yarn, alike), Law::biot);
  EXPECT_EQ(homogenized_law(Law::linear, woven), Law::linear);
  EXPECT_EQ(homogenized_law(Law::biot, woven), Law::biot);
  EXPECT_EQ(homogenized_law(Law::green, woven), Law::biot);
}

// One phase and one mesh: the resolved sheet is the coarse cloth, and codes written apart must find
// the same positions and the same forces.
TEST(exact_yarn_cloth, of_one_phase_it_is_the_reference_itself)
{
  for (const double degrees : {0., 20.})
  {
    const homogenization::UnitCell cell  = one_yarn(degrees);
    const meshes::HomogenizedCell as_one = homogenized(cell);
    for (const char *name : {"strip-1", "strip-2", "shear-frame", "uniaxial-1", "uniaxial-2"})
    {
      const Load load(name);
      const int n               = load.is_periodic() ? 1 : 4;
      const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
      const CoarseModel cloth({as_one}, sheet, load, Method("localized"), Law::yarn);
      ReferenceOptions options;
      options.tolerance = 1e-11;
      FineReference reference(sheet, cell.stiffness_of_phase(), options, MPI_COMM_SELF);
      reference.start(load, Law::yarn);
      for (const double strain : {0.01, 0.05})
      {
        const CoarseState coarse = cloth.solve(strain);
        const ReferenceStep fine = reference.advance(strain);
        ASSERT_TRUE(fine.reached) << fine.why;
        const meshes::Points localized = cloth.upsample(coarse);
        EXPECT_LT((localized - fine.positions).cwiseAbs().maxCoeff(), 1e-7 * side)
          << name << degrees << " " << strain;
        const Eigen::Matrix2d stress = fine.forces.stress;
        EXPECT_LT((cloth.forces(coarse).stress - stress).norm(), 1e-6 * stress.norm())
          << name << degrees << " " << strain;
      }
    }
  }
}

TEST(derivative_yarn_cloth, its_forces_are_those_of_its_energy)
{
  const homogenization::UnitCell cell  = one_yarn(20.);
  const meshes::HomogenizedCell as_one = homogenized(cell);
  const Load load("strip-1");
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 4, 4);
  const CoarseModel cloth({as_one}, sheet, load, Method("localized"), Law::yarn);
  const CoarseState step   = cloth.solve(0.05);
  shell::Membrane membrane = shell::membrane(cloth.mesh(), {as_one.stiffness});
  shell::take_yarn_law(membrane);
  const double part = 1e-4, ahead = (1. + part) * 0.05, behind = (1. - part) * 0.05;
  const auto energy = [&](const double strain)
  { return shell::membrane_energy<2>(membrane, cloth.solve(strain, &step).positions); };
  const double slope = (energy(ahead) - energy(behind)) / (ahead - behind);
  const double force = force_along(load, sheet.sides(), cloth.forces(step));
  EXPECT_NEAR(force, slope / load.displacement({1., 1.}, sheet.sides(), 1.).norm(), 1e-6 * force);
}

// A sheet of one stiffness does not fluctuate, pulled far beyond where the corotational cloth is a
// law; what is found is the discretization of the measure, which its bar covers.
TEST(bound_yarn_cloth, beside_it_a_homogeneous_sheet_does_not_fluctuate)
{
  const homogenization::UnitCell cell  = one_yarn(0.);
  const meshes::HomogenizedCell as_one = homogenized(cell);
  const Load load("strip-1");
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 4, 4);
  const Quads quads         = quads_per_cell(sheet, 8);
  const CoarseModel resolved({as_one}, sheet, load, Method("affine"), Law::yarn, quads);
  const shell::Positions<2> solved = resolved.solve(0.05).positions;
  FluctuationMeasure measure(as_one, sheet, load);
  const Fluctuation found = measure.at(
    Law::yarn, 0.05, SheetReading(sheet, quads).at_fine_vertices(Law::yarn, solved).positions);
  EXPECT_GT(found.mean, 0.);
  EXPECT_LE(found.mean, found.bar);
  EXPECT_LE(found.mean, 1e-2 * 0.05 * side); // a hundredth of strain x cell side
}
