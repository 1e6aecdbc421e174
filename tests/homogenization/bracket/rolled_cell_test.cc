// SPDX-License-Identifier: MIT
// A rolled cell against the geometry of surfaces in space and against stripes, whose deflection is
// a function of one coordinate that can be solved for at any radius.
#include "homogenization/bracket/rolled_cell.h"
#include "tests/homogenization/bracket/bending_cells.h"
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
constexpr double nu = 0.3, side = 0.01, thickness = 5e-4; // of `layered`, E 1e6 and 1e7

Eigen::Vector3d of_cylinder(const double angle)
{
  return {std::pow(std::cos(angle), 2), std::pow(std::sin(angle), 2), std::sin(2. * angle)};
}

RolledCell rolled_stripes(const int n)
{
  const tests::BracketCell cell = tests::bracket_cell(
    tests::square_lattice(side), n, n, {}, [](double, double f2) { return f2 < 0.5 ? 0 : 1; });
  const auto of       = [](const double E) { return tests::plate(E, nu, thickness); };
  const auto membrane = [](const double E)
  { return Eigen::Matrix3d(thickness * tests::isotropic_stiffness(E, nu)); };
  return rolled_cell(glued(cell.mesh, cell.lattice), {of(1e6), of(1e7)},
                     {membrane(1e6), membrane(1e7)});
}

/// D_eff(R) / D^H_nn of stripes: phi of the coordinate across them alone, by differences on n
/// points; across the stripes and in shear the sheet gives way, so that only E t (e11 − phi K11) is
/// left.
double stiffening_of_stripes(const double angle, const double radius)
{
  constexpr int n         = 400;
  constexpr double h      = side / n;
  const Eigen::Vector3d K = of_cylinder(angle);
  // Unknowns: n values of phi and the mean strain; phi is anchored by the mean strain.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 1, n + 1);
  Eigen::VectorXd right  = Eigen::VectorXd::Zero(n + 1);
  double alone           = 0.;
  for (int i = 0; i < n; ++i)
  {
    const double E          = i < n / 2 ? 1e6 : 1e7;
    const Eigen::Matrix3d D = tests::plate(E, nu, thickness);
    Eigen::VectorXd second = Eigen::VectorXd::Zero(n + 1), stretch = Eigen::VectorXd::Zero(n + 1);
    second((i + n - 1) % n) = second((i + 1) % n) = 1. / (h * h);
    second(i)                                     = -2. / (h * h);
    stretch(i)                                    = -K(0) / radius;
    stretch(n)                                    = 1.;
    matrix +=
      D(1, 1) * second * second.transpose() / n + E * thickness * stretch * stretch.transpose() / n;
    right -= (D * K)(1) * second / n;
    alone += K.dot(D * K) / n;
  }
  return alone - right.dot(matrix.ldlt().solve(right));
}
} // namespace

// A sheet that is moved to y + v, w with w = ½ k s² + phi, s = n.y, v = −(k² s³/6 + k s phi) n has
// the strain e up to (grad v)², of fourth order in k.
TEST(exact_rolled_cell, strain_is_that_of_a_surface_in_space)
{
  const double angle = 0.4;
  const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d at(0.3, -0.7);
  std::vector<double> wrong;
  for (const double k : {0.1, 0.05})
  {
    const auto phi = [&](const Eigen::Vector2d &y)
    { return k * std::sin(2. * y(0) + 0.3) * std::cos(y(1)); };
    const auto surface = [&](const Eigen::Vector2d &y)
    {
      const double s              = n.dot(y);
      const Eigen::Vector2d moved = y - (k * k * s * s * s / 6. + k * s * phi(y)) * n;
      return Eigen::Vector3d(moved(0), moved(1), 0.5 * k * s * s + phi(y));
    };
    constexpr double h = 1e-4;
    Eigen::Matrix<double, 3, 2> F;
    Eigen::Vector2d gradient;
    for (int j = 0; j < 2; ++j)
    {
      const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(j);
      F.col(j)                   = (surface(at + step) - surface(at - step)) / (2. * h);
      gradient(j)                = (phi(at + step) - phi(at - step)) / (2. * h);
    }
    const Eigen::Matrix2d green = 0.5 * (F.transpose() * F - Eigen::Matrix2d::Identity());
    const Eigen::Vector3d exact(green(0, 0), green(1, 1), 2. * green(0, 1));
    const Eigen::Vector3d K = k * of_cylinder(angle);
    wrong.push_back((strain_of_deflection(K, phi(at), gradient) - exact).norm());
    EXPECT_LT(wrong.back(), 0.1 * exact.norm());
  }
  EXPECT_NEAR(std::log2(wrong[0] / wrong[1]), 4., 0.1);
}

