// SPDX-License-Identifier: MIT
// The cells of the stress cases, what is done to them, and that a wrong turn, a lost mirror or one
// triangle of the wrong phase is seen by the measure and the limit of these cases.
#include "meshes/plain/errors.h"
#include "tests/refusal.h"
#include "verification/extremes/stress_cases.h"
#include "verification/extremes/stress_cells.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// A limit that no case of these cells exceeds, ten times over.
constexpr double limit = 1e-10;

Eigen::Matrix2d turn(const double angle)
{
  const double a = angle * M_PI / 180.;
  return (Eigen::Matrix2d() << std::cos(a), -std::sin(a), std::sin(a), std::cos(a)).finished();
}

UnitCell stripes()
{
  return built_in_cells()[0];
}

UnitCell yarns()
{
  return built_in_cells()[1];
}

void expect_all_pass(const std::string &group, const std::string &part_of_name)
{
  int n = 0;
  for (const StressCase &one : cell_cases({}, {}, 1, 10000))
    if (one.group == group && one.name.find(part_of_name) != std::string::npos)
    {
      ++n;
      const StressResult result = run_case(one, 2);
      EXPECT_EQ(result.verdict, Outcome::pass)
        << one.name << ": " << result.outcome << ", " << result.figure << ", " << limit_text(one);
    }
  EXPECT_GT(n, 0) << part_of_name;
}
} // namespace

TEST(exact_stress_cells, the_factorized_cell_problem_of_stripes_is_the_laminate)
{
  EXPECT_LT(energy_difference(factorized_stiffness(stripes()),
                              laminate_stiffness(stripes().stiffness_of_phase(), {0.5, 0.5})),
            1e-12);
}

TEST(exact_stress_cells, the_measure_weighs_soft_directions_like_stiff_ones)
{
  const Eigen::Matrix3d B = Eigen::Vector3d(1e6, 1e-6, 1.).asDiagonal();
  Eigen::Matrix3d A       = B;
  A(1, 1) *= 1.5;
  EXPECT_NEAR(energy_difference(A, B), 0.5, 1e-12);
  EXPECT_NEAR(order_violation(A, B), 0.5, 1e-12);
  EXPECT_EQ(order_violation(B, A), 0.);
}

TEST(exact_stress_cells, spread_moduli_have_the_contrast_and_keep_the_softest)
{
  const UnitCell cell = with_contrast(stripes(), 1e4);
  EXPECT_DOUBLE_EQ(cell.phases[0].E1, stripes().phases[0].E1);
  EXPECT_NEAR(cell.phases[1].E1 / cell.phases[0].E1, 1e4, 1e-8);
}

TEST(invariant_stress_cells, moved_cells_are_sound_and_have_the_moved_stiffness)
{
  const Eigen::Matrix3d C      = factorized_stiffness(yarns());
  const Eigen::Matrix2d mirror = Eigen::Vector2d(-1., 1.).asDiagonal();
  const std::vector<std::pair<UnitCell, Eigen::Matrix3d>> all = {
    {turned(yarns(), 30.), moved_tensor(C, turn(30.))},
    {mirrored(yarns()), moved_tensor(C, mirror)},
    {shifted(yarns(), {0.3125, 0.6875}), C},
    {repeated(yarns(), 2, 1), C},
    {in_units(yarns(), 1e3, 1e3, 1e-9), 1e-6 * C}};
  for (const auto &[cell, expected] : all)
  {
    EXPECT_NO_THROW(refuse_unsound(cell));
    EXPECT_LT(energy_difference(factorized_stiffness(cell), expected), limit);
  }
}

TEST(tripwire_stress_cells, a_wrong_turn_is_noticed)
{
  const Eigen::Matrix3d C     = factorized_stiffness(yarns()),
                        found = factorized_stiffness(turned(yarns(), 30.));
  EXPECT_GT(energy_difference(found, moved_tensor(C, turn(-30.))), 1e3 * limit);
  EXPECT_GT(energy_difference(found, moved_tensor(C, turn(30.0001))), 1e3 * limit);
  EXPECT_GT(energy_difference(found, C), 1e3 * limit);
}

TEST(tripwire_stress_cells, a_phase_that_does_not_turn_with_its_mesh_is_noticed)
{
  UnitCell cell        = turned(yarns(), 30.);
  cell.phases[1].angle = yarns().phases[1].angle;
  EXPECT_GT(energy_difference(factorized_stiffness(cell),
                              moved_tensor(factorized_stiffness(yarns()), turn(30.))),
            1e3 * limit);
}

TEST(tripwire_stress_cells, a_mirrored_cell_that_keeps_the_angle_of_its_yarns_is_noticed)
{
  UnitCell cell                = mirrored(yarns());
  cell.phases[1].angle         = yarns().phases[1].angle;
  const Eigen::Matrix2d mirror = Eigen::Vector2d(-1., 1.).asDiagonal();
  EXPECT_GT(energy_difference(factorized_stiffness(cell),
                              moved_tensor(factorized_stiffness(yarns()), mirror)),
            1e3 * limit);
}

TEST(tripwire_stress_cells, one_triangle_of_the_wrong_phase_is_noticed)
{
  UnitCell cell          = repeated(stripes(), 2, 2);
  cell.mesh.material(17) = 1 - cell.mesh.material(17);
  EXPECT_GT(energy_difference(factorized_stiffness(cell), factorized_stiffness(stripes())),
            1e3 * limit);
}

TEST(tripwire_stress_cells, unsound_cells_are_refused_by_name)
{
  UnitCell cell = stripes();
  cell.mesh.vertices.col(0) *= -1.;
  EXPECT_NE(tests::refusal([&]() { refuse_unsound(cell); }).find("inverted"), std::string::npos);
  cell              = stripes();
  cell.phases[1].E1 = 0.;
  EXPECT_NE(tests::refusal([&]() { refuse_unsound(cell); }).find("Young's modulus"),
            std::string::npos);
  cell              = stripes();
  cell.phases[1].E1 = cell.phases[1].E2 = cell.phases[0].E1;
  EXPECT_NE(tests::refusal([&]() { with_contrast(cell, 10.); }).find("same Young's modulus"),
            std::string::npos);
}

TEST(bound_stress_cells, poissons_ratio_of_almost_one_half_and_minus_one_is_regular)
{
  expect_all_pass("cell Poisson's ratio", "");
}

TEST(bound_stress_cells, what_vanishes_does_so_with_the_slope_that_larger_ones_have)
{
  expect_all_pass("cell contrast", "beside");
}

TEST(bound_stress_cells, slivers_do_not_change_a_laminate)
{
  expect_all_pass("cell slivers", "one obtuse triangle");
}

TEST(bound_stress_cells, moved_cells_keep_their_stiffness)
{
  expect_all_pass("cell symmetry", "mirrored");
}

TEST(tripwire_stress_cells, ranks_that_disagree_are_noticed)
{
  const Eigen::Matrix3d C = factorized_stiffness(stripes());
  for (const double wrong : {1., 1. + 1e-6})
  {
    int n = 0;
    for (const StressCase &one : cell_cases({}, {wrong * C}, 2, 100))
      if (one.group == "cell ranks")
      {
        ++n;
        EXPECT_EQ(run_case(one, 1).verdict, wrong == 1. ? Outcome::pass : Outcome::fail);
      }
    EXPECT_EQ(n, 1);
  }
}
