// SPDX-License-Identifier: MIT
#include "meshes/cloth/irregular_sheet.h"
#include "meshes/plain/refine.h"
#include "meshes/plain/sheet.h"
#include "verification/converge/manufactured.h"
#include "verification/converge/manufactured_cases.h"
#include "verification/extremes/stress_sheet.h"
#include "verification/reference/fine_reference.h"
#include "verification/reference/space_laws.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;

namespace
{
Eigen::Matrix3d anisotropic()
{
  Eigen::Matrix3d C;
  C << 1500., 330., 120., 330., 600., -90., 120., -90., 270.;
  return C;
}
} // namespace

TEST(exact_manufactured, energies_written_twice_agree_with_the_laws_of_the_solvers)
{
  Eigen::Matrix<double, 3, 2> F;
  F << 1.2, 0.1, -0.2, 0.9, 0.3, 0.4;
  for (const Law law : {Law::biot, Law::green})
  {
    const EnergyAndStress here = energy_and_stress(law, anisotropic(), F);
    const SpaceResponse there  = space_response(law, anisotropic(), F, Tangent::none);
    EXPECT_NEAR(here.energy, there.energy, 1e-13 * there.energy);
    EXPECT_LT((here.stress - there.stress).norm(), 1e-12 * there.stress.norm());
  }
  F.row(2).setZero();
  for (const Law law : {Law::linear, Law::biot, Law::green})
  {
    const EnergyAndStress here = energy_and_stress(law, anisotropic(), F);
    const Response there       = response(law, anisotropic(), F.topRows<2>());
    EXPECT_NEAR(here.energy, there.energy, 1e-13 * there.energy);
    EXPECT_LT(
      (Eigen::Vector4d(here.stress(0, 0), here.stress(0, 1), here.stress(1, 0), here.stress(1, 1)) -
       there.stress)
        .norm(),
      1e-12 * there.stress.norm());
  }
}

TEST(exact_manufactured, the_force_of_a_quadratic_stretch_is_that_of_the_bar)
{
  // x = X + k X²/2 without contraction: linear and biot have P11 = C11 k X, green has
  // E = k X + k² X²/2, P11 = (1 + k X) C11 E.
  const double k = 0.3, X = 0.4, C11 = 700.;
  const Eigen::Matrix3d C      = Eigen::Vector3d(C11, 500., 200.).asDiagonal();
  const GradientField gradient = [&](const Eigen::RowVector2d &point)
  {
    Eigen::Matrix<double, 3, 2> F;
    F << 1. + k * point(0), 0., 0., 1., 0., 0.;
    return F;
  };
  for (const Law law : {Law::linear, Law::biot, Law::green})
  {
    const double E = k * X + 0.5 * k * k * X * X;
    const double expected =
      law == Law::green ? C11 * (k * E + (1. + k * X) * (k + k * k * X)) : C11 * k;
    const Eigen::Vector3d force = equilibrium_force(law, C, gradient, {X, 0.2}, 1e-3);
    EXPECT_NEAR(force(0), -expected, 1e-9 * expected) << name_of(law);
    EXPECT_LT(force.tail<2>().norm(), 1e-9 * expected);
  }
}

namespace
{
/// Climbs the cases whose name begins so.
void expect_orders(const std::string &beginning, const int n_cases)
{
  int n_found = 0;
  for (const ManufacturedCase &manufactured : manufactured_cases())
  {
    if (manufactured.name.rfind(beginning, 0) != 0)
      continue;
    ++n_found;
    const ManufacturedLadder ladder = climb(manufactured, MPI_COMM_SELF);
    const ManufacturedClaims claims = judge(manufactured, ladder);
    const std::string name = manufactured.name + "; P" + std::to_string(manufactured.order);
    EXPECT_EQ(claims.L2.outcome, Outcome::pass)
      << name << ": L2 order " << claims.L2.order << ", " << claims.L2.why;
    if (manufactured.has_H1)
    {
      EXPECT_EQ(claims.H1.outcome, Outcome::pass)
        << name << ": H1 order " << claims.H1.order << ", " << claims.H1.why;
    }
    EXPECT_LT(claims.algebraic_share, 0.01) << name;
    EXPECT_LT(ladder.L2.back(), 1e-3) << name; // of the side: it converges to this motion
  }
  EXPECT_EQ(n_found, n_cases);
}
} // namespace

TEST(order_manufactured, sheets_in_the_plane_converge_with_p_plus_1_and_p)
{
  expect_orders("sheet in the plane", 12);
}

TEST(order_manufactured, cloth_in_space_converges_with_p_plus_1_and_p_at_rest)
{
  expect_orders("cloth in space; statics", 4);
}

TEST(order_manufactured, cloth_in_space_converges_with_p_plus_1_and_p_in_motion)
{
  expect_orders("cloth in space; steps", 6);
}

TEST(order_manufactured, implicit_euler_converges_with_order_1)
{
  expect_orders("cloth in space; implicit Euler", 2);
}

