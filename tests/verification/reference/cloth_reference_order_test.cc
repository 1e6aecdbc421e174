// SPDX-License-Identifier: MIT
// Against closed forms and series, level by level: the order of the elements and of the integrator.
#include "tests/verification/reference/cloth_reference_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace homespun;
using namespace homespun::tests;

namespace
{
/// Slope of log(error) against log(h) through the last two levels.
double last_order(const std::vector<double> &errors)
{
  return std::log2(errors[errors.size() - 2] / errors.back());
}
} // namespace

TEST(order_cloth_reference, a_strip_under_its_own_weight_is_as_long_as_the_closed_form_says)
{
  // nu = 0, hung by its upper edge: at rest height X the sheet carries rho g X. biot:
  // x' = 1 + rho g X / E, so that x = X + rho g X²/(2 E) + constant, which P2 contains.
  const double length = 0.4, E = 40., rho = 0.5, pull = rho * g;
  const Held top = [&](const Eigen::RowVector2d &X, double) -> std::optional<Eigen::RowVector3d>
  {
    if (X(1) > length - 1e-9)
      return Eigen::RowVector3d(X(0), 0., 0.);
    return std::nullopt;
  };
  ClothLoads loads;
  loads.gravity         = {0., 0., -g};
  const auto error_with = [&](const unsigned int order, const int n)
  {
    const meshes::TriangleMesh mesh = rectangle(0.1, length, n, 4 * n);
    ClothReference cloth(mesh, {isotropic(E, 0.)}, {rho}, options_of(Law::biot, order, true),
                         MPI_COMM_SELF);
    cloth.start([&](const Eigen::RowVector2d &X)
                { return Eigen::RowVector3d(X(0), 0., X(1) - length); },
                top, loads);
    const ClothStep step = cloth.solve_equilibrium(0.);
    EXPECT_TRUE(step.reached) << step.why;
    const double lowest = -length - pull * length * length / (2. * E);
    double off          = 0.;
    for (int v = 0; v < mesh.n_vertices(); ++v)
    {
      const double X = mesh.vertices(v, 1), z = lowest + X + pull * X * X / (2. * E);
      off = std::max(
        off, (cloth.positions().row(v) - Eigen::RowVector3d(mesh.vertices(v, 0), 0., z)).norm());
    }
    return off;
  };
  EXPECT_LT(error_with(2, 2), 1e-12);
  EXPECT_NEAR(last_order({error_with(1, 2), error_with(1, 4), error_with(1, 8), error_with(1, 16)}),
              2., 0.15);
}

/// A strip without contraction between two lines, tensioned by a stretch, sagging under its weight.
/// In equilibrium of a string of stiffness E whose law is biot (tension E (stretch − 1), along the
/// string), with H the horizontal tension and V(X) = rho g (X − L/2) the vertical one:
///   N = sqrt(H² + V²),  dx/dX = (1 + N/E) H/N,  dz/dX = (1 + N/E) V/N:   the elastic catenary,
///   x = H X/E + H/w asinh(V/H),  z = V²/(2 E w) + sqrt(H² + V²)/w   from the middle, w = rho g.
struct Catenary
{
  double E, w, length, span, H;

  Catenary(const double E, const double w, const double length, const double span)
      : E(E)
      , w(w)
      , length(length)
      , span(span)
  {
    const auto half = [&](const double H)
    { return H * 0.5 * length / E + H / w * std::asinh(0.5 * w * length / H); };
    double low = 1e-6, high = 10. * E;
    for (int k = 0; k < 200; ++k)
    {
      H                                   = 0.5 * (low + high);
      (half(H) < 0.5 * span ? low : high) = H;
    }
  }

  Eigen::RowVector2d at(const double X) const
  {
    const double V = w * (X - 0.5 * length), V_end = 0.5 * w * length;
    const auto height = [&](const double v) { return v * v / (2. * E * w) + std::hypot(H, v) / w; };
    return {H * (X - 0.5 * length) / E + H / w * std::asinh(V / H), height(V) - height(V_end)};
  }
};

