// SPDX-License-Identifier: MIT
#include "shell/corotational_energy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>

namespace homespun::shell
{
namespace
{
// Below these parts of tr C a triangle counts as collapsed. Round-off in J is 1e-16 tr C, so that
// at 1e-14 the direction of the normal still has two digits; s^2 is a sum of squares in the plane.
constexpr double collapsed_to_line  = 1e-14;
constexpr double rotation_undefined = 1e-28;

template <int dim>
using Vector = Eigen::Matrix<double, 2 * dim, 1>;

/// U = p A with A = C + J I and p = 1/s = q^-1/2, q = tr C + 2 J, and what differentiates them.
/// A is in Voigt form with engineering shear, (A11, A22, 2 A12).
template <int dim>
struct Stretch
{
  bool defined = true; ///< false where s = 0: R is frozen at the identity
  double p = 0., J = 0.;
  Eigen::Vector3d A;
  DeformationGradient<dim> cofactor;          ///< dJ/dF
  Eigen::Matrix<double, dim, 1> normal;       ///< dim = 3: unit normal, zero where collapsed
  Eigen::Matrix<double, 3, 2 * dim> gradient; ///< dA/dF
  Vector<dim> dq;                             ///< dq/dF
};

/// Value of the stretch; needs p, J, A only.
template <int dim>
Stretch<dim> stretch_of(const DeformationGradient<dim> &F)
{
  Stretch<dim> stretch;
  const double C11 = F.col(0).squaredNorm(), C22 = F.col(1).squaredNorm(),
               C12 = F.col(0).dot(F.col(1));
  double q         = 0.;
  if constexpr (dim == 2)
  {
    // R = [a −b; b a]/s turns F into the symmetric U = R^T F: no difference of large numbers.
    const double a = F(0, 0) + F(1, 1), b = F(1, 0) - F(0, 1);
    stretch.J = F.determinant();
    q         = a * a + b * b;
    stretch.A << a * F(0, 0) + b * F(1, 0), a * F(1, 1) - b * F(0, 1),
      (a * F(0, 1) + b * F(1, 1)) + (a * F(1, 0) - b * F(0, 0));
    stretch.cofactor << F(1, 1), -F(1, 0), -F(0, 1), F(0, 0);
  }
  else
  {
    const Eigen::Vector3d f1 = F.col(0), f2 = F.col(1), cross = f1.cross(f2);
    stretch.J      = cross.norm();
    q              = C11 + C22 + 2. * stretch.J;
    stretch.A      = Eigen::Vector3d(C11 + stretch.J, C22 + stretch.J, 2. * C12);
    stretch.normal = stretch.J > collapsed_to_line * (C11 + C22)
                       ? Eigen::Vector3d(cross / stretch.J)
                       : Eigen::Vector3d(Eigen::Vector3d::Zero());
    stretch.cofactor << f2.cross(stretch.normal), stretch.normal.cross(f1);
  }
  // Written so that not-a-number stays on the regular branch and comes out as such.
  if (q <= rotation_undefined * (C11 + C22) || q == 0.)
  {
    stretch.defined = false;
    stretch.p       = 1.;
    stretch.A << F(0, 0), F(1, 1), F(0, 1) + F(1, 0);
  }
  else
    stretch.p = 1. / std::sqrt(q);
  return stretch;
}

/// Adds the first derivatives to the value.
template <int dim>
Stretch<dim> differentiated_stretch(const DeformationGradient<dim> &F)
{
  Stretch<dim> stretch = stretch_of<dim>(F);
  auto &gradient       = stretch.gradient;
  gradient.setZero();
  if (!stretch.defined)
  {
    gradient(0, 0) = gradient(1, dim + 1) = gradient(2, 1) = gradient(2, dim) = 1.;
    stretch.dq.setZero();
    return stretch;
  }
  const Eigen::Map<const Vector<dim>> dJ(stretch.cofactor.data());
  gradient.row(0) = dJ.transpose();
  gradient.row(1) = dJ.transpose();
  gradient.template block<1, dim>(0, 0) += 2. * F.col(0).transpose();
  gradient.template block<1, dim>(1, dim) += 2. * F.col(1).transpose();
  gradient.template block<1, dim>(2, 0)   = 2. * F.col(1).transpose();
  gradient.template block<1, dim>(2, dim) = 2. * F.col(0).transpose();
  stretch.dq                              = 2. * (Eigen::Map<const Vector<dim>>(F.data()) + dJ);
  return stretch;
}

template <int dim>
Eigen::Vector3d strain_of(const Stretch<dim> &stretch)
{
  return stretch.p * stretch.A - Eigen::Vector3d(1., 1., 0.);
}

/// d²J/dF²: constant in the plane; in space it bends with the normal.
template <int dim>
GradientHessian<dim> area_hessian(const DeformationGradient<dim> &F, const Stretch<dim> &stretch)
{
  GradientHessian<dim> hessian = GradientHessian<dim>::Zero();
  if constexpr (dim == 2)
  {
    hessian(0, 3) = hessian(3, 0) = 1.;
    hessian(1, 2) = hessian(2, 1) = -1.;
  }
  else
  {
    (void)F;
    const Eigen::Vector3d &n = stretch.normal;
    if (n.squaredNorm() < 0.5)
      return hessian;
    // J = |c|, c = f1 × f2: dJ = n·dc, d²J = n·d²c + (|dc|² − (n·dc)²)/J.
    const auto cross = [](const Eigen::Vector3d &v)
    {
      Eigen::Matrix3d matrix;
      matrix << 0., -v(2), v(1), v(2), 0., -v(0), -v(1), v(0), 0.;
      return matrix;
    };
    Eigen::Matrix<double, 3, 6> dc;
    dc << -cross(F.col(1)), cross(F.col(0));
    const Eigen::Map<const Vector<3>> dJ(stretch.cofactor.data());
    hessian = (dc.transpose() * dc - dJ * dJ.transpose()) / stretch.J;
    hessian.template topRightCorner<3, 3>() -= cross(n);
    hessian.template bottomLeftCorner<3, 3>() += cross(n);
  }
  return hessian;
}
} // namespace

template <int dim>
Eigen::Vector3d biot_strain(const DeformationGradient<dim> &F)
{
  return strain_of(stretch_of<dim>(F));
}

template <int dim>
double energy_density(const DeformationGradient<dim> &F, const Eigen::Matrix3d &D)
{
  const Eigen::Vector3d strain = biot_strain<dim>(F);
  return 0.5 * strain.dot(D * strain);
}

template <int dim>
DeformationGradient<dim> energy_gradient(const DeformationGradient<dim> &F,
                                         const Eigen::Matrix3d &D)
{
  // dW = T·de, e = p A − const, dp = −½ p³ dq.
  const Stretch<dim> stretch   = stretch_of<dim>(F);
  const Eigen::Vector3d stress = D * strain_of(stretch);
  DeformationGradient<dim> P;
  if (!stretch.defined)
  {
    P.setZero();
    P(0, 0) = stress(0);
    P(1, 1) = stress(1);
    P(0, 1) = P(1, 0) = stress(2);
    return P;
  }
  const double p = stretch.p, turn = p * p * p * stress.dot(stretch.A);
  P.col(0) = (2. * p * stress(0) - turn) * F.col(0) + 2. * p * stress(2) * F.col(1);
  P.col(1) = (2. * p * stress(1) - turn) * F.col(1) + 2. * p * stress(2) * F.col(0);
  P += (p * (stress(0) + stress(1)) - turn) * stretch.cofactor;
  return P;
}

template <int dim>
GradientHessian<dim> energy_hessian(const DeformationGradient<dim> &F, const Eigen::Matrix3d &D,
                                    const Hessian kind)
{
  // d²W = de·D·de + T·d²e,
  // T·d²e = p T·d²A + (T·dA) dp + dp (T·dA) + (T·A) d²p,  d²p = ¾ p^5 dq dq − ½ p³ d²q.
  using Block                  = Eigen::Matrix<double, dim, dim>;
  const Stretch<dim> stretch   = differentiated_stretch<dim>(F);
  const Eigen::Vector3d stress = D * strain_of(stretch);
  const double p = stretch.p, p3 = p * p * p, load = stress.dot(stretch.A);
  const Vector<dim> dp                          = -0.5 * p3 * stretch.dq;
  const Eigen::Matrix<double, 3, 2 *dim> strain = p * stretch.gradient + stretch.A * dp.transpose();
  GradientHessian<dim> hessian                  = strain.transpose() * D * strain;
  if (stretch.defined)
  {
    const Vector<dim> pull = stretch.gradient.transpose() * stress;
    const double turn      = p3 * load;
    hessian.noalias() += pull * dp.transpose();
    hessian.noalias() += dp * pull.transpose();
    hessian.noalias() += (3. * load / p) * dp * dp.transpose();
    hessian.template topLeftCorner<dim, dim>() += (2. * p * stress(0) - turn) * Block::Identity();
    hessian.template bottomRightCorner<dim, dim>() +=
      (2. * p * stress(1) - turn) * Block::Identity();
    hessian.template topRightCorner<dim, dim>() += 2. * p * stress(2) * Block::Identity();
    hessian.template bottomLeftCorner<dim, dim>() += 2. * p * stress(2) * Block::Identity();
    hessian += (p * (stress(0) + stress(1)) - turn) * area_hessian<dim>(F, stretch);
  }
  if (kind == Hessian::projected && hessian.allFinite())
  {
    const Eigen::SelfAdjointEigenSolver<GradientHessian<dim>> eigen(hessian);
    if (eigen.eigenvalues()(0) < 0.)
      hessian = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.).asDiagonal() *
                eigen.eigenvectors().transpose();
  }
  return hessian;
}

