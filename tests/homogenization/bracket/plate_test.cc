// SPDX-License-Identifier: MIT
// The resolved plate against polynomials, a series of Timoshenko's and the bracket of D^H, which is
// assembled otherwise.
#include "homogenization/bracket/plate.h"
#include "tests/homogenization/bracket/bending_cells.h"
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::homogenization;
using tests::plate;
using tests::yarn;

namespace
{
/// A unit square of n x n x 2 triangles, shaken inside.
meshes::TriangleMesh square(const int n, const double shaken)
{
  const meshes::Lattice lattice = tests::square_lattice(1.);
  meshes::TriangleMesh mesh     = tests::parallelogram(lattice, n, n);
  mesh.material.setZero(mesh.n_triangles());
  tests::shake(mesh, lattice, shaken / n);
  return mesh;
}

/// The degrees of freedom of the outline, as a deflection with a gradient has them.
template <typename ValueAndGradient>
std::vector<HeldDof> held_by(const ThinPlate &of, ValueAndGradient &&value_and_gradient)
{
  std::vector<HeldDof> held;
  const auto hold_vertex = [&](const int v, const Eigen::Vector2d &x)
  {
    const Eigen::Vector3d w = value_and_gradient(x);
    for (int d = 0; d < 3; ++d)
      held.push_back({3 * v + d, w(d)});
  };
  for (const RimSide &rim : of.mesh.rim())
  {
    const PlateTriangle &its   = of.mesh.triangles[static_cast<std::size_t>(rim.triangle)];
    const auto first           = static_cast<std::size_t>(rim.side);
    const Eigen::Vector2d from = its.corners[first], to = its.corners[(first + 1) % 3];
    hold_vertex(its.vertices[first], from);
    hold_vertex(its.vertices[(first + 1) % 3], to);
    const Eigen::Vector3d w = value_and_gradient(0.5 * (from + to));
    const int side          = its.sides[first];
    held.push_back(
      {of.dof_of_side(side), w.tail<2>().dot(of.mesh.normals[static_cast<std::size_t>(side)])});
  }
  return held;
}

/// A square clamped all around under a pressure of 1: its deflection in the middle.
double deflection_in_the_middle(const int n, const Eigen::Matrix3d &D)
{
  const meshes::TriangleMesh mesh = square(n, 0.);
  const ThinPlate clamped(PlateMesh(mesh), {D});
  const Eigen::MatrixXd w =
    clamped.solve(clamped.pressure(), held_by(clamped, [](const Eigen::Vector2d &)
                                              { return Eigen::Vector3d::Zero().eval(); }));
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if ((mesh.vertices.row(v) - Eigen::RowVector2d(0.5, 0.5)).norm() < 1e-12)
      return w(3 * v, 0);
  return std::nan("");
}
} // namespace

// Cubics are in the space: moments that vary linearly are in equilibrium without a load.
TEST(exact_plate, of_a_cubic_deflection)
{
  const Eigen::Matrix3d D = yarn(20., 0.3);
  const auto w            = [](const Eigen::Vector2d &x)
  {
    const double a = x(0), b = x(1);
    return Eigen::Vector3d(a * a - 2. * a * b + 0.5 * b * b + a * a * a - 0.3 * a * b * b,
                           2. * a - 2. * b + 3. * a * a - 0.3 * b * b, -2. * a + b - 0.6 * a * b);
  };
  const meshes::TriangleMesh mesh = square(5, 0.2);
  const ThinPlate of(PlateMesh(mesh), {D});
  const Eigen::MatrixXd found = of.solve(Eigen::VectorXd::Zero(of.n_dofs()), held_by(of, w));
  for (int v = 0; v < mesh.n_vertices(); ++v)
    EXPECT_LT((found.block<3, 1>(3 * v, 0) - w(mesh.vertices.row(v).transpose())).norm(), 1e-10);
  const Eigen::Vector3d middle = Eigen::Vector3d(0.2, 0.5, 0.3);
  const auto &corners          = of.mesh.triangles[7].corners;
  const Eigen::Vector2d x =
    middle(0) * corners[0] + middle(1) * corners[1] + middle(2) * corners[2];
  const ThinPlate::Values values = of.values(7, middle, found.col(0));
  EXPECT_LT((values.head<3>() - w(x)).norm(), 1e-10);
  EXPECT_NEAR(values(3), 2. + 6. * x(0), 1e-9);
  EXPECT_NEAR(values(4), 1. - 0.6 * x(0), 1e-9);
  EXPECT_NEAR(values(5), 2. * (-2. - 0.6 * x(1)), 1e-9);
}

// w(middle) = 0.00126531909 p L^4 / D (R. L. Taylor and S. Govindjee, Solution of clamped
// rectangular plate problems, Comm. Numer. Meth. Eng. 20, 2004).
TEST(order_plate, of_a_clamped_square_under_pressure_is_4)
{
  const Eigen::Matrix3d D = plate(1., 0.3, 1.);
  std::vector<double> errors;
  for (const int n : {4, 8, 16, 32})
    errors.push_back(1. - deflection_in_the_middle(n, D) * D(0, 0) / 0.001265319087);
  EXPECT_LT(std::abs(errors[2]), 1e-3);
  EXPECT_NEAR(std::log2(errors[2] / errors[3]), 4., 0.4);
}

TEST(exact_plate_cell, is_that_of_the_bracket)
{
  const tests::BracketCell cell = tests::bracket_cell(
    tests::skewed_lattice(), 8, 8, {plate(1., 0.3, 0.5), yarn(25., 0.8)}, tests::odd_pattern);
  const BendingBracket bracket = tests::bent(cell);
  const PlateCell found        = solve_plate_cell(glued(cell.mesh, cell.lattice), cell.stiffness);
  const double scale           = bracket.stiffness.cwiseAbs().maxCoeff();
  EXPECT_LT((found.stiffness - bracket.stiffness).cwiseAbs().maxCoeff(), 1e-9 * scale);
  // The glued vertices stand in the order of their first image; that of the bracket is zero at its
  // anchor, and not in the mean.
  const TorusMesh torus = glued(cell.mesh, cell.lattice);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    EXPECT_LT((found.deflection.row(3 * torus.vertex_of_original[static_cast<std::size_t>(v)]) -
               found.deflection.row(3 * torus.anchor) - bracket.deflection.row(v))
                .cwiseAbs()
                .maxCoeff(),
              1e-8 * bracket.deflection.cwiseAbs().maxCoeff());
}

// The slope is what the deflection between two vertices rises by, to the order of the triangle.
TEST(exact_plate_cell, slopes_belong_to_the_deflections)
{
  const tests::BracketCell cell = tests::stripes(2, 16, 10.);
  const TorusMesh torus         = glued(cell.mesh, cell.lattice);
  const PlateCell found         = solve_plate_cell(torus, cell.stiffness);
  // phi'' = D22^H / D22 − 1 across stripes, constant in each: phi' is linear there, to round-off.
  for (const TorusEdge &edge : torus.edges)
    for (int a = 0; a < 3; ++a)
    {
      const auto slope = [&](const int v) -> Eigen::Vector2d
      { return found.deflection.block<2, 1>(3 * v + 1, a); };
      const double rise = found.deflection(3 * edge.head, a) - found.deflection(3 * edge.tail, a);
      EXPECT_NEAR(rise, 0.5 * (slope(edge.tail) + slope(edge.head)).dot(edge.vector), 1e-9);
    }
  EXPECT_GT(found.deflection.bottomRows(torus.n_edges()).cwiseAbs().maxCoeff(), 1e-2);
}
