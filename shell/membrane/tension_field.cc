// SPDX-License-Identifier: MIT
#include "shell/membrane/tension_field.h"

#include "meshes/plain/symmetric_eigen.h"
#include "shell/membrane/triangle_blocks.h"
#include "shell/membrane/yarn_energy.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::shell
{
using meshes::YarnAxes;

namespace
{
/// A pressure below this part of the largest stiffness counts as none: round-off of the stress.
constexpr double round_off_of_stress = 1e-13;
/// At rest the metric is 1 up to this, and the cloth taut: its stiffness is that of the yarns.
constexpr double round_off_of_metric = 1e-14;

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// The yarns in the sheet's own plane, columns f1, f2, and a third component: (f; w^T).
DeformationGradient<3> with_third(const Matrix2d &f, const Vector2d &w)
{
  DeformationGradient<3> F;
  F << f, w.transpose();
  return F;
}

/// W, and its derivatives by w.
struct Wrinkle
{
  double energy;
  Vector2d gradient;
  Matrix2d hessian;
};

Wrinkle at_wrinkle(const Matrix2d &f, const Vector2d &w, const YarnAxes &straight)
{
  const DeformationGradient<3> F   = with_third(f, w);
  const GradientHessian<3> hessian = yarn_energy_hessian<3>(F, straight);
  Wrinkle result;
  result.energy   = yarn_energy_density<3>(F, straight);
  result.gradient = yarn_energy_gradient<3>(F, straight).row(2).transpose();
  result.hessian << hessian(2, 2), hessian(2, 5), hessian(5, 2), hessian(5, 5);
  return result;
}

/// Where Newton's method begins. A triangle that is much too short somewhere: w fills that
/// direction up to its length at rest. Else W(a) ≈ W + ½ S a² + c a⁴ along the direction of the
/// pressure, c taken from a tenth: w is the minimum of this double well.
Vector2d first_wrinkle(const Matrix2d &f, const YarnAxes &straight, const Wrinkle &flat)
{
  const auto metric = meshes::symmetric_eigen<2>(f.transpose() * f);
  if (!(metric.values(0) > 0.9) || !flat.hessian.allFinite())
    return std::sqrt(std::max(1. - metric.values(0), 0.1)) * metric.vectors.col(0);
  const auto stress     = meshes::symmetric_eigen<2>(flat.hessian); // at w = 0 it is S
  const Vector2d across = stress.vectors.col(0);
  constexpr double a    = 0.1;
  const double rise =
    (at_wrinkle(f, a * across, straight).energy - flat.energy) - 0.5 * stress.values(0) * a * a;
  const double c = rise / (a * a * a * a);
  return c > 0. ? Vector2d(std::sqrt(-0.25 * stress.values(0) / c) * across) : Vector2d(a * across);
}

/// The w of least energy.
Vector2d wrinkle_of(const Matrix2d &f, const YarnAxes &straight, const Wrinkle &flat)
{
  constexpr int most = 100;
  const double size  = straight.C.cwiseAbs().maxCoeff();
  Vector2d w         = first_wrinkle(f, straight, flat);
  Wrinkle here       = at_wrinkle(f, w, straight);
  for (int newton = 0; newton < most; ++newton)
  {
    if (here.gradient.norm() <= 1e-15 * size * w.norm())
      return w;
    const auto eigen         = meshes::symmetric_eigen<2>(here.hessian);
    const Vector2d slopes    = eigen.vectors.transpose() * here.gradient,
                   curvature = eigen.values.cwiseAbs().cwiseMax(1e-12 * size * w.squaredNorm());
    const Vector2d step      = -eigen.vectors * slopes.cwiseQuotient(curvature);
    if (step.norm() <= 1e-15 * w.norm())
      return w;
    const double slope = step.dot(here.gradient);
    double length      = 1.;
    for (; length > 1e-12; length *= 0.5)
    {
      const Wrinkle next = at_wrinkle(f, w + length * step, straight);
      // Near the minimum the energy has no digits left to tell: the gradient has.
      if (next.energy <= here.energy + 1e-4 * length * slope ||
          (next.energy <= here.energy * (1. + 1e-14) &&
           next.gradient.norm() < 0.5 * here.gradient.norm()))
      {
        w += length * step;
        here = next;
        break;
      }
    }
    if (!(length > 1e-12))
      return w;
  }
  return w;
}

/// The relaxed energy of yarns in the sheet's own plane, by (f1, f2); and S.
struct PlaneField
{
  TensionState state = TensionState::slack;
  double energy      = 0.;
  Matrix2d gradient = Matrix2d::Zero(), stress = Matrix2d::Zero();
  Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
};

PlaneField plane_field(const Matrix2d &f, const YarnAxes &straight)
{
  PlaneField field;
  const auto metric = meshes::symmetric_eigen<2>(f.transpose() * f);
  if (metric.values(1) < 1. - round_off_of_metric)
    return field;
  const double size  = straight.C.cwiseAbs().maxCoeff();
  const Wrinkle flat = at_wrinkle(f, Vector2d::Zero(), straight);
  Vector2d w         = Vector2d::Zero();
  field.state        = TensionState::taut;
  // At w = 0 the second derivative by w is S. Of yarns along each other it is not known; they are
  // compressed across.
  const bool is_flat = metric.values(0) > 1e-12 * metric.values(1);
  if (!is_flat ||
      !(meshes::symmetric_eigen<2>(flat.hessian).values(0) >= -round_off_of_stress * size))
  {
    field.state = TensionState::wrinkled;
    w           = wrinkle_of(f, straight, flat);
  }
  const DeformationGradient<3> F   = with_third(f, w);
  const GradientHessian<3> hessian = yarn_energy_hessian<3>(F, straight);
  field.energy                     = yarn_energy_density<3>(F, straight);
  const DeformationGradient<3> P   = yarn_energy_gradient<3>(F, straight);
  field.gradient                   = P.topRows<2>();
  field.stress                     = (F.transpose() * F).inverse() * (F.transpose() * P);
  // Unknowns (f1; w1; f2; w2) in their order.
  const Eigen::Vector4i plane(0, 1, 3, 4);
  Eigen::Matrix<double, 4, 2> mixed;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < 4; ++j)
      field.hessian(i, j) = hessian(plane(i), plane(j));
    mixed.row(i) << hessian(plane(i), 2), hessian(plane(i), 5);
  }
  if (field.state == TensionState::wrinkled)
  {
    Matrix2d own;
    own << hessian(2, 2), hessian(2, 5), hessian(5, 2), hessian(5, 5);
    field.hessian -= mixed * own.inverse() * mixed.transpose();
  }
  return field;
}

