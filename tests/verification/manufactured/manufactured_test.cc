// SPDX-License-Identifier: MIT
#include "meshes/cloth/irregular_sheet.h"
#include "meshes/plain/refine.h"
#include "meshes/plain/sheet.h"
#include "tests/verification/manufactured/manufactured.h"
#include "tests/verification/manufactured/manufactured_cases.h"
#include "tests/verification/manufactured/nodal_fields.h"
#include "verification/law/space_laws.h"
#include "verification/reference/fine_reference.h"
#include "verification/stress/stress_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace homespun;
using namespace homespun::verification;

TEST(exact_manufactured, energies_written_twice_agree_with_the_laws_of_the_solvers)
{
  Eigen::Matrix<double, 3, 2> F;
  F << 1.2, 0.1, -0.2, 0.9, 0.3, 0.4;
  for (const Law law : {Law::biot, Law::green, Law::yarn})
  {
    const EnergyAndStress here = energy_and_stress(law, anisotropic(), F);
    const SpaceResponse there  = space_response(law, anisotropic(), F, Tangent::none);
    EXPECT_NEAR(here.energy, there.energy, 1e-13 * there.energy);
    EXPECT_LT((here.stress - there.stress).norm(), 1e-12 * there.stress.norm());
  }
  F.row(2).setZero();
  for (const Law law : all_laws())
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
    if (manufactured.has_tolerance)
    {
      EXPECT_LT(claims.algebraic_share, 0.01) << name;
    }
    EXPECT_EQ(ladder.unfinished, "") << name;
    ASSERT_FALSE(ladder.L2.empty()) << name;
    EXPECT_LT(ladder.L2.back(), 1e-3) << name; // of the side: it converges to this motion
  }
  EXPECT_EQ(n_found, n_cases);
}
} // namespace

TEST(order_manufactured, sheets_in_the_plane_converge_with_p_plus_1_and_p)
{
  expect_orders("sheet in the plane", 16);
}

TEST(order_manufactured, cloth_in_space_converges_with_p_plus_1_and_p_at_rest)
{
  expect_orders("cloth in space; statics", 6);
}

TEST(order_manufactured, cloth_in_space_converges_with_p_plus_1_and_p_in_motion)
{
  expect_orders("cloth in space; steps", 9);
}

TEST(order_manufactured, implicit_euler_converges_with_order_1)
{
  expect_orders("cloth in space; implicit Euler", 3);
}

TEST(order_manufactured, the_shell_converges_with_2_and_1_in_the_plane)
{
  expect_orders("shell in the plane", 4);
}

TEST(order_manufactured, the_shell_converges_with_2_and_1_in_space_at_rest_and_in_motion)
{
  expect_orders("shell in space; statics", 2);
  expect_orders("shell in space; steps", 2);
}

TEST(order_manufactured, integrators_of_the_shell_have_their_order_against_a_known_motion)
{
  expect_orders("shell in space; linearly implicit Euler", 1);
  expect_orders("shell in space; implicit Euler", 1);
  expect_orders("shell in space; conserving integrator", 1);
}

TEST(order_manufactured, characteristic_displacements_under_a_force_converge_with_p_plus_1_and_p)
{
  expect_orders("homogenizer", 5);
}

TEST(order_manufactured, upsampled_positions_of_a_known_motion_converge_with_order_2)
{
  expect_orders("up-sampler", 4);
}

