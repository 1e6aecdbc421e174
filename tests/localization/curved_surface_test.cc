// SPDX-License-Identifier: MIT
// Curved surfaces between the coarse vertices of cylinders and spheres, and where nothing bends.
#include "localization/coarse_surface.h"
#include "tests/localization/curved_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace homespun;
using namespace homespun::localization;

namespace
{
/// The cap of a sphere, by distance from its pole.
BentPoint on_sphere(const Eigen::RowVector2d &point)
{
  const double r = point.norm(), a = r / radius;
  Eigen::RowVector3d out(0., 0., 0.);
  if (r > 0.)
    out.head<2>() = point / r;
  const Eigen::RowVector3d up(0., 0., 1.);
  return {radius * std::sin(a) * out + radius * (1. - std::cos(a)) * up,
          std::cos(a) * up - std::sin(a) * out};
}

/// Largest errors over a sheet of n x n cells, 4 cm wide about the origin.
struct ShapeErrors
{
  double flat, position, distance, normal;
};

ShapeErrors errors_of(const int n, const Shape &shape, const Eigen::RowVector3d &height)
{
  const double side = 0.04 / n;
  tests::Cloth cloth(tests::plain_cell(tests::square_lattice(side), 4, 4), n, n);
  const Eigen::RowVector2d middle(0.02, 0.02);
  const auto centred      = [&](const Eigen::RowVector2d &point) { return shape(point - middle); };
  const auto current      = moved(cloth.coarse.vertices, centred);
  const auto flat         = tests::upsampled<3>(cloth, current, with(Surface::flat, false));
  const FineSurface found = curved(cloth, current, with(Surface::curved, false));
  ShapeErrors errors      = {};
  // Distance from the cylinder or sphere about the centre of curvature of the pole.
  const Eigen::RowVector3d centre(0., 0., radius);
  const auto distance = [&](const Eigen::RowVector3d &x)
  { return std::abs((x - centre).cwiseProduct(height).norm() - radius); };
  for (int v = 0; v < cloth.sheet.mesh.n_vertices(); ++v)
  {
    const BentPoint exact = centred(cloth.sheet.mesh.vertices.row(v));
    const auto raise      = [](double &largest, const double error)
    { largest = std::max(largest, error); };
    raise(errors.flat, distance(flat.row(v)));
    raise(errors.position, (found.positions.row(v) - exact.position).norm());
    raise(errors.distance, distance(found.positions.row(v)));
    raise(errors.normal, (found.normals.row(v) - exact.normal).norm());
  }
  return errors;
}

std::vector<double> orders_of(const Shape &shape, const Eigen::RowVector3d &height,
                              double ShapeErrors::*error)
{
  std::vector<double> orders;
  double before = 0.;
  for (const int n : {8, 16, 32, 64})
  {
    const double now = errors_of(n, shape, height).*error;
    if (before > 0.)
      orders.push_back(std::log2(before / now));
    before = now;
  }
  return orders;
}

bool are_same_bits(const Positions<3> &a, const Positions<3> &b)
{
  return a.rows() == b.rows() && std::equal(a.data(), a.data() + a.size(), b.data(),
                                            [](const double x, const double y)
                                            { return std::memcmp(&x, &y, sizeof(double)) == 0; });
}
} // namespace

// Third derivatives are all that is not exact: z = ½ X.A X on a mesh without any order in it.
TEST(exact_curved_surface, curvature_and_normal_of_a_quadratic_deflection_are_exact_on_any_mesh)
{
  meshes::TriangleMesh mesh =
    meshes::coarse_sheet({0.3, -0.1}, tests::skewed_lattice().vectors, 6, 5);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> random(-0.2, 0.2);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    mesh.vertices.row(v) +=
      Eigen::RowVector2d(random(generator), random(generator)) * tests::skewed_lattice().vectors;
  Eigen::Matrix2d A;
  A << 3., -2., -2., 5.;
  Positions<3> current(mesh.n_vertices(), 3);
  current << mesh.vertices, Eigen::VectorXd::Zero(mesh.n_vertices());
  for (int v = 0; v < mesh.n_vertices(); ++v)
    current(v, 2) = 0.5 * mesh.vertices.row(v) * A * mesh.vertices.row(v).transpose();
  CoarseSurface surface(mesh);
  const auto &rows = surface.values(PositionsOf<3>(current.data(), current.rows(), 3));
  for (int v = 0; v < mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d slope  = mesh.vertices.row(v) * A;
    const Eigen::RowVector3d normal = Eigen::RowVector3d(-slope(0), -slope(1), 1.).normalized();
    EXPECT_LT(
      (rows.row(v).head<3>() - normal(2) * Eigen::RowVector3d(A(0, 0), A(1, 1), 2. * A(0, 1)))
        .norm(),
      1e-9);
    EXPECT_LT((rows.row(v).segment<3>(3) - normal).norm(), 1e-11);
  }
}

