// SPDX-License-Identifier: MIT
#include "shell/membrane/discrete_gradient.h"

#include "shell/algebra/vertex_matrix.h"

namespace homespun::shell
{
namespace
{
// Symmetric 2 x 2 matrices by their entries 11, 22, 12.
using Symmetric = Eigen::Vector3d;

/// Below this determinant over tr² a stretch counts as that of a line: U is known to 1e-16.
constexpr double collapsed_determinant = 1e-14;

Eigen::Matrix2d matrix_of(const Symmetric &a)
{
  Eigen::Matrix2d matrix;
  matrix << a(0), a(2), a(2), a(1);
  return matrix;
}

/// X of U X + X U = B as a matrix by which the entries of B are multiplied. With adj U = det U
/// U^-1,
///   X = (B + adj U B adj U / det U) / (2 tr U);
/// of a line with the direction t, U = λ t t^T, the component of X across it is zero.
Eigen::Matrix3d inverse_anticommutator(const Symmetric &U)
{
  const double trace = U(0) + U(1), det = U(0) * U(1) - U(2) * U(2);
  const Eigen::Matrix2d adjugate = matrix_of({U(1), U(0), -U(2)});
  Eigen::Matrix3d inverse        = Eigen::Matrix3d::Zero();
  if (!(trace > 0.))
    return inverse;
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::Matrix2d B      = matrix_of(Symmetric::Unit(k));
    const Eigen::Matrix2d across = adjugate * B * adjugate;
    Eigen::Matrix2d X;
    if (det > collapsed_determinant * trace * trace)
      X = (B + across / det) / (2. * trace);
    else
    {
      const Eigen::Matrix2d along = matrix_of(U) * B * matrix_of(U);
      X                           = (B - (across + 0.5 * along) / (trace * trace)) / trace;
    }
    inverse.col(k) << X(0, 0), X(1, 1), X(0, 1);
  }
  return inverse;
}

/// A X + X A, as a matrix by which the entries of X are multiplied.
Eigen::Matrix3d anticommutator(const Symmetric &A)
{
  Eigen::Matrix3d matrix;
  matrix << 2. * A(0), 0., 2. * A(2), //
    0., 2. * A(1), 2. * A(2),         //
    A(2), A(2), A(0) + A(1);
  return matrix;
}

/// F^T dF, symmetric part in the entries 11, 22 and twice 12, by a displacement of the corner whose
/// hat has the gradient g.
Eigen::Matrix3d stretching(const DeformationGradient<3> &F, const Eigen::RowVector2d &g)
{
  Eigen::Matrix3d rows;
  rows.row(0) = g(0) * F.col(0).transpose();
  rows.row(1) = g(1) * F.col(1).transpose();
  rows.row(2) = (g(1) * F.col(0) + g(0) * F.col(1)).transpose();
  return rows;
}
} // namespace

TriangleStep step_of_stress(const double area, const Eigen::Matrix<double, 3, 2> &hats,
                            const DeformationGradient<3> &mean, const DeformationGradient<3> &F,
                            const Eigen::Matrix2d &S, const Eigen::Matrix3d &dS)
{
  TriangleStep step;
  step.gradient = area * hats * S * mean.transpose();
  for (int a = 0; a < 3; ++a)
  {
    const Eigen::RowVector2d g = hats.row(a);
    const Eigen::Matrix3d half = area * stretching(mean, g).transpose() * dS;
    for (int b = 0; b < 3; ++b)
    {
      const Eigen::RowVector2d other = hats.row(b);
      step.jacobian.block<3, 3>(3 * a, 3 * b) =
        half * stretching(F, other) + 0.5 * area * (g * S).dot(other) * Eigen::Matrix3d::Identity();
    }
  }
  return step;
}

TriangleStep triangle_step(const RestTriangle &rest, const Eigen::Matrix3d &old_corners,
                           const Eigen::Matrix3d &corners, const Eigen::Matrix3d &D,
                           const StrainWeights &weights)
{
  const DeformationGradient<3> old_F = deformation_gradient<3>(rest, old_corners),
                               F = deformation_gradient<3>(rest, corners), mean = 0.5 * (old_F + F);
  const Eigen::Vector3d old_strain = biot_strain<3>(old_F), strain = biot_strain<3>(F);
  const auto stretch_of = [](const Eigen::Vector3d &e)
  { return Symmetric(e(0) + 1., e(1) + 1., 0.5 * e(2)); };
  const Symmetric U = stretch_of(strain), mean_U = 0.5 * (stretch_of(old_strain) + U);
  const Eigen::Matrix3d to_S = inverse_anticommutator(mean_U);
  const Symmetric S = to_S * (2. * (D * (weights.old * old_strain + weights.now * strain)));

  // dS by dC1 = U1 dU1 + dU1 U1: Ū dS + dS Ū = 2 dT̄ − dŪ S − S dŪ with dT̄ = now D de1 and dŪ = ½
  // dU1.
  const Eigen::Matrix3d by_U = 2. * weights.now * D * Eigen::Vector3d(1., 1., 2.).asDiagonal(),
                        dS   = to_S * (by_U - 0.5 * anticommutator(S)) * inverse_anticommutator(U) *
                             Eigen::Vector3d(2., 2., 1.).asDiagonal();
  return step_of_stress(rest.area, rest.shape_gradients, mean, F, matrix_of(S), dS);
}

void add_step(const TriangleStep &step, const Eigen::RowVector3i &vertices, Vectors &gradient,
              VertexMatrix &jacobian)
{
  for (int a = 0; a < 3; ++a)
  {
    gradient.row(vertices(a)) += step.gradient.row(a);
    for (int b = 0; b < 3; ++b)
      jacobian.add(vertices(a), vertices(b), step.jacobian.block<3, 3>(3 * a, 3 * b));
  }
}
} // namespace homespun::shell