RestTriangle rest_triangle(const Eigen::Matrix<double, 3, 2> &corners)
{
  const Eigen::RowVector2d edge1 = corners.row(1) - corners.row(0),
                           edge2 = corners.row(2) - corners.row(0);
  const double doubled           = edge1(0) * edge2(1) - edge1(1) * edge2(0);
  RestTriangle rest;
  rest.area = 0.5 * doubled;
  rest.shape_gradients.row(1) << edge2(1) / doubled, -edge2(0) / doubled;
  rest.shape_gradients.row(2) << -edge1(1) / doubled, edge1(0) / doubled;
  rest.shape_gradients.row(0) = -(rest.shape_gradients.row(1) + rest.shape_gradients.row(2));
  return rest;
}

template <int dim>
DeformationGradient<dim> deformation_gradient(const RestTriangle &rest,
                                              const Eigen::Matrix<double, 3, dim> &corners)
{
  return (corners.row(1) - corners.row(0)).transpose() * rest.shape_gradients.row(1) +
         (corners.row(2) - corners.row(0)).transpose() * rest.shape_gradients.row(2);
}

template <int dim>
double triangle_energy(const RestTriangle &rest, const Eigen::Matrix<double, 3, dim> &corners,
                       const Eigen::Matrix3d &D)
{
  return rest.area * energy_density<dim>(deformation_gradient<dim>(rest, corners), D);
}

