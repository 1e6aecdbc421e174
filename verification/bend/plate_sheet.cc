// SPDX-License-Identifier: MIT
#include "verification/bend/plate_sheet.h"

#include "meshes/plain/gauss_rule.h"
#include "meshes/plain/index.h"
#include "meshes/plain/triangle_kinematics.h"
#include "verification/bend/edge_means.h"

#include <cmath>
#include <map>
#include <utility>

namespace homespun::verification
{
using homogenization::HeldDof;
using homogenization::PlateTriangle;
using homogenization::ThinPlate;
using meshes::at;

namespace
{
/// Points and weights on 0 to 1, exact to degree 5.
std::array<std::array<double, 2>, 3> points_on_a_side()
{
  const meshes::GaussRule rule = meshes::gauss_rule(3);
  std::array<std::array<double, 2>, 3> points;
  for (int q = 0; q < 3; ++q)
    points[at(q)] = {0.5 * (1. + rule.points(q)), 0.5 * rule.weights(q)};
  return points;
}

/// The edge of the sheet that a point lies on, −1 inside.
int edge_at(const Eigen::RowVector2d &fraction)
{
  for (int axis = 0; axis < 2; ++axis)
    for (int far = 0; far < 2; ++far)
      if (std::abs(fraction(axis) - far) < 2. * meshes::image_tolerance)
        return 2 * axis + far;
  return -1;
}
} // namespace

PlateSheet::PlateSheet(const meshes::Sheet &sheet, const meshes::TriangleMesh &mesh,
                       std::vector<Eigen::Matrix3d> bending_stiffness_of_material)
    : plate(homogenization::PlateMesh(mesh), std::move(bending_stiffness_of_material))
    , sheet(sheet)
{
  for (const homogenization::RimSide &rim : plate.mesh.rim())
  {
    const auto [from, to] = ends_of(rim);
    const int edge        = edge_at(sheet.fraction(0.5 * (from + to).transpose()));
    if (edge < 0)
      continue; // the rim of a hole
    const double length         = (to - from).norm();
    const Eigen::Vector2d along = (to - from) / length;
    edge_sides.push_back({rim, edge, along, {-along(1), along(0)}, length});
  }
}

Eigen::Vector3d PlateSheet::on_side(const homogenization::RimSide &rim, const double part)
{
  Eigen::Vector3d barycentric     = Eigen::Vector3d::Zero();
  barycentric(rim.side)           = 1. - part;
  barycentric((rim.side + 1) % 3) = part;
  return barycentric;
}

std::array<Eigen::Vector2d, 2> PlateSheet::ends_of(const homogenization::RimSide &rim) const
{
  const auto &corners = plate.mesh.triangles[at(rim.triangle)].corners;
  return {corners[at(rim.side)], corners[at((rim.side + 1) % 3)]};
}

/// What the two sides at a vertex say is averaged: of one edge they say nearly the same, and where
/// two clamped edges meet the curvature, and with it the slope, is zero.
template <typename ClampedAt>
std::vector<HeldDof> PlateSheet::held(const BendingLoad &load, ClampedAt &&clamped_at) const
{
  std::map<int, std::pair<double, int>> sums; // of a DoF
  const auto add = [&](const int dof, const double value)
  {
    auto &[sum, n] = sums[dof];
    sum += value;
    ++n;
  };
  for (const EdgeSide &one : edge_sides)
  {
    if (!load.is_clamped[at(one.edge)])
      continue;
    const PlateTriangle &triangle = plate.mesh.triangles[at(one.rim.triangle)];
    for (int end = 0; end < 2; ++end)
    {
      const int v                   = triangle.vertices[at((one.rim.side + end) % 3)];
      const auto &[value, gradient] = clamped_at(one, static_cast<double>(end));
      add(3 * v, value);
      add(3 * v + 1, gradient(0));
      add(3 * v + 2, gradient(1));
    }
    const int side = triangle.sides[at(one.rim.side)];
    add(plate.dof_of_side(side), clamped_at(one, 0.5).gradient.dot(plate.mesh.normals[at(side)]));
  }
  std::vector<HeldDof> dofs;
  for (const auto &[dof, sum] : sums)
    dofs.push_back({dof, sum.first / sum.second});
  return dofs;
}

Eigen::VectorXd PlateSheet::deflection(const BendingLoad &load, const double pressure) const
{
  Eigen::VectorXd forces = load.by == BentBy::pressure
                             ? Eigen::VectorXd(pressure * plate.pressure())
                             : Eigen::VectorXd::Zero(plate.n_dofs()).eval();
  for (const EdgeSide &one : edge_sides)
    if (load.by == BentBy::moment && one.edge == 1) // the moment works on the slope outwards
      for (const auto &[part, weight] : points_on_a_side())
      {
        const ThinPlate::Shapes shapes = plate.shapes(one.rim.triangle, on_side(one.rim, part));
        const auto dofs                = plate.dofs_of(one.rim.triangle);
        for (int k = 0; k < 12; ++k)
          forces(dofs[at(k)]) -= weight * one.length * one.inwards.dot(shapes.block<2, 1>(1, k));
      }
  const auto clamped_at = [&](const EdgeSide &one, const double part) -> Clamped
  {
    if (load.by != BentBy::turn || one.edge != 1)
      return {0., Eigen::Vector2d::Zero()};
    const auto [from, to] = ends_of(one.rim);
    const Eigen::Vector2d middle =
      (sheet.origin + sheet.sides().row(0) + 0.5 * sheet.sides().row(1)).transpose();
    return {one.along.dot(from + part * (to - from) - middle), one.along};
  };
  return plate.solve(forces, held(load, clamped_at));
}

Eigen::VectorXd PlateSheet::correction(const BendingLoad &load,
                                       const homogenization::PlateEdges &edges,
                                       const Eigen::VectorXd &deflection) const
{
  const auto curvature_at = [&](const int triangle, const Eigen::Vector3d &barycentric)
  { return Eigen::Vector3d(plate.values(triangle, barycentric, deflection).tail<3>()); };

  Eigen::VectorXd forces = Eigen::VectorXd::Zero(plate.n_dofs());
  for (const EdgeSide &one : edge_sides)
    for (const auto &[part, weight] : points_on_a_side())
    {
      if (load.is_clamped[at(one.edge)])
        continue;
      const Eigen::Vector3d point = on_side(one.rim, part);
      const Eigen::Vector3d moment =
        edges.sides[at(one.edge)].moment * curvature_at(one.rim.triangle, point);
      const ThinPlate::Shapes shapes = plate.shapes(one.rim.triangle, point);
      const auto dofs                = plate.dofs_of(one.rim.triangle);
      for (int k = 0; k < 12; ++k)
        forces(dofs[at(k)]) -= weight * one.length * moment.dot(shapes.block<3, 1>(3, k));
    }
  // −M_abc d_b K_a, with the gradient of what is linear between the middles of the three pieces.
  std::vector<Eigen::MatrixXd> moments;
  for (int t = 0; t < static_cast<int>(plate.mesh.triangles.size()); ++t)
  {
    const auto &corners = plate.mesh.triangles[at(t)].corners;
    Eigen::Matrix2d legs;
    legs << corners[1] - corners[0], corners[2] - corners[0];
    const auto of_corners                = meshes::triangle_geometry(legs).shape_gradients;
    Eigen::Matrix<double, 3, 2> gradient = Eigen::Matrix<double, 3, 2>::Zero();
    for (int k = 0; k < 3; ++k)
    {
      Eigen::Vector3d middle = Eigen::Vector3d::Constant(4. / 9.);
      middle(k)              = 1. / 9.;
      gradient -= 3. * curvature_at(t, middle) * of_corners.row(k);
    }
    moments.emplace_back(-edges.bulk[0].transpose() * gradient.col(0) -
                         edges.bulk[1].transpose() * gradient.col(1));
  }
  forces += plate.of_moments(moments);
  std::map<int, EdgeMeans> means; // of the curvature at clamps
  for (const EdgeSide &one : edge_sides)
  {
    if (!load.is_clamped[at(one.edge)])
      continue;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto &[part, weight] : points_on_a_side())
      mean += weight * curvature_at(one.rim.triangle, on_side(one.rim, part));
    means.try_emplace(one.edge, sheet, one.edge).first->second.add(ends_of(one.rim), mean);
  }
  const auto clamped_at = [&](const EdgeSide &one, const double part) -> Clamped
  {
    const homogenization::AffineDeflection &slip = edges.sides[at(one.edge)].slip;
    const auto [from, to]                        = ends_of(one.rim);
    const auto lift                              = [&](const Eigen::Vector2d &point)
    { return slip.value.dot(means.at(one.edge).at(point)); };
    const double slope = slip.slope.dot(curvature_at(one.rim.triangle, on_side(one.rim, part)));
    return {lift(from + part * (to - from)),
            slope * one.inwards + (lift(to) - lift(from)) / one.length * one.along};
  };
  return plate.solve(forces, held(load, clamped_at));
}

double PlateSheet::mean_curvature(const Eigen::VectorXd &deflection) const
{
  double sum = 0., area = 0.;
  for (int t = 0; t < static_cast<int>(plate.mesh.triangles.size()); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      Eigen::Vector3d middle      = Eigen::Vector3d::Constant(4. / 9.);
      middle(k)                   = 1. / 9.;
      const Eigen::Vector3d kappa = plate.values(t, middle, deflection).tail<3>();
      sum += plate.area(t) / 3. *
             (kappa(0) * kappa(0) + kappa(1) * kappa(1) + 0.5 * kappa(2) * kappa(2));
    }
    area += plate.area(t);
  }
  return std::sqrt(sum / area);
}
} // namespace homespun::verification