/// Unit vectors in columns that span the sheet, and its normal.
struct SheetFrame
{
  DeformationGradient<3> along;
  Eigen::Vector3d normal;
};

SheetFrame frame_of(const DeformationGradient<3> &f)
{
  const int longer    = f.col(0).squaredNorm() >= f.col(1).squaredNorm() ? 0 : 1;
  const double length = f.col(longer).norm();
  const Eigen::Vector3d first =
    length > 0. ? Eigen::Vector3d(f.col(longer) / length) : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d across = f.col(1 - longer) - first.dot(f.col(1 - longer)) * first;
  const double height          = across.norm();
  // Any plane through the line serves a triangle that has collapsed to it.
  const Eigen::Vector3d second =
    height > 1e-14 * length ? Eigen::Vector3d(across / height) : first.unitOrthogonal();
  SheetFrame frame;
  frame.along << first, second;
  frame.normal = first.cross(second);
  return frame;
}
} // namespace

template <int dim>
TensionField<dim> tension_field(const DeformationGradient<dim> &F, const YarnAxes &yarns,
                                const Hessian kind)
{
  TensionField<dim> field;
  if (!F.allFinite())
  {
    field.energy = std::numeric_limits<double>::quiet_NaN();
    field.gradient.setConstant(field.energy);
    field.hessian.setConstant(field.energy);
    return field;
  }
  YarnAxes straight = yarns;
  straight.axes.setIdentity();
  const DeformationGradient<dim> f = F * yarns.axes;
  Eigen::Matrix<double, dim, 2> along;
  if constexpr (dim == 2)
    along.setIdentity();
  else
    along = frame_of(f).along;
  PlaneField plane = plane_field(along.transpose() * f, straight);
  if (kind == Hessian::projected)
    plane.hessian = meshes::positive_part<4>(plane.hessian);
  field.state    = plane.state;
  field.energy   = plane.energy;
  field.gradient = along * plane.gradient * yarns.axes.transpose();

  const Matrix2d S = yarns.axes * plane.stress * yarns.axes.transpose(); // by F's own columns
  Matrix2d across  = 0.5 * (S + S.transpose());
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
    {
      Matrix2d block = Matrix2d::Zero();
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          block += yarns.axes(a, i) * yarns.axes(b, j) * plane.hessian.block<2, 2>(2 * i, 2 * j);
      auto place = field.hessian.template block<dim, dim>(dim * a, dim * b);
      place      = along * block * along.transpose();
      if constexpr (dim == 3)
      {
        const Eigen::Vector3d normal = along.col(0).cross(along.col(1));
        place += across(a, b) * normal * normal.transpose();
      }
    }
  return field;
}

template <int dim>
TriangleDerivatives<dim> by_corners(const RestTriangle &rest, const TensionField<dim> &field)
{
  TriangleDerivatives<dim> result;
  result.gradient  = rest.shape_gradients * (rest.area * field.gradient).transpose();
  const auto block = [&](const int k, const int l)
  {
    Eigen::Matrix<double, dim, dim> sum = Eigen::Matrix<double, dim, dim>::Zero();
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        sum += rest.area * rest.shape_gradients(k, a) * rest.shape_gradients(l, b) *
               field.hessian.template block<dim, dim>(dim * a, dim * b);
    return sum;
  };
  auto &blocks = result.blocks;
  blocks[3]    = block(1, 1);
  blocks[4]    = block(1, 2);
  blocks[5]    = block(2, 2);
  find_blocks_of_first_corner<dim>(blocks);
  return result;
}

template TensionField<2> tension_field<2>(const DeformationGradient<2> &, const YarnAxes &,
                                          Hessian);
template TensionField<3> tension_field<3>(const DeformationGradient<3> &, const YarnAxes &,
                                          Hessian);
template TriangleDerivatives<2> by_corners<2>(const RestTriangle &, const TensionField<2> &);
template TriangleDerivatives<3> by_corners<3>(const RestTriangle &, const TensionField<3> &);
} // namespace homespun::shell