template <int dim>
Eigen::Matrix<double, 3, dim> triangle_gradient(const RestTriangle &rest,
                                                const Eigen::Matrix<double, 3, dim> &corners,
                                                const Eigen::Matrix3d &D)
{
  const DeformationGradient<dim> P =
    rest.area * energy_gradient<dim>(deformation_gradient<dim>(rest, corners), D);
  return rest.shape_gradients * P.transpose();
}

template <int dim>
Eigen::Matrix<double, 3 * dim, 3 * dim>
triangle_hessian(const RestTriangle &rest, const Eigen::Matrix<double, 3, dim> &corners,
                 const Eigen::Matrix3d &D, const Hessian kind)
{
  const GradientHessian<dim> tangent =
    rest.area * energy_hessian<dim>(deformation_gradient<dim>(rest, corners), D, kind);
  Eigen::Matrix<double, 2 * dim, 3 * dim> columns;
  Eigen::Matrix<double, 3 * dim, 3 * dim> hessian;
  for (int k = 0; k < 3; ++k)
    columns.template middleCols<dim>(k * dim) =
      rest.shape_gradients(k, 0) * tangent.template leftCols<dim>() +
      rest.shape_gradients(k, 1) * tangent.template rightCols<dim>();
  for (int k = 0; k < 3; ++k)
    hessian.template middleRows<dim>(k * dim) =
      rest.shape_gradients(k, 0) * columns.template topRows<dim>() +
      rest.shape_gradients(k, 1) * columns.template bottomRows<dim>();
  return hessian;
}

// In the plane and in space.
#define HOMESPUN_INSTANTIATE(dim)                                                                 \
  template Eigen::Vector3d biot_strain<dim>(const DeformationGradient<dim> &);                    \
  template double energy_density<dim>(const DeformationGradient<dim> &, const Eigen::Matrix3d &); \
  template DeformationGradient<dim> energy_gradient<dim>(const DeformationGradient<dim> &,        \
                                                         const Eigen::Matrix3d &);                \
  template GradientHessian<dim> energy_hessian<dim>(const DeformationGradient<dim> &,             \
                                                    const Eigen::Matrix3d &, Hessian);            \
  template DeformationGradient<dim> deformation_gradient<dim>(                                    \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &);                                 \
  template double triangle_energy<dim>(                                                           \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &, const Eigen::Matrix3d &);        \
  template Eigen::Matrix<double, 3, dim> triangle_gradient<dim>(                                  \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &, const Eigen::Matrix3d &);        \
  template Eigen::Matrix<double, 3 * dim, 3 * dim> triangle_hessian<dim>(                         \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &, const Eigen::Matrix3d &,         \
    Hessian);
HOMESPUN_INSTANTIATE(2)
HOMESPUN_INSTANTIATE(3)
#undef HOMESPUN_INSTANTIATE
} // namespace homespun::shell