namespace
{
/// Largest distance from the catenary over levels n = 4, 8, 16, ... along a strip.
std::vector<double> catenary_errors(const unsigned int order, const bool consistent,
                                    const std::vector<int> &levels)
{
  const double length = 0.4, span = 0.41, E = 60., rho = 0.5;
  const Catenary exact(E, rho * g, length, span);
  const Held ends = [&](const Eigen::RowVector2d &X, double) -> std::optional<Eigen::RowVector3d>
  {
    if (X(0) < 1e-9 || X(0) > length - 1e-9)
      return Eigen::RowVector3d(span * (X(0) / length - 0.5), X(1), 0.);
    return std::nullopt;
  };
  ClothLoads loads;
  loads.gravity = {0., 0., -g};
  std::vector<double> errors;
  for (const int n : levels)
  {
    const meshes::TriangleMesh mesh = rectangle(length, 0.05, n, std::max(1, n / 8));
    ClothReference cloth(mesh, {isotropic(E, 0.)}, {rho}, options_of(Law::biot, order, consistent),
                         MPI_COMM_SELF);
    cloth.start([&](const Eigen::RowVector2d &X)
                { return Eigen::RowVector3d(span * (X(0) / length - 0.5), X(1), 0.); },
                ends, loads);
    const ClothStep step = cloth.solve_equilibrium(0.);
    EXPECT_TRUE(step.reached) << step.why;
    double off = 0.;
    for (int v = 0; v < mesh.n_vertices(); ++v)
    {
      const Eigen::RowVector2d at = exact.at(mesh.vertices(v, 0));
      const Eigen::RowVector3d there(at(0), mesh.vertices(v, 1), at(1));
      off = std::max(off, (cloth.positions().row(v) - there).norm());
    }
    errors.push_back(off);
  }
  return errors;
}
} // namespace

TEST(order_cloth_reference, a_sagging_strip_approaches_the_elastic_catenary)
{
  // P1 only: with tension along the strip alone nothing smooths across it, and P2, whose triangles
  // break that symmetry, shows no more than order 2 here. The membrane below is in tension both
  // ways.
  for (const bool consistent : {false, true})
    EXPECT_NEAR(last_order(catenary_errors(1, consistent, {8, 16, 32, 64})), 2., 0.1);
}

namespace
{
/// A square held at its rim and stretched in all directions, under a weight that is small against
/// its tension: S (w_XX + w_YY) = rho g with w = 0 at the rim, S the second Piola-Kirchhoff
/// tension. Distance of the deflections from the series in the vertices of the coarsest mesh,
/// relative.
std::vector<double> membrane_errors(const Law law, const unsigned int order, const bool consistent,
                                    const std::vector<unsigned int> &levels)
{
  const double side = 0.2, stretch = 1.1, E = 60., nu = 0.3, rho = 2.5e-3;
  const double biot     = E / (1. - nu) * (stretch - 1.) / stretch,
               green    = E / (1. - nu) * 0.5 * (stretch * stretch - 1.);
  const double S        = law == Law::biot ? biot : green;
  const auto deflection = [&](const Eigen::RowVector2d &X)
  {
    double sum = 0.;
    for (int m = 1; m < 1000; m += 2)
    {
      const double k = m * M_PI, y = X(1) / side;
      // cosh(k (y − ½)) / cosh(k/2) without overflow
      const double rim = (std::exp(-k * y) + std::exp(-k * (1. - y))) / (1. + std::exp(-k));
      sum += (1. - rim) * std::sin(k * X(0) / side) / std::pow(m, 3);
    }
    return -4. * rho * g * side * side / (S * std::pow(M_PI, 3)) * sum;
  };
  const auto placed = [&](const Eigen::RowVector2d &X)
  { return Eigen::RowVector3d(stretch * X(0), stretch * X(1), 0.); };
  const Held rim = [&](const Eigen::RowVector2d &X, double) -> std::optional<Eigen::RowVector3d>
  {
    if (X.minCoeff() < 1e-9 || X.maxCoeff() > side - 1e-9)
      return placed(X);
    return std::nullopt;
  };
  ClothLoads loads;
  loads.gravity = {0., 0., -g};
  // Vertices of an irregular coarsest mesh are singular points of all finer ones, where P1 loses a
  // logarithm.
  const meshes::TriangleMesh mesh = rectangle(side, side, 4, 4, order == 1 ? 0. : 0.15);
  std::vector<double> errors;
  for (const unsigned int refine : levels)
  {
    ClothReferenceOptions options = options_of(law, order, consistent);
    options.refine                = refine;
    ClothReference cloth(mesh, {isotropic(E, nu)}, {rho}, options, MPI_COMM_SELF);
    cloth.start(placed, rim, loads);
    const ClothStep step = cloth.solve_equilibrium(0.);
    EXPECT_TRUE(step.reached) << step.why;
    Eigen::VectorXd w(mesh.n_vertices());
    for (int v = 0; v < mesh.n_vertices(); ++v)
      w(v) = deflection(mesh.vertices.row(v));
    errors.push_back((cloth.positions().col(2) - w).norm() / w.norm());
  }
  return errors;
}
} // namespace