// Round the tip of a slit without width two vertices lie in one place at rest.
TEST(exact_curved_surface, curvature_is_exact_beside_a_slit)
{
  meshes::TriangleMesh mesh =
    meshes::coarse_sheet({0., 0.}, tests::square_lattice(1.).vectors, 6, 6);
  // Cut along the line from the edge to the middle: triangles above it get vertices of their own.
  const int n = mesh.n_vertices();
  std::vector<int> above(static_cast<std::size_t>(n), -1);
  int n_vertices = n;
  for (int v = 0; v < n; ++v)
    if (mesh.vertices(v, 1) == 3. && mesh.vertices(v, 0) < 2.5)
      above[static_cast<std::size_t>(v)] = n_vertices++;
  mesh.vertices.conservativeResize(n_vertices, 2);
  for (int v = 0; v < n; ++v)
    if (above[static_cast<std::size_t>(v)] >= 0)
      mesh.vertices.row(above[static_cast<std::size_t>(v)]) = mesh.vertices.row(v);
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    double height = 0.;
    for (int k = 0; k < 3; ++k)
      height += mesh.vertices(mesh.triangles(t, k), 1) / 3.;
    for (int k = 0; k < 3 && height > 3.; ++k)
      if (const int its = above[static_cast<std::size_t>(mesh.triangles(t, k))]; its >= 0)
        mesh.triangles(t, k) = its;
  }
  ASSERT_EQ(n_vertices, n + 3);
  Positions<3> current(n_vertices, 3);
  current << mesh.vertices, mesh.vertices.col(0).cwiseProduct(mesh.vertices.col(1));
  CoarseSurface surface(mesh);
  const auto &rows = surface.values(PositionsOf<3>(current.data(), current.rows(), 3));
  for (int v = 0; v < n_vertices; ++v)
  {
    const double n3 =
      1. / std::sqrt(1. + mesh.vertices.row(v).squaredNorm()); // of the normal of z = x y
    EXPECT_LT((rows.row(v).head<3>() - Eigen::RowVector3d(0., 0., 2. * n3)).norm(), 1e-9) << v;
  }
}

// kappa H²/8 is what a chord cuts off. The normal of a cylinder is off by what sin(a u) differs
// from u sin(a), the place along it too: third order; the distance has the square of the
// curvature's.
TEST(order_curved_surface, a_cylinder_is_met_with_the_fourth_power_of_the_coarse_side)
{
  const Eigen::RowVector3d height(1., 0., 1.);
  const ShapeErrors of_ten = errors_of(10, cylinder(0., radius), height);
  EXPECT_NEAR(of_ten.flat / (0.004 * 0.004 / (8. * radius)), 1., 0.01);
  const auto expect = [&](double ShapeErrors::*error, const double order)
  {
    for (const double found : orders_of(cylinder(0., radius), height, error))
      EXPECT_NEAR(found, order, 0.15);
  };
  expect(&ShapeErrors::flat, 2.);
  expect(&ShapeErrors::position, 3.);
  expect(&ShapeErrors::distance, 4.);
  expect(&ShapeErrors::normal, 3.);
}

