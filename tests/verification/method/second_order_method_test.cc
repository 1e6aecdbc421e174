// SPDX-License-Identifier: MIT
// The terms `cubic` and `modes` as a study runs them: coarse cloth and up-sampled positions of an
// infinite cloth against the resolved one, by their orders in strain.
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "tests/refusal.h"
#include "verification/method/coarse_model.h"
#include "verification/reference/fine_reference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace homespun;
using namespace homespun::verification;
using homogenization::UnitCell;
using meshes::Law;

namespace
{
struct Case
{
  const char *cell, *load;
  Law law;
  double strain = 0.01;
};

/// A shipped cell, or stripes of yarns that lie askew, neither along the stripes nor along each
/// other's.
UnitCell cell_of(const std::string &name)
{
  const bool askew = name == "stripes of yarns";
  UnitCell cell    = homogenization::read_unit_cell(
       std::string(CELLS) + (askew ? "layered" : name) + ".prm", MPI_COMM_WORLD);
  double angle = 20.;
  for (homogenization::Phase &phase : cell.phases)
    if (askew)
    {
      phase.E2    = 0.4 * phase.E1;
      phase.G12   = 0.1 * phase.E1;
      phase.angle = angle;
      angle += 35.;
    }
  return cell;
}

meshes::HomogenizedCell homogenized(const UnitCell &cell, const std::vector<Law> &second_order)
{
  homogenization::HomogenizationOptions options;
  options.order        = 1; // as the reference
  options.tolerance    = 1e-13;
  options.second_order = second_order;
  return homogenization::homogenized_cell(
    cell, homogenization::homogenize(cell, options, MPI_COMM_WORLD), "");
}

/// Mean distance of positions [m], distance of mean stresses [N/m].
struct Distance
{
  double positions, stress;
};

/// At two strains, the second half of the first.
struct Distances
{
  Distance at, at_half;
};

double order(const double error, const double at_half)
{
  return std::log2(error / at_half);
}

/// Of localized, then of second order.
std::array<Distances, 2> distances_of(const Case &which)
{
  const UnitCell cell             = cell_of(which.cell);
  const meshes::HomogenizedCell h = homogenized(cell, {Law::biot, Law::green});
  const meshes::Sheet sheet       = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  const Load load(which.load);
  FineReference reference(sheet, cell.stiffness_of_phase(), {}, MPI_COMM_WORLD);
  reference.start(load, which.law);
  const CoarseModel first({h}, sheet, load, Method("localized"), which.law),
    second({h}, sheet, load, Method("localized+cubic+modes"), which.law);
  const auto at = [&](const double strain, const meshes::Points &fine,
                      const Eigen::Matrix2d &stress, const CoarseModel &model)
  {
    const CoarseState state = model.solve(strain);
    return Distance{(model.upsample(state) - fine).rowwise().norm().mean(),
                    (model.forces(state).stress - stress).norm()};
  };
  const double strain               = which.strain;
  const ReferenceStep of_half       = reference.advance(0.5 * strain);
  const meshes::Points fine_of_half = reference.tighten(1e-12).positions;
  const Eigen::Matrix2d half_stress = of_half.forces.stress;
  const ReferenceStep of_whole      = reference.advance(strain);
  const meshes::Points fine         = reference.tighten(1e-12).positions;
  const Eigen::Matrix2d stress      = of_whole.forces.stress;
  return {
    Distances{at(strain, fine, stress, first), at(0.5 * strain, fine_of_half, half_stress, first)},
    Distances{at(strain, fine, stress, second),
              at(0.5 * strain, fine_of_half, half_stress, second)}};
}
} // namespace

// Slope 3 in the place of 2. Not every load has a second order: stripes stretched along their axes
// under biot have no error, sheared along them under green hardly one of second order. Under
// uniaxial loads the coarse cloth finds how much it contracts.
TEST(order_method_of_second_order, positions_and_stress_of_an_infinite_cloth_have_slope_three)
{
  for (const Case &which :
       {Case{"layered", "periodic-12", Law::biot}, Case{"layered", "periodic-22", Law::green},
        Case{"honeycomb", "periodic-11", Law::biot}, Case{"honeycomb", "uniaxial-1", Law::biot},
        Case{"three-stiffness", "uniaxial-2", Law::green},
        Case{"stripes of yarns", "periodic-all", Law::biot, 0.004},
        Case{"stripes of yarns", "uniaxial-2", Law::green, 0.004}})
  {
    const auto [localized, quadratic] = distances_of(which);
    const std::string what =
      std::string(which.cell) + ", " + which.load + ", " + name_of(which.law);
    EXPECT_NEAR(order(localized.at.positions, localized.at_half.positions), 2., 0.2) << what;
    EXPECT_NEAR(order(quadratic.at.positions, quadratic.at_half.positions), 3., 0.2) << what;
    EXPECT_NEAR(order(localized.at.stress, localized.at_half.stress), 2., 0.2) << what;
    EXPECT_NEAR(order(quadratic.at.stress, quadratic.at_half.stress), 3., 0.2) << what;
    EXPECT_LT(quadratic.at.positions, 0.2 * localized.at.positions) << what;
  }
}

TEST(invariant_method_of_second_order, a_cell_without_cubic_energy_is_refused_by_name)
{
  const UnitCell cell =
    homogenization::read_unit_cell(std::string(CELLS) + "layered.prm", MPI_COMM_WORLD);
  const meshes::HomogenizedCell h = homogenized(cell, {Law::biot});
  const meshes::Sheet sheet       = meshes::tile(cell.mesh, cell.lattice, 2, 2);
  const auto refusal              = [&](const Law law)
  {
    return tests::refusal(
      [&]() { CoarseModel({h}, sheet, Load("strip-1"), Method("localized+cubic"), law); });
  };
  EXPECT_EQ(refusal(Law::biot), "");
  const std::string text = refusal(Law::green);
  EXPECT_NE(text.find("has no second order under the law `green`"), std::string::npos) << text;
}
