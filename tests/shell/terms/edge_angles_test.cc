// SPDX-License-Identifier: MIT
#include "shell/terms/edge_angles.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/symmetric_eigen.h"
#include "shell/terms/bending.h"
#include "tests/refusal.h"
#include "tests/shell/terms/plate_cases.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace homespun;
using namespace homespun::shell;
using homespun::tests::AnglesPlate;
using homespun::tests::Bump;
using homespun::tests::Deflection;
using homespun::tests::PlateFault;
using homespun::tests::refusal;

namespace
{
const PlateStiffness stiff{9e-6, 5e-6, 1e-6, 3e-6, -1e-6, 4e-7};

Eigen::Vector3d unit(const int a)
{
  return Eigen::Vector3d::Unit(a);
}

/// κ in phase 1 if it is κ in phase 0, sheet and moment across x = ½ continuous.
Eigen::Vector3d across(const Eigen::Vector3d &kappa, const PlateStiffness &D0,
                       const PlateStiffness &D1)
{
  Eigen::Vector3d other = kappa;
  const double moment   = D0.matrix().row(0).dot(kappa);
  other(0)              = (moment - D1.D12 * kappa(1) - D1.D16 * kappa(2)) / D1.D11;
  return other;
}

/// Constant curvature on both sides of x = ½.
Deflection two_parabolas(const Eigen::Vector3d &left, const Eigen::Vector3d &right)
{
  const auto of = [=](const double s) { return s > 0. ? right : left; };
  return {[=](const Eigen::RowVector2d &x)
          {
            const double s = x(0) - 0.5;
            return 0.5 * of(s)(0) * s * s + 0.5 * left(1) * x(1) * x(1) + 0.5 * left(2) * s * x(1);
          },
          [=](const Eigen::RowVector2d &x)
          {
            const double s = x(0) - 0.5;
            return Eigen::RowVector2d(of(s)(0) * s + 0.5 * left(2) * x(1),
                                      left(1) * x(1) + 0.5 * left(2) * s);
          }};
}

/// Largest error of deflections that a clamped outline asks to be a given one, over their size.
double error_of(const meshes::TriangleMesh &mesh, const Eigen::VectorXd &z, const Deflection &exact)
{
  double worst = 0., size = 0.;
  for (int v = 0; v < mesh.n_vertices(); ++v)
  {
    const double value = exact.value(mesh.vertices.row(v));
    worst              = std::max(worst, std::abs(z(v) - value));
    size               = std::max(size, std::abs(value));
  }
  return worst / size;
}

std::map<int, double> outline_values(const meshes::TriangleMesh &mesh, const Deflection &exact)
{
  std::map<int, double> held;
  for (const int v : tests::outline_of(mesh))
    held[v] = exact.value(mesh.vertices.row(v));
  return held;
}

/// The patch test of the second writing, with a fault or none.
double patch_error(const meshes::TriangleMesh &mesh, const std::vector<PlateStiffness> &D,
                   const Deflection &exact, const PlateFault fault)
{
  const AnglesPlate plate(mesh, D, fault);
  std::map<int, double> given = outline_values(mesh, exact);
  for (const auto &edge : tests::outline_edges(mesh))
    given[plate.unknown_of(edge)] = tests::outward_slope(mesh, edge, exact);
  return error_of(mesh, plate.minimum(given), exact);
}

Eigen::VectorXd lumped_loads(const meshes::TriangleMesh &mesh, const Bump &bump,
                             const PlateStiffness &D)
{
  const AnglesPlate plate(mesh, {D, D});
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(mesh.n_vertices());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int v = mesh.triangles(t, k);
      loads(v) += plate.area(t) / 3. * bump.load(mesh.vertices.row(v), D);
    }
  return loads;
}

