// SPDX-License-Identifier: MIT
#include "tests/verification/manufactured/manufactured_motions.h"

#include "meshes/cloth/irregular_sheet.h"
#include "meshes/plain/refine.h"

#include <cmath>

namespace homespun::verification
{
Eigen::Matrix3d anisotropic()
{
  Eigen::Matrix3d C;
  C << 1500., 330., 120., 330., 600., -90., 120., -90., 270.;
  return C;
}

Eigen::Matrix3d without_contraction()
{
  return Eigen::Vector3d(1500., 600., 270.).asDiagonal();
}

Eigen::Matrix3d varied(const Eigen::Matrix3d &stiffness, const Eigen::RowVector2d &point)
{
  const double k = 2. * M_PI / manufactured_side, x = k * point(0), y = k * point(1);
  const Eigen::Matrix3d other = Eigen::Vector3d(300., 700., 150.).asDiagonal();
  return (1. + 0.4 * std::sin(x + 0.3) * std::cos(y)) * stiffness +
         (0.8 + 0.7 * std::cos(x) * std::sin(y + 1.)) * other;
}

meshes::TriangleMesh irregular_mesh(const int n, const int n_coarsest)
{
  int refinements = 0;
  while (n_coarsest << refinements < n)
    ++refinements;
  return meshes::refined(meshes::irregular_sheet(n_coarsest, manufactured_side), refinements);
}

Wave periodic_wave(const Eigen::RowVector2d &point, const double strain)
{
  const double k = 2. * M_PI / manufactured_side, x = k * point(0), y = k * point(1);
  const double size = 0.08 * strain * manufactured_side;
  Wave wave;
  wave.value << std::sin(x + 0.4) * std::cos(y) + 0.3 * std::sin(y - 1.),
    std::cos(x - 0.9) * std::sin(y + 0.3) - 0.4 * std::cos(x), 0.;
  wave.gradient << std::cos(x + 0.4) * std::cos(y),
    -std::sin(x + 0.4) * std::sin(y) + 0.3 * std::cos(y - 1.),
    -std::sin(x - 0.9) * std::sin(y + 0.3) + 0.4 * std::sin(x),
    std::cos(x - 0.9) * std::cos(y + 0.3), 0., 0.;
  return {size * wave.value, size * k * wave.gradient};
}

Wave clamped_wave(const Eigen::RowVector2d &point, const double strain)
{
  const double x = point(0) / manufactured_side, y = point(1) / manufactured_side;
  const double bump  = 16. * x * x * (1. - x) * (1. - x);
  const double slope = 32. * x * (1. - x) * (1. - 2. * x);
  const double s1 = std::sin(M_PI * y), c1 = M_PI * std::cos(M_PI * y);
  const double s2 = std::sin(2. * M_PI * y), c2 = 2. * M_PI * std::cos(2. * M_PI * y);
  const double size = 0.15 * strain * manufactured_side;
  Wave wave;
  wave.value << bump * s2, bump * (1. + x) * s1, 0.;
  wave.gradient << slope * s2, bump * c2, (slope * (1. + x) + bump) * s1, bump * (1. + x) * c1, 0.,
    0.;
  return {size * wave.value, size / manufactured_side * wave.gradient};
}

Wave bulging(const Eigen::RowVector2d &point, const double height)
{
  const double x = point(0) / manufactured_side, y = point(1) / manufactured_side;
  const double sx = std::sin(M_PI * x), cx = M_PI * std::cos(M_PI * x);
  const double sy = std::sin(M_PI * y), cy = M_PI * std::cos(M_PI * y);
  const double bump = height * sx * sy, bump_x = height * cx * sy, bump_y = height * sx * cy;
  const double c = std::cos(2. * y), lift = 1. + 0.5 * x - 0.3 * y;
  Wave wave;
  wave.value << 1.10 * x + 0.04 * y + 0.3 * bump * c, 1.08 * y + 0.4 * bump * (1. - x), bump * lift;
  wave.gradient << 1.10 + 0.3 * bump_x * c,
    0.04 + 0.3 * (bump_y * c - 2. * bump * std::sin(2. * y)), 0.4 * (bump_x * (1. - x) - bump),
    1.08 + 0.4 * bump_y * (1. - x), bump_x * lift + 0.5 * bump, bump_y * lift - 0.3 * bump;
  return {manufactured_side * wave.value, wave.gradient};
}

Wave spreading(const Eigen::RowVector2d &point)
{
  const double x = point(0) / manufactured_side, y = point(1) / manufactured_side;
  // sin³ has no slope and no curvature at both ends.
  const auto cubed = [](const double s) { return std::pow(std::sin(M_PI * s), 3); };
  const auto slope = [](const double s)
  { return 3. * M_PI * std::pow(std::sin(M_PI * s), 2) * std::cos(M_PI * s); };
  const double bump = 0.1 * cubed(x) * cubed(y), bump_x = 0.1 * slope(x) * cubed(y),
               bump_y = 0.1 * cubed(x) * slope(y);
  Wave wave;
  wave.value << 1.10 * x + 0.15 * y + bump, 1.05 * y - 0.05 * x - 0.6 * bump, 0.8 * bump;
  wave.gradient << 1.10 + bump_x, 0.15 + bump_y, -0.05 - 0.6 * bump_x, 1.05 - 0.6 * bump_y,
    0.8 * bump_x, 0.8 * bump_y;
  return {manufactured_side * wave.value, wave.gradient};
}

KnownField at_time(const SheetMotion &motion, const double time)
{
  return {[=](const Eigen::RowVector2d &point) { return motion(point, time).value; },
          [=](const Eigen::RowVector2d &point) { return motion(point, time).gradient; }};
}
} // namespace homespun::verification