TEST(order_cloth_reference,
     a_stretched_membrane_sags_as_the_series_says_with_the_order_of_its_elements)
{
  for (const Law law : {Law::biot, Law::green})
    for (const unsigned int order : {1u, 2u})
      for (const bool consistent : {false, true})
      {
        const std::vector<double> errors =
          membrane_errors(law, order, consistent,
                          order == 1 ? std::vector<unsigned int>{2, 3, 4, 5}
                                     : std::vector<unsigned int>{0, 1, 2, 3});
        // Lumping takes one order from P2, whose weight is lumped with the mass.
        EXPECT_NEAR(last_order(errors), order == 2 && consistent ? 3. : 2., 0.1)
          << name_of(law) << " P" << order << (consistent ? " consistent" : " lumped");
        EXPECT_LT(errors.back(), 1e-3);
      }
}

namespace
{
/// Height of the middle of a membrane that swings up and down in its lowest mode, after a given
/// time.
double height_after(const double time, const int n_steps)
{
  const double side = 0.2, stretch = 1.1;
  const Held rim = [&](const Eigen::RowVector2d &X, double) -> std::optional<Eigen::RowVector3d>
  {
    if (X.minCoeff() < 1e-9 || X.maxCoeff() > side - 1e-9)
      return Eigen::RowVector3d(stretch * X(0), stretch * X(1), 0.);
    return std::nullopt;
  };
  const meshes::TriangleMesh mesh = rectangle(side, side, 8, 8);
  ClothReference cloth(mesh, {isotropic(60., 0.3)}, {0.2}, options_of(Law::biot, 1, false),
                       MPI_COMM_SELF);
  cloth.start(
    [&](const Eigen::RowVector2d &X)
    {
      return Eigen::RowVector3d(stretch * X(0), stretch * X(1),
                                1e-4 * std::sin(M_PI * X(0) / side) * std::sin(M_PI * X(1) / side));
    },
    rim, {});
  for (int n = 0; n < n_steps; ++n)
    EXPECT_TRUE(cloth.step(time / n_steps).reached);
  return cloth.positions()(40, 2); // the middle of 9 x 9 vertices
}
} // namespace

TEST(order_cloth_reference,
     a_membrane_swings_with_its_lowest_frequency_damped_at_first_order_in_time)
{
  // The sine is an eigenvector of the lumped P1 equations on this mesh: S times the five-point
  // stencil against rho h². omega² = 8 S sin²(pi/16) / (rho h²). Each step of implicit Euler
  // multiplies the complex amplitude by 1/(1 − i omega dt); after time t the height is the real
  // part, starting at rest.
  const double S = 60. / 0.7 * 0.1 / 1.1, h = 0.2 / 8;
  const double omega = std::sqrt(8. * S * std::pow(std::sin(M_PI / 16.), 2) / (0.2 * h * h));
  const double time  = 1. / omega;
  std::vector<double> errors;
  for (const int n : {8, 16, 32, 64})
  {
    const double height = height_after(time, n) / 1e-4;
    errors.push_back(std::abs(height - std::cos(1.)));
    // (1 + omega² dt²) q_(n+1) = 2 q_n − q_(n−1), with q_(−1) = q_0 for a start at rest
    double q = 1., q_before = 1.;
    for (int k = 0; k < n; ++k)
    {
      const double next = (2. * q - q_before) / (1. + 1. / (n * n));
      q_before          = q;
      q                 = next;
    }
    EXPECT_NEAR(height, q, 2e-5) << n;
  }
  EXPECT_NEAR(last_order(errors), 1., 0.1);
}