/// Relative errors of a plate: root mean square of the deflections, and in the energy norm.
struct PlateErrors
{
  double position = 0., energy = 0.;
};
PlateErrors errors_of(const meshes::TriangleMesh &mesh, const Bump &bump, const PlateStiffness &D)
{
  const Deflection exact = bump.deflection();
  const auto clamps = bump.is_clamped ? tests::clamps_of(mesh, exact) : std::vector<ClampedEdge>();
  const auto term   = edge_angles_term(tests::lying(mesh), {D, D}, clamps);
  const Eigen::VectorXd z =
    tests::deflected(mesh, *term, outline_values(mesh, exact), lumped_loads(mesh, bump, D));
  const AnglesPlate plate(mesh, {D, D});
  std::map<int, double> given;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    given[v] = z(v);
  if (bump.is_clamped)
    for (const auto &edge : tests::outline_edges(mesh))
      given[plate.unknown_of(edge)] = 0.;
  const Eigen::VectorXd kappa = plate.curvature * plate.minimum(given);
  double error = 0., size = 0., energy = 0., whole = 0.;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int v = mesh.triangles(t, k);
      const Eigen::RowVector2d middle =
        0.5 * (mesh.vertices.row(v) + mesh.vertices.row(mesh.triangles(t, (k + 1) % 3)));
      const Eigen::Vector3d its = bump.curvature(middle), off = kappa.segment<3>(3 * t) - its;
      const double weight = plate.area(t) / 3., value = exact.value(mesh.vertices.row(v));
      error += weight * std::pow(z(v) - value, 2);
      size += weight * value * value;
      energy += weight * off.dot(D.matrix() * off);
      whole += weight * its.dot(D.matrix() * its);
    }
  return {std::sqrt(error / size), std::sqrt(energy / whole)};
}

/// Folded about x = ½.
Vectors folded(const meshes::ClothMesh &mesh, const double degrees)
{
  const double c = std::cos(degrees * M_PI / 180.), s = std::sin(degrees * M_PI / 180.);
  Vectors x = mesh.positions;
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    if (const double far = x(v, 0) - 0.5; far > 0.)
      x.row(v) << 0.5 + c * far, x(v, 1), s * far;
  return x;
}
} // namespace

TEST(exact_edge_angles, constant_curvatures_are_kept_on_every_mesh_where_the_stiffness_jumps_too)
{
  for (const std::string &kind : tests::plate_meshes)
    for (const int n : {4, 10})
    {
      const meshes::TriangleMesh mesh = tests::plate_mesh(kind, n);
      double worst                    = 0.;
      for (int a = 0; a < 3; ++a)
        for (const PlateStiffness &right : {tests::skewed_plate, stiff})
        {
          const Deflection exact =
            two_parabolas(unit(a), across(unit(a), tests::skewed_plate, right));
          const auto term = edge_angles_term(tests::lying(mesh), {tests::skewed_plate, right},
                                             tests::clamps_of(mesh, exact));
          const Eigen::VectorXd z = tests::deflected(mesh, *term, outline_values(mesh, exact),
                                                     Eigen::VectorXd::Zero(mesh.n_vertices()));
          worst                   = std::max(worst, error_of(mesh, z, exact));
        }
      std::cout << kind << ", n " << n << ": " << worst << '\n';
      EXPECT_LT(worst, 1e-11);
    }
}

