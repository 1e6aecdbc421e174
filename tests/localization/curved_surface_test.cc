// SPDX-License-Identifier: MIT
// Curved surfaces: between the coarse vertices of cylinders and spheres, with the deflection of the
// bent cell, and where nothing bends.
#include "localization/coarse_surface.h"
#include "localization/upsampler.h"
#include "tests/localization/garment_cases.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <functional>

using namespace homespun;
using namespace homespun::localization;

namespace
{
/// Where a point of the flat sheet lies on a bent one, and the unit normal there.
struct BentPoint
{
  Eigen::RowVector3d position, normal;
};
using Shape = std::function<BentPoint(const Eigen::RowVector2d &)>;

constexpr double radius = 0.05;

/// Rolled along a direction, which is isometric: K = t t^T / radius.
Shape cylinder(const double angle, const double radius)
{
  return [=](const Eigen::RowVector2d &point)
  {
    const double c = std::cos(angle), s = std::sin(angle), along = c * point(0) + s * point(1),
                 across = c * point(1) - s * point(0), a = along / radius;
    const Eigen::RowVector3d t(c, s, 0.), ruling(-s, c, 0.), up(0., 0., 1.);
    return BentPoint{radius * std::sin(a) * t + across * ruling + radius * (1. - std::cos(a)) * up,
                     std::cos(a) * up - std::sin(a) * t};
  };
}

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

Positions<3> moved(const meshes::Points &rest, const Shape &shape)
{
  Positions<3> current(rest.rows(), 3);
  for (Eigen::Index v = 0; v < rest.rows(); ++v)
    current.row(v) = shape(rest.row(v)).position;
  return current;
}

UpsamplerOptions with(const Surface surface, const bool microscopic,
                      const Path path = Path::automatic)
{
  UpsamplerOptions options;
  options.surface     = surface;
  options.microscopic = microscopic;
  options.path        = path;
  return options;
}

struct FineSurface
{
  Positions<3> positions, normals;
};

FineSurface curved(const tests::Cloth &cloth, const Positions<3> &current,
                   const UpsamplerOptions &options)
{
  const Upsampler<3, double> upsampler(cloth.cell, cloth.coarse, cloth.sheet, options);
  FineSurface fine;
  upsampler.upsample(current, fine.positions, fine.normals);
  return fine;
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

/// A cell without chi that deflects by smooth periodic functions when it is bent, zero at its
/// corners.
meshes::HomogenizedCell deflecting_cell(const meshes::Lattice &lattice, const int n)
{
  meshes::HomogenizedCell cell = tests::plain_cell(lattice, n, n);
  cell.bending.emplace();
  cell.bending->stiffness.setIdentity();
  cell.bending->deflection.resize(cell.mesh.n_vertices(), 3);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = 2. * M_PI * lattice.fractional(cell.mesh.vertices.row(v));
    cell.bending->deflection.row(v) << std::sin(f(0)) - std::sin(f(1)), 1. - std::cos(f(0) + f(1)),
      std::sin(f(0) - f(1)) + 0.5 * std::sin(f(1));
  }
  cell.bending->deflection *= 0.02 * lattice.area();
  return cell;
}

/// Slopes of the same by the same formulas, [a][c].
Eigen::Matrix<double, 3, 2> slopes_at(const meshes::Lattice &lattice,
                                      const Eigen::RowVector2d &point)
{
  const Eigen::RowVector2d f = 2. * M_PI * lattice.fractional(point);
  Eigen::Matrix<double, 3, 2> by_fraction;
  by_fraction << std::cos(f(0)), -std::cos(f(1)), std::sin(f(0) + f(1)), std::sin(f(0) + f(1)),
    std::cos(f(0) - f(1)), -std::cos(f(0) - f(1)) + 0.5 * std::cos(f(1));
  // d f / d x = (a1, a2)^-T
  return 0.02 * lattice.area() * 2. * M_PI * by_fraction * lattice.vectors.inverse().transpose();
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

// z = K11 w_1 + K22 w_2 + 2 K12 w_3 along the normal, and the slopes of it.
TEST(exact_curved_surface, a_bent_cell_deflects_by_its_modes_times_the_curvature)
{
  constexpr double angle = 0.6, large = 5.; // the sheet turns by less than a hundredth
  const double c = std::cos(angle), s = std::sin(angle);
  const Eigen::RowVector3d K = Eigen::RowVector3d(c * c, s * s, 2. * c * s) / large;
  const Shape shape          = cylinder(angle, large);
  double slope_error[2]      = {};
  for (const int level : {0, 1})
  {
    const tests::Cloth cloth(deflecting_cell(tests::skewed_lattice(), 12 * (1 + level)), 4, 3);
    const auto current        = moved(cloth.coarse.vertices, shape);
    const FineSurface without = curved(cloth, current, with(Surface::curved, false));
    for (const Path path : {Path::automatic, Path::general})
    {
      const FineSurface found = curved(cloth, current, with(Surface::curved, true, path));
      for (int v = 0; v < cloth.sheet.mesh.n_vertices(); ++v)
      {
        const BentPoint exact      = shape(cloth.sheet.mesh.vertices.row(v));
        const Eigen::RowVector3d w = cloth.cell.bending->deflection.row(cloth.sheet.cell_vertex(v));
        const double size          = K.norm() * 0.02 * cloth.cell.lattice.area();
        EXPECT_LT(
          (found.positions.row(v) - without.positions.row(v) - K.dot(w) * exact.normal).norm(),
          1e-4 * size);
        const Eigen::RowVector2d slope =
          K * slopes_at(cloth.cell.lattice, cloth.sheet.mesh.vertices.row(v) - cloth.sheet.origin);
        Eigen::RowVector3d tilt(slope(0), slope(1),
                                0.); // the tangents of such a sheet are its axes
        slope_error[level] = std::max(
          slope_error[level], (found.normals.row(v) - without.normals.row(v) + tilt).norm() /
                                (size / std::sqrt(cloth.cell.lattice.area())));
      }
    }
  }
  EXPECT_LT(slope_error[0], 0.15 * 2. * M_PI); // (2 pi / 12)²/6 = 0.05 for the longest waves
  EXPECT_NEAR(slope_error[0] / slope_error[1], 4., 0.7);
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

TEST(exact_curved_surface, both_paths_agree_also_where_a_coarse_mesh_halves_the_cells)
{
  tests::Cloth cloth(deflecting_cell(tests::skewed_lattice(), 8), 3, 4);
  for (const int quads : {1, 2})
  {
    cloth.coarse = meshes::coarse_sheet(cloth.sheet.origin, cloth.sheet.lattice.vectors / quads,
                                        3 * quads, 4 * quads);
    const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
    const FineSurface aligned  = curved(cloth, current, with(Surface::curved, true)),
                      general  = curved(cloth, current, with(Surface::curved, true, Path::general));
    EXPECT_LT((aligned.positions - general.positions).cwiseAbs().maxCoeff(), 1e-16);
    EXPECT_LT((aligned.normals - general.normals).cwiseAbs().maxCoeff(), 1e-11);
  }
}

TEST(exact_curved_surface, single_precision_gives_the_same_to_its_rounding)
{
  const tests::Cloth cloth(deflecting_cell(tests::skewed_lattice(), 8), 5, 4);
  const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
  const auto options         = with(Surface::curved, true);
  const FineSurface exact    = curved(cloth, current, options);
  const Upsampler<3, float> upsampler(cloth.cell, cloth.coarse, cloth.sheet, options);
  Upsampler<3, float>::Fine positions, normals;
  upsampler.upsample(current, positions, normals);
  // Sixteen roundings.
  EXPECT_LT((positions.cast<double>() - exact.positions).cwiseAbs().maxCoeff(),
            16. * 6e-8 * exact.positions.cwiseAbs().maxCoeff());
  EXPECT_LT((normals.cast<double>() - exact.normals).cwiseAbs().maxCoeff(), 3e-6);
  EXPECT_LT((normals.cast<double>().rowwise().norm().array() - 1.).abs().maxCoeff(), 1.2e-6);
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

TEST(invariant_curved_surface, what_is_missing_is_named)
{
  const tests::Cloth cloth = tests::skewed_cloth();
  EXPECT_NE(tests::refusal([&]() { curved(cloth, {}, with(Surface::curved, true)); })
              .find("has no deflection of a bent sheet"),
            std::string::npos);
  EXPECT_NE(tests::refusal([&]() { curved(cloth, {}, with(Surface::flat, true)); })
              .find("normals: the surface is that of flat triangles"),
            std::string::npos);
}

// Of panels that lie in frames of their own: a bent sheet cut in two is the bent sheet.
TEST(exact_curved_surface, panels_bend_like_the_sheet_that_they_are_of_and_seams_stay_closed)
{
  tests::Garment garment           = tests::two_panels();
  garment.cell.bending             = deflecting_cell(garment.cell.lattice, 7).bending;
  garment.cell.bending->deflection = meshes::Deflection::Zero(garment.cell.mesh.n_vertices(), 3);
  garment.cell.chi.setZero();
  const meshes::Points flat  = tests::flat_points(garment.fine);
  const Shape shape          = cylinder(0.4, 0.5);
  const Positions<3> current = moved(tests::TwoPanels().flat, shape);
  UpsamplerOptions options   = with(Surface::curved, true);
  const Positions<3> found   = garment.upsampled(current, options),
                     facets  = garment.upsampled(current);
  double of_found = 0., of_facets = 0.;
  for (int v = 0; v < garment.fine.n_vertices(); ++v)
  {
    const Eigen::RowVector3d exact = shape(flat.row(v)).position;
    if (garment.fine.seam_distance(v) < 0.012) // a coarse triangle
      continue;
    of_found  = std::max(of_found, (found.row(v) - exact).norm());
    of_facets = std::max(of_facets, (facets.row(v) - exact).norm());
  }
  EXPECT_GT(of_facets, 1e-5); // H²/8 R = 2.5e-5
  EXPECT_LT(of_found, 0.02 * of_facets);
  for (unsigned seed = 0; seed < 3; ++seed)
    EXPECT_LT(
      garment.seam_gap(garment.upsampled(tests::random_motion(garment.coarse, seed), options)),
      1e-16);
}
