// SPDX-License-Identifier: MIT
// The method `quadratic` as a study runs it: coarse cloth and up-sampled positions of an infinite
// cloth against the resolved one, by their orders in strain.
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "tests/refusal.h"
#include "verification/method/lightweight_cloth.h"
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
  options.solver       = homogenization::CellSolver::fastest;
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

/// Of localized, then of quadratic.
std::array<Distances, 2> distances_of(const Case &which)
{
  const UnitCell cell = cell_of(which.cell);
  const meshes::HomogenizedCell h =
    homogenized(cell, homogenization::laws_of_second_order(cell.phases));
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  const Load load(which.load);
  FineReference reference(sheet, cell.stiffness_of_phase(), {}, MPI_COMM_WORLD);
  reference.start(load, which.law);
  LightweightCloth first(h, sheet, load), second(h, sheet, load, {CoarseEnergy::cubic});
  const auto at = [&](const double strain, const meshes::Points &fine,
                      const Eigen::Matrix2d &stress, LightweightCloth &cloth, const char *name)
  {
    const CoarseStep step = cloth.solve(which.law, strain);
    const meshes::Points positions =
      cloth.upsample(Method(name), which.law, step.positions).positions;
    return Distance{(positions - fine).rowwise().norm().mean(),
                    (step.forces.stress - stress).norm()};
  };
  const double strain               = which.strain;
  const ReferenceStep of_half       = reference.advance(0.5 * strain);
  const meshes::Points fine_of_half = reference.tighten(1e-12).positions;
  const Eigen::Matrix2d half_stress = of_half.forces.stress;
  const ReferenceStep of_whole      = reference.advance(strain);
  const meshes::Points fine         = reference.tighten(1e-12).positions;
  const Eigen::Matrix2d stress      = of_whole.forces.stress;
  return {Distances{at(strain, fine, stress, first, "localized"),
                    at(0.5 * strain, fine_of_half, half_stress, first, "localized")},
          Distances{at(strain, fine, stress, second, "quadratic"),
                    at(0.5 * strain, fine_of_half, half_stress, second, "quadratic")}};
}
} // namespace

// Slope 3 in the place of 2. Not every load has a second order: stripes stretched along their axes
// under biot have no error, sheared along them under green hardly one of second order. Under
// uniaxial loads the coarse cloth finds how much it contracts. Of weaves, whose resistance to shear
// is a thousandth of that to stretch, strains are small beside that ratio.
TEST(order_method_of_second_order, positions_and_stress_of_an_infinite_cloth_have_slope_three)
{
  for (const Case &which :
       {Case{"layered", "periodic-12", Law::biot}, Case{"layered", "periodic-22", Law::green},
        Case{"honeycomb", "periodic-11", Law::biot}, Case{"honeycomb", "uniaxial-1", Law::biot},
        Case{"three-stiffness", "uniaxial-2", Law::green},
        Case{"plain-weave", "periodic-all", Law::yarn, 2e-5},
        Case{"twill", "periodic-all", Law::yarn, 2e-5},
        Case{"satin", "periodic-all", Law::yarn, 2e-5},
        Case{"stripes of yarns", "periodic-all", Law::yarn, 0.004},
        Case{"stripes of yarns", "uniaxial-2", Law::yarn, 0.004}})
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
  LightweightCloth cloth(h, sheet, Load("strip-1"), {CoarseEnergy::cubic});
  EXPECT_EQ(tests::refusal([&]() { cloth.solve(Law::biot, 0.01); }), "");
  const std::string text = tests::refusal([&]() { cloth.solve(Law::green, 0.01); });
  EXPECT_NE(text.find("has no cubic energy under the law `green`"), std::string::npos) << text;
}

TEST(invariant_method_of_second_order, it_has_a_meaning_under_laws_that_have_a_second_order)
{
  EXPECT_FALSE(Method("quadratic").has_meaning(Law::linear));
  EXPECT_TRUE(Method("quadratic").has_meaning(Law::biot));
  EXPECT_TRUE(Method("quadratic").has_meaning(Law::green));
  EXPECT_TRUE(Method("quadratic").has_meaning(Law::yarn));
  EXPECT_EQ(Method("quadratic").options(Law::green).second_order, "green");
  EXPECT_EQ(Method("localized").options(Law::green).second_order, "");
}