TEST(exact_edge_angles,
     the_form_in_both_unknowns_has_the_same_energy_and_hessian_and_moments_the_energy)
{
  for (const std::string &kind : tests::plate_meshes)
  {
    const meshes::TriangleMesh mesh = tests::plate_mesh(kind, 4);
    meshes::ClothMesh cloth         = tests::lying(mesh);
    const auto term                 = edge_angles_term(cloth, {tests::skewed_plate, stiff});
    BlockMatrix matrix              = tests::matrix_for(*term, mesh.n_vertices());
    Vectors unused                  = Vectors::Zero(mesh.n_vertices(), 3);
    term->add_derivatives(cloth.positions, Hessian::projected, unused, matrix);
    const Eigen::MatrixXd hessian = tests::dense(matrix, mesh.n_vertices());
    std::mt19937 generator(11);
    const Vectors z = 1e-5 * tests::random_matrix<Vectors>(generator, mesh.n_vertices(), 3);
    std::map<int, double> given;
    Vectors bent = cloth.positions, only_z = 0. * z;
    for (int v = 0; v < mesh.n_vertices(); ++v)
    {
      given[v]     = z(v, 2);
      bent(v, 2)   = z(v, 2);
      only_z(v, 2) = z(v, 2);
    }
    const AnglesPlate plate(mesh, {tests::skewed_plate, stiff});
    const double energy = plate.energy(plate.minimum(given));
    const Eigen::Map<const Eigen::VectorXd> along(only_z.data(), only_z.size());
    EXPECT_NEAR(0.5 * along.dot(hessian * along), energy, 1e-11 * energy);
    EXPECT_NEAR(term->energy(bent), energy, 1e-7 * energy); // deflections are small
    cloth.positions                = bent;
    const Eigen::MatrixX3d moments = bending_moments(cloth, {tests::skewed_plate, stiff}, {});
    double of_moments              = 0.;
    for (int t = 0; t < mesh.n_triangles(); ++t)
      of_moments += 0.5 * meshes::signed_areas(mesh)(t) * moments.row(t) *
                    (mesh.material(t) == 0 ? tests::skewed_plate : stiff).matrix().inverse() *
                    moments.row(t).transpose();
    EXPECT_NEAR(of_moments, term->energy(bent), 1e-11 * energy);
  }
}

TEST(tripwire_edge_angles,
     a_wrong_sign_half_an_angle_and_the_stiffness_next_door_fail_the_patch_test)
{
  const meshes::TriangleMesh mesh = tests::plate_mesh("alternating", 8);
  for (const auto &[fault, least] : {std::pair{PlateFault::sign_of_phi, 1e-3},
                                     {PlateFault::half_of_outline, 1e-3},
                                     {PlateFault::neighbours_stiffness, 1e-3}})
  {
    double worst = 0.;
    for (int a = 0; a < 3; ++a)
      worst = std::max(
        worst,
        patch_error(mesh, {tests::skewed_plate, stiff},
                    two_parabolas(unit(a), across(unit(a), tests::skewed_plate, stiff)), fault));
    std::cout << "fault " << static_cast<int>(fault) << ": " << worst << '\n';
    EXPECT_GT(worst, least);
  }
  for (int a = 0; a < 3; ++a)
    EXPECT_LT(patch_error(mesh, {tests::skewed_plate, stiff},
                          two_parabolas(unit(a), across(unit(a), tests::skewed_plate, stiff)),
                          PlateFault::none),
              1e-11);
}

TEST(order_edge_angles, deflections_converge_with_order_two_and_curvatures_with_one_on_every_mesh)
{
  const PlateStiffness woven{3e-6, 1e-6, 2e-7, 4e-7};
  for (const bool is_clamped : {false, true})
    for (const std::string &kind : tests::plate_meshes)
      for (const PlateStiffness &D : {PlateStiffness::isotropic(1e-6, 0.3), woven})
      {
        std::vector<double> widths, positions, energies;
        for (const int n : {8, 16, 32, 64})
        {
          const PlateErrors errors = errors_of(tests::plate_mesh(kind, n), {is_clamped}, D);
          widths.push_back(1. / n);
          positions.push_back(errors.position);
          energies.push_back(errors.energy);
        }
        const double of_position = tests::slope(widths, positions),
                     of_energy   = tests::slope(widths, energies);
        std::cout << kind << (is_clamped ? ", clamped" : ", supported") << ", D11/D22 "
                  << D.D11 / D.D22 << ": " << positions[0] << ' ' << positions[1] << ' '
                  << positions[2] << ' ' << positions[3] << ", order " << of_position
                  << ", in energy " << of_energy << '\n';
        EXPECT_NEAR(of_position, 2., 0.15);
        EXPECT_NEAR(of_energy, 1., 0.1);
      }
}