TEST(exact_manufactured, linear_triangles_integrate_forces_and_distances)
{
  meshes::TriangleMesh mesh = meshes::irregular_sheet(3, 1.);
  // Loads of f = (1, x, x y): their sum is that of f over the square, their moment about y = 0 that
  // of y f.
  const meshes::SpacePoints loads = nodal_loads(mesh, [](const Eigen::RowVector2d &X)
                                                { return FieldValue(1., X(0), X(0) * X(1)); });
  EXPECT_LT((loads.colwise().sum() - Eigen::RowVector3d(1., 1. / 2., 1. / 4.)).norm(), 1e-13);
  EXPECT_LT(
    (mesh.vertices.col(1).transpose() * loads - Eigen::RowVector3d(1. / 2., 1. / 4., 1. / 6.))
      .norm(),
    1e-13);
  Eigen::Matrix<double, 3, 2> F;
  F << 1.2, 0.1, -0.2, 0.9, 0.3, 0.4;
  const KnownField affine       = {[=](const Eigen::RowVector2d &X)
                                   { return FieldValue(F * X.transpose()); },
                                   [=](const Eigen::RowVector2d &) { return F; }};
  meshes::SpacePoints positions = mesh.vertices * F.transpose();
  EXPECT_LT(distance(mesh, positions, affine).L2, 1e-14);
  EXPECT_LT(distance(mesh, positions, affine).H1, 1e-13);
  // Moved by (3, 4, 0) x: |.|² = 25 x², its gradient 25.
  positions += mesh.vertices.col(0) * Eigen::RowVector3d(3., 4., 0.);
  EXPECT_NEAR(distance(mesh, positions, affine).L2, std::sqrt(25. / 3.), 1e-12);
  EXPECT_NEAR(distance(mesh, positions, affine).H1, 5., 1e-12);
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

namespace
{
/// The claims of a case whose errors are made up: e = C h^p with a tenth of h^(p+1) beside it.
ManufacturedClaims judged_as(ManufacturedCase manufactured, const double L2_order)
{
  manufactured.solve = [=](const int size, const double tolerance, MPI_Comm)
  {
    const double h = 1. / size;
    ManufacturedSolution solution;
    solution.error.L2  = 1e-3 * std::pow(h, L2_order) * (1. + 0.1 * h);
    solution.error.H1  = 1e-2 * std::pow(h, L2_order - 1.) * (1. + 0.1 * h);
    solution.positions = Eigen::MatrixXd::Constant(1, 1, tolerance);
    return solution;
  };
  return judge(manufactured, climb(manufactured, MPI_COMM_SELF));
}
} // namespace

TEST(tripwire_manufactured, an_order_too_low_or_too_high_by_one_fails_in_every_case)
{
  for (const ManufacturedCase &one : manufactured_cases())
  {
    const double expected = 0.5 * (one.L2.lowest + one.L2.highest);
    EXPECT_LE(one.L2.highest - one.L2.lowest, 0.2 + 1e-12) << one.name;
    EXPECT_EQ(judged_as(one, expected).L2.outcome, Outcome::pass) << one.name;
    for (const double wrong : {expected - 1., expected + 1.})
      if (wrong > 0.)
      {
        EXPECT_EQ(judged_as(one, wrong).L2.outcome, Outcome::fail) << one.name << wrong;
        if (one.has_H1 && wrong > 1.)
        {
          EXPECT_EQ(judged_as(one, wrong).H1.outcome, Outcome::fail) << one.name << wrong;
        }
      }
  }
}

TEST(tripwire_manufactured, linear_elements_do_not_pass_for_quadratic_ones)
{
  int n_pairs = 0;
  for (const ManufacturedCase &quadratic : homogenizer_cases())
    for (ManufacturedCase linear : homogenizer_cases())
      if (quadratic.order == 2 && linear.order == 1 && linear.name == quadratic.name)
      {
        ++n_pairs;
        linear.L2                       = quadratic.L2;
        linear.H1                       = quadratic.H1;
        const ManufacturedClaims claims = judge(linear, climb(linear, MPI_COMM_SELF));
        EXPECT_EQ(claims.L2.outcome, Outcome::fail) << linear.name << claims.L2.why;
        EXPECT_EQ(claims.H1.outcome, Outcome::fail) << linear.name << claims.H1.why;
      }
  EXPECT_EQ(n_pairs, 2);
}

TEST(tripwire_manufactured, upsampling_by_another_lift_constant_or_blend_has_not_order_2)
{
  using namespace localization;
  const auto orders_with = [](const auto &change)
  {
    UpsamplerOptions options;
    change(options);
    std::vector<OrderJudgement> found;
    for (const ManufacturedCase &one : upsampler_cases(options))
      found.push_back(judge(one, climb(one, MPI_COMM_SELF)).L2);
    return found;
  };
  for (const auto &found : {orders_with([](UpsamplerOptions &o) { o.lift = Lift::affine; }),
                            orders_with([](UpsamplerOptions &o) { o.anchor = Anchor::mean; }),
                            orders_with([](UpsamplerOptions &o) { o.microscopic = false; })})
    for (const OrderJudgement &one : found)
      EXPECT_EQ(one.outcome, Outcome::fail) << one.order << " " << one.why;
  // Strains that jump err by H: seen where cells do not shrink with H.
  const auto piecewise = orders_with([](UpsamplerOptions &o) { o.blend = Blend::piecewise; });
  for (const std::size_t k : {2u, 3u})
    EXPECT_EQ(piecewise[k].outcome, Outcome::fail) << piecewise[k].order << piecewise[k].why;
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
  // A step that jumps from above 1e8 tolerances below one takes at least as much off the error.
  EXPECT_NEAR(with(1e-3, 1e5 * finest).algebraic_share, 1e-3, 1e-9);
  EXPECT_EQ(with(1e-3, 1e5 * finest).L2.outcome, Outcome::pass);
  EXPECT_EQ(with(1e-3, 1e7 * finest).L2.outcome, Outcome::inconclusive);
  const ManufacturedClaims never = with(std::numeric_limits<double>::infinity(), 1.);
  EXPECT_TRUE(std::isnan(never.algebraic_share));
  EXPECT_EQ(never.L2.outcome, Outcome::inconclusive);
}