TEST(exact_rolled_cell, stripes_are_those_of_one_coordinate)
{
  const RolledCell rolled = rolled_stripes(16);
  for (const double angle : {0., 0.5, 0.25 * M_PI, 1.2})
  {
    const Eigen::Vector3d K = of_cylinder(angle);
    const double flat       = K.dot(rolled.stiffness * K);
    const auto exact        = [&](const double radius)
    { return stiffening_of_stripes(angle, radius) / flat; };
    // Far out the bound is what happens; nearer, it is one.
    EXPECT_NEAR(exact(0.2), rolled.most(angle, 0.2), 0.02 * (rolled.most(angle, 0.2) - 1.) + 2e-5);
    for (const double radius : {0.03, 0.01, 0.003, 1e-3})
    {
      EXPECT_LT(exact(radius), rolled.most(angle, radius) * (1. + 1e-4)) << angle << ", " << radius;
      EXPECT_GT(exact(radius), 1. - 1e-4);
    }
  }
}

TEST(exact_rolled_cell, stripes_without_stretching_have_the_means_of_their_rulings)
{
  const RolledCell rolled    = rolled_stripes(16);
  const Eigen::Matrix3d soft = tests::plate(1e6, nu, thickness),
                        hard = tests::plate(1e7, nu, thickness);
  const auto of              = [](const Eigen::Matrix3d &D, const double angle)
  { return of_cylinder(angle).dot(D * of_cylinder(angle)); };
  for (const IsometricBending &its : rolled.isometric)
  {
    // Across the stripes each ruling lies in one of them; any other one crosses all alike.
    const double a = of(soft, its.angle), b = of(hard, its.angle),
                 mean = its.ruling[1] == 0 ? 2. * a * b / (a + b) : 0.5 * (a + b);
    EXPECT_NEAR(its.stiffness, mean, 1e-12 * mean) << its.ruling[0] << ", " << its.ruling[1];
  }
  // D^H across, 1.394 times as much at 45 degrees: what one coordinate alone says of ever tighter
  // rolls, but for layers at the interfaces, as wide as sqrt(R t).
  EXPECT_NEAR(rolled.stiffest(0.5 * M_PI), 1., 1e-9);
  EXPECT_EQ(rolled.least_radius(0.5 * M_PI, 1e-6), 0.);
  EXPECT_NEAR(rolled.stiffest(0.25 * M_PI), 1.394, 5e-4);
  for (const double angle : {0., 0.25 * M_PI, 0.75 * M_PI, 0.5 * M_PI})
  {
    const Eigen::Vector3d K = of_cylinder(angle);
    const double wide       = stiffening_of_stripes(angle, 4e-5),
                 tight      = stiffening_of_stripes(angle, 1e-5);
    EXPECT_NEAR((2. * tight - wide) / K.dot(rolled.stiffness * K), rolled.stiffest(angle), 1e-3)
      << angle;
  }
}

TEST(exact_rolled_cell, squares_without_stretching_share_along_diagonals_alone)
{
  const tests::BracketCell cell =
    tests::bracket_cell(tests::square_lattice(side), 8, 8, {},
                        [](double f1, double f2) { return (f1 < 0.5) == (f2 < 0.5) ? 0 : 1; });
  const std::vector<Eigen::Matrix3d> D = {tests::plate(1e6, nu, thickness),
                                          tests::plate(1e7, nu, thickness)};
  const PlateMesh mesh(glued(cell.mesh, cell.lattice));
  const double soft = D[0](0, 0), hard = D[1](0, 0); // isotropic: in every direction
  for (const std::array<int, 2> &ruling : short_rulings(cell.lattice))
  {
    // Where both numbers are odd the means go in a straight line from one end to the other and
    // back, a triangle wave; else each ruling meets as many soft as hard squares.
    const bool shares  = ruling[0] % 2 != 0 && ruling[1] % 2 != 0;
    const double mean  = 0.5 * (soft + hard),
                 wave  = shares ? 0.5 * (hard - soft) / std::abs(ruling[0] * ruling[1]) : 0.,
                 limit = shares ? 2. * wave / std::log((mean + wave) / (mean - wave)) : mean;
    EXPECT_NEAR(isometric_bending(mesh, cell.lattice, D, ruling).stiffness, limit, 1e-11 * hard)
      << ruling[0] << ", " << ruling[1];
  }
}

TEST(invariant_rolled_cell, short_rulings_are_those_of_the_cloth_whatever_its_basis)
{
  const auto directions = [](const meshes::Lattice &lattice)
  {
    std::vector<double> angles;
    for (const std::array<int, 2> &ruling : short_rulings(lattice))
    {
      const Eigen::RowVector2d along = Eigen::RowVector2d(ruling[0], ruling[1]) * lattice.vectors;
      const double angle             = std::atan2(along(1), along(0)) + 1e-9;
      angles.push_back(std::fmod(angle + 2. * M_PI, M_PI));
    }
    std::sort(angles.begin(), angles.end());
    return angles;
  };
  meshes::Lattice lattice          = tests::skewed_lattice();
  const std::vector<double> before = directions(lattice);
  lattice.vectors.row(1) += 5. * lattice.vectors.row(0);
  lattice.vectors.row(0) -= 2. * lattice.vectors.row(1);
  const std::vector<double> after = directions(lattice);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k)
    EXPECT_NEAR(before[k], after[k], 1e-10);
}