namespace
{
/// L2 errors of biot with P1 under a force that some fault has spoilt, on four levels.
OrderJudgement judged_with(
  const std::function<Eigen::Vector3d(const GradientField &, const Eigen::RowVector2d &)> &force)
{
  const auto wave = [](const Eigen::RowVector2d &X)
  { return FieldValue(0.02 * std::sin(2. * M_PI * X(0)) * std::cos(2. * M_PI * X(1)), 0., 0.); };
  const auto slope = [](const Eigen::RowVector2d &X)
  {
    FieldGradient gradient = FieldGradient::Zero();
    const double x = 2. * M_PI * X(0), y = 2. * M_PI * X(1);
    gradient.row(0) << 0.04 * M_PI * std::cos(x) * std::cos(y),
      -0.04 * M_PI * std::sin(x) * std::sin(y);
    return gradient;
  };
  const Load load("periodic-22");
  const GradientField motion = [&](const Eigen::RowVector2d &X)
  {
    FieldGradient F = slope(X);
    F.topRows<2>() += load.gradient(0.1);
    return F;
  };
  std::vector<double> h, errors;
  for (const int refinements : {1, 2, 3, 4})
  {
    const meshes::Sheet sheet = meshes::tile(
      meshes::refined(meshes::irregular_sheet(6, 1.), refinements), meshes::Lattice(), 1, 1);
    FineReference reference(sheet, {anisotropic()}, ReferenceOptions(), MPI_COMM_SELF);
    reference.start(load, Law::biot,
                    [&](const Eigen::RowVector2d &X, double)
                    { return Eigen::RowVector2d(force(motion, X).head<2>().transpose()); });
    EXPECT_TRUE(reference.advance(0.1).reached);
    h.push_back(std::pow(0.5, refinements));
    errors.push_back(reference.distance_from({wave, slope}).L2);
  }
  return judge_errors(h, errors, about(2.));
}
} // namespace

TEST(tripwire_manufactured, a_force_of_another_law_or_of_a_swapped_stiffness_does_not_pass)
{
  const auto force_of = [](const Law law, const Eigen::Matrix3d &C)
  {
    return [=](const GradientField &F, const Eigen::RowVector2d &X)
    { return equilibrium_force(law, C, F, X, 2e-3); };
  };
  const OrderJudgement right = judged_with(force_of(Law::biot, anisotropic()));
  EXPECT_EQ(right.outcome, Outcome::pass) << right.order << " " << right.why;
  Eigen::Matrix3d swapped = anisotropic();
  swapped.row(0).swap(swapped.row(1));
  swapped.col(0).swap(swapped.col(1));
  for (const auto &wrong : {force_of(Law::green, anisotropic()),
                            force_of(Law::linear, anisotropic()), force_of(Law::biot, swapped)})
  {
    const OrderJudgement found = judged_with(wrong);
    EXPECT_NE(found.outcome, Outcome::pass) << found.order << " " << found.why;
    EXPECT_LT(found.observed.back(), 0.5) << found.why; // the error stays, however fine the mesh
  }
}

TEST(tripwire_manufactured, an_algebraic_error_that_was_not_measured_proves_no_order)
{
  // A solver whose iterates change from one tolerance on, by so much.
  const auto with = [](const double first_tolerance, const double change)
  {
    ManufacturedCase made_up;
    made_up.order  = 1;
    made_up.sizes  = {10, 20, 40, 80};
    made_up.extent = 1.;
    made_up.L2     = about(2.);
    made_up.H1     = about(1.);
    made_up.solve  = [=](const int size, const double tolerance, MPI_Comm)
    {
      ManufacturedSolution solution;
      solution.error.L2 = 0.01 / (size * size); // side 0.1: 1/size²
      solution.error.H1 = 0.1 / size;
      solution.positions =
        Eigen::MatrixXd::Constant(3, 1, tolerance < first_tolerance ? 0. : change);
      return solution;
    };
    const ManufacturedLadder ladder = climb(made_up, MPI_COMM_SELF);
    return judge(made_up, ladder);
  };
  const double finest = 0.1 / 6400.; // the smallest L2 error, as a length
  for (const double first :
       {1e-11, 1e-9, 1e-7}) // Newton's last step may jump below several tolerances
  {
    EXPECT_EQ(with(first, 1e-3 * finest).L2.outcome, Outcome::pass) << first;
    EXPECT_NEAR(with(first, 1e-3 * finest).algebraic_share, 1e-3, 1e-9);
    EXPECT_EQ(with(first, 0.1 * finest).L2.outcome, Outcome::inconclusive) << first;
    EXPECT_EQ(with(first, 0.1 * finest).H1.outcome, Outcome::inconclusive) << first;
  }
  const ManufacturedClaims never = with(1., 1.);
  EXPECT_TRUE(std::isnan(never.algebraic_share));
  EXPECT_EQ(never.L2.outcome, Outcome::inconclusive);
}
