// SPDX-License-Identifier: MIT
// The cell at second order in strain against the cell at finite strain, which is solved by Newton's
// method in a code of its own: fluctuation and stress of an infinite cloth.
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "verification/periodic_cell/nonlinear_cell.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;
using homogenization::UnitCell;
using meshes::Law;

namespace
{
meshes::HomogenizedCell homogenized(const UnitCell &cell)
{
  homogenization::HomogenizationOptions options;
  options.order        = 1; // as the cell at finite strain
  options.tolerance    = 1e-13;
  options.second_order = {Law::biot, Law::green};
  return homogenization::homogenized_cell(
    cell, homogenization::homogenize(cell, options, MPI_COMM_WORLD), "");
}

/// Relative errors of the first and of the second order.
struct Errors
{
  double first, second;
};

struct StateErrors
{
  Errors fluctuation, stress;
};

StateErrors errors_of(const meshes::HomogenizedCell &cell, const UnitCell &given, const Law law,
                      const Eigen::Vector3d &strain)
{
  const CellState exact = NonlinearCell(cell, given.stiffness_of_phase(), law).solve(strain);
  const meshes::SecondOrder &second         = cell.second_order.at(name_of(law));
  const Eigen::Matrix<double, 6, 1> factors = meshes::quadratic_factors(strain);
  meshes::Points first_w = meshes::Points::Zero(cell.mesh.n_vertices(), 2), second_w;
  for (int a = 0; a < 3; ++a)
    first_w -= strain(a) * cell.chi.middleCols<2>(2 * a);
  second_w = first_w;
  for (int k = 0; k < 6; ++k)
    second_w -= factors(k) * second.chi.middleCols<2>(2 * k);
  const auto relative = [](const auto &found, const auto &expected)
  { return (found - expected).norm() / expected.norm(); };
  const Eigen::Vector3d first_stress = cell.stiffness * strain;
  return {{relative(first_w, exact.fluctuation), relative(second_w, exact.fluctuation)},
          {relative(first_stress, exact.stress),
           relative((first_stress + second.energy.gradient(strain)).eval(), exact.stress)}};
}

const Eigen::Vector3d oblique(1., -0.3, 0.5);
} // namespace

UnitCell shipped(const char *name)
{
  return homogenization::read_unit_cell(std::string(CELLS) + name + ".prm", MPI_COMM_WORLD);
}

// Errors are relative, so that the orders of theory are 1 and 2 here: those of displacement and
// stress themselves are 2 and 3.
void expect_one_order_more(const UnitCell &given, const meshes::HomogenizedCell &cell,
                           const Law law, const double strain)
{
  const StateErrors coarse = errors_of(cell, given, law, strain * oblique),
                    fine   = errors_of(cell, given, law, 0.5 * strain * oblique);
  const auto order         = [](const double error, const double of_half)
  { return std::log2(error / of_half); };
  const std::string what = given.name + ", " + name_of(law);
  EXPECT_NEAR(order(coarse.fluctuation.first, fine.fluctuation.first), 1., 0.1) << what;
  EXPECT_NEAR(order(coarse.stress.first, fine.stress.first), 1., 0.1) << what;
  EXPECT_NEAR(order(coarse.fluctuation.second, fine.fluctuation.second), 2., 0.1) << what;
  EXPECT_NEAR(order(coarse.stress.second, fine.stress.second), 2., 0.1) << what;
}

// From 1 to 0.5 % the next order changes them by hundredths.
TEST(order_second_order, fluctuation_and_stress_of_an_infinite_cloth_gain_one_order_in_strain)
{
  for (const char *name : {"layered", "three-stiffness", "honeycomb"})
  {
    const UnitCell given               = shipped(name);
    const meshes::HomogenizedCell cell = homogenized(given);
    for (const Law law : {Law::biot, Law::green})
      expect_one_order_more(given, cell, law, 0.01);
  }
}

// Two independent prototypes, to the digits that they print: half a unit of the last one, and 10 %.
TEST(exact_second_order, layered_at_ten_percent_has_the_errors_of_independent_prototypes)
{
  const UnitCell given =
    homogenization::read_unit_cell(std::string(CELLS) + "layered.prm", MPI_COMM_WORLD);
  const meshes::HomogenizedCell cell = homogenized(given);
  const auto expect = [](const double found, const double percent, const double digit)
  { EXPECT_NEAR(100. * found, percent, 0.1 * percent + 0.5 * digit); };
  const StateErrors shear = errors_of(cell, given, Law::biot, {0., 0., 0.1});
  expect(shear.fluctuation.first, 1.09, 0.01);
  expect(shear.fluctuation.second, 0.09, 0.01);
  expect(shear.stress.first, 8.07, 0.01);
  expect(shear.stress.second, 0.18, 0.01);
  const StateErrors both = errors_of(cell, given, Law::biot, 0.1 * oblique);
  expect(both.fluctuation.first, 6.3, 0.1);
  expect(both.fluctuation.second, 0.6, 0.1);
  expect(both.stress.first, 0.79, 0.01);
  expect(both.stress.second, 0.09, 0.01);
}