TEST(invariant_rolled_cell, rulings_do_not_depend_on_the_basis_of_the_lattice_or_its_origin)
{
  tests::BracketCell cell =
    tests::bracket_cell(tests::skewed_lattice(), 8, 8, tests::contrasting(10.), tests::odd_pattern);
  const auto limit = [&](const std::array<int, 2> &ruling)
  {
    return isometric_bending(PlateMesh(glued(cell.mesh, cell.lattice)), cell.lattice,
                             cell.stiffness, ruling);
  };
  const IsometricBending before = limit({2, 1}), along = limit({1, 0});
  cell.mesh.vertices.rowwise() += Eigen::RowVector2d(0.0137, -0.0521);
  cell.lattice.vectors.row(1) += cell.lattice.vectors.row(0);
  const IsometricBending after = limit({1, 1});
  EXPECT_NEAR(after.stiffness, before.stiffness, 1e-9 * before.stiffness);
  EXPECT_NEAR(after.angle, before.angle, 1e-12);
  EXPECT_NEAR(limit({1, 0}).stiffness, along.stiffness, 1e-9 * along.stiffness);
}

TEST(order_rolled_cell, stripes_have_their_closed_form_to_order_4)
{
  // phi = -+ ½ c (x² − a x) in stripes of width a, c = (K22 + nu K11) ((1/D) / mean(1/D) − 1).
  const auto exact = [](const double angle)
  {
    const Eigen::Vector3d K = of_cylinder(angle);
    const double a = side / 2., c = (K(1) + nu * K(0)) * (1e-6 / (0.5 * (1e-6 + 1e-7)) - 1.),
                 soft = 0.5 * 1e6 * thickness, hard = 0.5 * 1e7 * thickness;
    return std::pow(K(0) * c * a * a, 2) *
           ((soft + hard) / 120. - std::pow(hard - soft, 2) / (144. * (soft + hard)));
  };
  for (const double angle : {0., 0.25 * M_PI, 0.5 * M_PI})
  {
    std::vector<double> errors;
    for (const int n : {8, 16})
    {
      const RolledCell rolled = rolled_stripes(n);
      const Eigen::Vector3d K = of_cylinder(angle);
      errors.push_back(rolled.stretching(angle) * K.dot(rolled.stiffness * K) - exact(angle));
    }
    EXPECT_GT(errors[1], 0.) << angle << ": competitors lie above";
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 4., 0.3) << angle;
  }
}

TEST(invariant_rolled_cell, a_turned_cell_stiffens_along_turned_directions)
{
  const tests::BracketCell cell =
    tests::bracket_cell(tests::skewed_lattice(), 8, 8, tests::contrasting(10.), tests::odd_pattern);
  constexpr double angle     = 0.3;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  tests::BracketCell turned  = cell;
  turned.mesh.vertices *= turn.transpose();
  turned.lattice.vectors *= turn.transpose();
  const auto rolled = [](const tests::BracketCell &of)
  { return rolled_cell(glued(of.mesh, of.lattice), of.stiffness, of.stiffness); };
  const RolledCell before = rolled(cell), after = rolled(turned);
  for (const double direction : {0., 0.7, 2.})
  {
    EXPECT_GT(before.stretching(direction), 1e-7 * std::pow(cell.lattice.area(), 2));
    EXPECT_NEAR(after.stretching(direction + angle), before.stretching(direction),
                1e-9 * before.stretching(direction));
    EXPECT_NEAR(after.stiffest(direction + angle), before.stiffest(direction), 1e-12);
  }
}

TEST(exact_rolled_cell, where_phases_bend_alike_no_radius_is_too_small)
{
  const tests::BracketCell cell = tests::bracket_cell(tests::skewed_lattice(), 8, 8,
                                                      tests::contrasting(1.01), tests::odd_pattern);
  const RolledCell rolled =
    rolled_cell(glued(cell.mesh, cell.lattice), cell.stiffness, cell.stiffness);
  EXPECT_EQ(rolled.least_radius(0.3, 0.02), 0.);
  EXPECT_EQ(rolled.worst(0.02).radius, 0.);
  for (int degrees = 0; degrees < 180; ++degrees)
    EXPECT_GE(rolled.worst(1e-6).radius, rolled.least_radius(degrees * M_PI / 180., 1e-6));
  EXPECT_EQ(rolled.worst(1e-6).radius,
            rolled.least_radius(rolled.worst(1e-6).degrees * M_PI / 180., 1e-6));
  EXPECT_GT(rolled.least_radius(0.3, 1e-6), 0.);
  EXPECT_NEAR(rolled.most(0.3, rolled.least_radius(0.3, 1e-6)), 1. + 1e-6, 1e-12);
}