TEST(invariant_edge_angles, a_laminate_that_is_stretched_in_its_plane_pays_nothing)
{
  for (const std::string &kind : tests::plate_meshes)
  {
    const meshes::ClothMesh mesh = tests::lying(tests::plate_mesh(kind, 10));
    const auto term              = edge_angles_term(mesh, {tests::skewed_plate, stiff});
    Vectors x                    = tests::crumpled(mesh, 0.02);
    const double bent            = term->energy(x);
    const double force           = tests::gradient_of(*term, x).norm();
    x.col(2).setZero();
    EXPECT_EQ(term->energy(x), 0.);
    EXPECT_EQ(tests::gradient_of(*term, x).norm(), 0.);
    x = (x * tests::rotation<3>(1.).transpose()).eval(); // a plane that is not one of axes
    EXPECT_LT(term->energy(x), 1e-14 * bent);
    EXPECT_LT(tests::gradient_of(*term, x).norm(), 1e-12 * force);
  }
}

TEST(invariant_edge_angles, a_rigid_motion_turns_the_forces_which_have_no_resultant_and_no_torque)
{
  const meshes::ClothMesh mesh = tests::lying(tests::plate_mesh("Delaunay", 6));
  const auto term              = edge_angles_term(mesh, {tests::skewed_plate, stiff});
  for (const Vectors &x : {tests::crumpled(mesh, 0.04), folded(mesh, 170.)})
  {
    const Eigen::Matrix3d Q = tests::rotation<3>(2.);
    const Vectors moved     = (x * Q.transpose()).rowwise() + Eigen::RowVector3d(0.1, -0.2, 0.3);
    const Vectors gradient  = tests::gradient_of(*term, x);
    const double size       = gradient.rowwise().norm().sum();
    ASSERT_GT(size, 0.);
    EXPECT_NEAR(term->energy(moved), term->energy(x), 1e-12 * term->energy(x));
    EXPECT_LT((tests::gradient_of(*term, moved) - gradient * Q.transpose()).norm(), 1e-11 * size);
    EXPECT_LT(gradient.colwise().sum().norm(), 1e-13 * size);
    EXPECT_LT(tests::torque(x, gradient).norm(), 1e-13 * size);
  }
}

TEST(derivative_edge_angles, remainders_have_orders_two_and_three_flat_crumpled_and_folded)
{
  const meshes::ClothMesh mesh = tests::lying(tests::plate_mesh("Delaunay", 4));
  const auto term              = edge_angles_term(mesh, {tests::skewed_plate, stiff});
  std::mt19937 generator(5);
  const Vectors direction = 0.05 * tests::random_matrix<Vectors>(generator, mesh.n_vertices(), 3);
  EXPECT_EQ(term->energy(mesh.positions), 0.);
  EXPECT_EQ(tests::gradient_of(*term, mesh.positions).norm(), 0.);
  for (const Vectors &x : {mesh.positions, tests::crumpled(mesh, 0.04), folded(mesh, 170.)})
  {
    const tests::TaylorOrders orders = tests::taylor_orders(*term, x, direction);
    std::cout << "orders " << orders.gradient << ' ' << orders.hessian << '\n';
    EXPECT_NEAR(orders.gradient, 2., 0.1);
    EXPECT_NEAR(orders.hessian, 3., 0.15);
    BlockMatrix matrix = tests::matrix_for(*term, mesh.n_vertices());
    Vectors gradient   = Vectors::Zero(mesh.n_vertices(), 3);
    term->add_derivatives(x, Hessian::projected, gradient, matrix);
    EXPECT_LT((gradient - tests::gradient_of(*term, x)).norm(), 1e-15 * gradient.norm() + 1e-300);
    const Eigen::MatrixXd all   = tests::dense(matrix, mesh.n_vertices());
    const Eigen::VectorXd modes = meshes::symmetric_eigen<Eigen::Dynamic>(all).values;
    EXPECT_GT(modes.minCoeff(), -1e-13 * modes.maxCoeff());
  }
}