TEST(order_curved_surface, a_sphere_is_met_with_the_third_power_and_its_normals_with_the_second)
{
  const Eigen::RowVector3d height(1., 1., 1.);
  const auto last = [&](double ShapeErrors::*error)
  { return orders_of(on_sphere, height, error).back(); };
  EXPECT_NEAR(last(&ShapeErrors::flat), 2., 0.15);
  EXPECT_GT(last(&ShapeErrors::distance), 2.85); // third and fourth powers
  EXPECT_LT(last(&ShapeErrors::distance), 4.15);
  EXPECT_NEAR(last(&ShapeErrors::normal), 2., 0.15);
  const ShapeErrors of_twenty = errors_of(20, on_sphere, height);
  EXPECT_LT(of_twenty.distance, 0.05 * of_twenty.flat);
}

TEST(invariant_curved_surface, what_lies_in_a_plane_stays_as_it_is_to_the_bit)
{
  tests::Cloth cloth(deflecting_cell(tests::skewed_lattice(), 6), 5, 4);
  cloth.cell.bending->deflection *= 1e3; // so that the rounding of the curvature would be seen
  const Eigen::Matrix3d R =
    Eigen::AngleAxisd(1.1, Eigen::Vector3d(1., -2., 0.5).normalized()).toRotationMatrix();
  Positions<3> level = tests::wavy_motion<3>(cloth.coarse.vertices);
  level.col(2).setConstant(0.3);
  for (const Positions<3> &current : {level, Positions<3>(level * R.transpose())})
    for (const Path path : {Path::automatic, Path::general})
      for (const bool microscopic : {true, false})
      {
        const auto flat =
          tests::upsampled<3>(cloth, current, with(Surface::flat, microscopic, path));
        const FineSurface found = curved(cloth, current, with(Surface::curved, microscopic, path));
        EXPECT_TRUE(are_same_bits(flat, found.positions));
        EXPECT_TRUE(are_same_bits(
          flat, tests::upsampled<3>(cloth, current, with(Surface::curved, microscopic, path))));
        EXPECT_LT((found.normals.rowwise() - found.normals.row(0)).cwiseAbs().maxCoeff(), 1e-12);
      }
  // And what is bent does not.
  const Positions<3> bent = tests::wavy_motion<3>(cloth.coarse.vertices);
  EXPECT_FALSE(are_same_bits(tests::upsampled<3>(cloth, bent, with(Surface::flat, true)),
                             tests::upsampled<3>(cloth, bent, with(Surface::curved, true))));
}

TEST(invariant_curved_surface, a_rigid_motion_turns_positions_and_normals)
{
  const tests::Cloth cloth(deflecting_cell(tests::skewed_lattice(), 6), 5, 4);
  const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
  const Eigen::RowVector3d far(0.2, -0.1, 0.4);
  for (const double angle : {0.4, 1.9, 3.1415926535897931})
  {
    const Eigen::Matrix3d R =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(1., -2., 0.5).normalized()).toRotationMatrix();
    const auto options       = with(Surface::curved, true);
    const FineSurface before = curved(cloth, current, options),
                      after  = curved(cloth, (current * R.transpose()).rowwise() + far, options);
    EXPECT_LT((after.positions - ((before.positions * R.transpose()).rowwise() + far))
                .cwiseAbs()
                .maxCoeff(),
              1e-14);
    EXPECT_LT((after.normals - before.normals * R.transpose()).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT((before.normals.rowwise().norm().array() - 1.).abs().maxCoeff(), 1e-15 * 4.);
  }
}

TEST(invariant_curved_surface, a_collapsed_cloth_stays_finite)
{
  const tests::Cloth cloth(deflecting_cell(tests::skewed_lattice(), 6), 3, 3);
  Positions<3> line = tests::wavy_motion<3>(cloth.coarse.vertices), point = line;
  line.rightCols<2>().setZero();
  point.setConstant(0.1);
  for (const Positions<3> &current : {line, point})
  {
    const FineSurface found = curved(cloth, current, with(Surface::curved, true));
    EXPECT_TRUE(found.positions.allFinite() && found.normals.allFinite());
    EXPECT_EQ(found.normals.cwiseAbs().maxCoeff(), 0.);
  }
  // Of one cell there are no curvatures, but normals.
  const tests::Cloth one(deflecting_cell(tests::skewed_lattice(), 6), 1, 1);
  const FineSurface found =
    curved(one, tests::wavy_motion<3>(one.coarse.vertices), with(Surface::curved, true));
  EXPECT_GT(found.normals.rowwise().norm().minCoeff(), 0.9);
}