// Pure twist is a state of a free plate under forces at its four corners, whatever its mesh.
TEST(exact_edge_angles, a_square_twisted_by_its_corners_measures_D66)
{
  const PlateStiffness D{3e-6, 1e-6, 2e-7, 4e-7};
  for (const std::string &kind : tests::plate_meshes)
  {
    const int n                     = 8;
    const meshes::TriangleMesh mesh = tests::plate_mesh(kind, n);
    const auto term                 = edge_angles_term(tests::lying(mesh), {D, D});
    Eigen::VectorXd loads           = Eigen::VectorXd::Zero(mesh.n_vertices());
    const int far                   = (n + 1) * (n + 1) - 1;
    loads(far)                      = 1e-6;
    const Eigen::VectorXd z =
      tests::deflected(mesh, *term, {{0, 0.}, {n, 0.}, {far - n, 0.}}, loads);
    EXPECT_NEAR(z(far), loads(far) / (4. * D.D66), 1e-9 * z(far)); // force 2 M12 = 4 D66 κ12
  }
}

TEST(exact_edge_angles, a_closed_cylinder_has_the_energy_of_its_moment)
{
  // Moments D11/R, none across: the rims are free of any.
  const PlateStiffness D{3e-6, 4e-7, 0., 2e-7};
  for (const char *kind : {"one diagonal", "alternating"})
  {
    const int n            = 12;
    const double radius    = 1. / (2. * M_PI);
    meshes::ClothMesh mesh = tests::lying(tests::plate_mesh(kind, n));
    const auto around      = [n](const int v) { return v / (n + 1) * n + v % (n + 1) % n; };
    mesh.positions.resize(n * (n + 1), 3);
    for (int v = 0; v < mesh.rest.n_vertices(); ++v)
    {
      const double angle = mesh.rest.vertices(v, 0) / radius;
      mesh.positions.row(around(v)) << radius * std::sin(angle), mesh.rest.vertices(v, 1),
        radius * (1. - std::cos(angle));
    }
    mesh.triangles     = mesh.rest.triangles.unaryExpr(around);
    const double exact = 0.5 * D.D11 / (radius * radius);
    EXPECT_NEAR(edge_angles_term(mesh, {D, D})->energy(mesh.positions), exact, 1e-12 * exact);
  }
}

TEST(tripwire_edge_angles, faults_are_named)
{
  const meshes::ClothMesh good = tests::lying(tests::plate_mesh("alternating", 3));
  EXPECT_NE(refusal([&] { edge_angles_term(good, {tests::skewed_plate}); }).find("has phase 1"),
            std::string::npos);
  EXPECT_NE(refusal(
              [&] {
                edge_angles_term(good, {tests::skewed_plate, {1., 1., 1., 1.}});
              })
              .find("D12^2 < D11 D22"),
            std::string::npos);
  EXPECT_NE(refusal(
              [&] {
                edge_angles_term(good, {tests::skewed_plate, stiff}, {{5, 6, {0., 0., 1.}}});
              })
              .find("is not at the outline"),
            std::string::npos);
  EXPECT_NE(refusal(
              [&] {
                edge_angles_term(good, {tests::skewed_plate, stiff}, {{0, 1, {0., 0., 0.}}});
              })
              .find("has no normal"),
            std::string::npos);
  Vectors x       = good.positions;
  x.row(5)        = 0.5 * (x.row(0) + x.row(1)); // a triangle becomes a line
  const auto term = edge_angles_term(good, {tests::skewed_plate, stiff});
  EXPECT_TRUE(std::isinf(term->energy(x)));
  EXPECT_NE(term->why_infinite(x).find("a line without a normal"), std::string::npos);
  EXPECT_TRUE(tests::gradient_of(*term, x).allFinite());
}
