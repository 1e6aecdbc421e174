// SPDX-License-Identifier: MIT
#include "shell/membrane/corotational_energy.h"

#include "shell/membrane/triangle_blocks.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homespun::shell
{
namespace
{
// Below these parts of tr C a triangle counts as collapsed. Round-off in J is 1e-16 tr C, so that
// at 1e-14 the direction of the normal still has two digits; s^2 is a sum of squares in the plane.
constexpr double collapsed_to_line  = 1e-14;
constexpr double rotation_undefined = 1e-28;

/// F = R U in the sheet's own frame: stretches U, rotation R (dim,2) with orthonormal columns, in
/// space the unit normal n. Of a triangle collapsed to a line n is zero and R = F/s.
template <int dim>
struct Polar
{
  bool defined = true; ///< false where s = 0: R is frozen at the identity
  double p     = 1.;   ///< 1/s, s = tr U
  double J     = 0.;   ///< det U
  Eigen::Vector3d U;   ///< U11, U22, U12
  DeformationGradient<dim> R;
  Eigen::Matrix<double, dim, 1> normal = Eigen::Matrix<double, dim, 1>::Zero();
};

template <int dim>
Polar<dim> polar_of(const DeformationGradient<dim> &F)
{
  Polar<dim> polar;
  const double C11 = F.col(0).squaredNorm(), C22 = F.col(1).squaredNorm();
  double q = 0.;
  DeformationGradient<dim> cofactor; // dJ/dF
  if constexpr (dim == 2)
  {
    // R = [a −b; b a]/s turns F into the symmetric U = R^T F: no difference of large numbers.
    const double a = F(0, 0) + F(1, 1), b = F(1, 0) - F(0, 1);
    polar.J = F.determinant();
    q       = a * a + b * b;
    polar.U << a * F(0, 0) + b * F(1, 0), a * F(1, 1) - b * F(0, 1),
      0.5 * ((a * F(0, 1) + b * F(1, 1)) + (a * F(1, 0) - b * F(0, 0)));
    cofactor << F(1, 1), -F(1, 0), -F(0, 1), F(0, 0);
  }
  else
  {
    const Eigen::Vector3d f1 = F.col(0), f2 = F.col(1), cross = f1.cross(f2);
    polar.J = cross.norm();
    q       = C11 + C22 + 2. * polar.J;
    polar.U << C11 + polar.J, C22 + polar.J, f1.dot(f2);
    if (polar.J > collapsed_to_line * (C11 + C22))
      polar.normal = cross / polar.J;
    cofactor << f2.cross(polar.normal), polar.normal.cross(f1);
  }
  // Written so that not-a-number stays on the regular branch and comes out as such.
  if (q <= rotation_undefined * (C11 + C22) || q == 0.)
  {
    polar.defined = false;
    polar.U << F(0, 0), F(1, 1), 0.5 * (F(0, 1) + F(1, 0));
    polar.R.setIdentity();
    polar.normal.setZero();
    return polar;
  }
  polar.p = 1. / std::sqrt(q);
  polar.U *= polar.p;
  polar.R = polar.p * (F + cofactor);
  return polar;
}

template <int dim>
Eigen::Vector3d strain_of(const Polar<dim> &polar)
{
  return Eigen::Vector3d(polar.U(0) - 1., polar.U(1) - 1., 2. * polar.U(2));
}

/// What a small turn in the plane changes the strain by. With Z = R^T dF and its skew part
/// β = Z21 − Z12, the rotation follows by β/s, and
///   de = (Z11, Z22, Z12 + Z21) + c β,   c = (U12, −U12, U22 − U11)/s.
template <int dim>
Eigen::Vector3d turning_of(const Polar<dim> &polar)
{
  if (!polar.defined)
    return Eigen::Vector3d::Zero();
  return polar.p * Eigen::Vector3d(polar.U(2), -polar.U(2), polar.U(1) - polar.U(0));
}

/// First Piola-Kirchhoff stress in the turned frame, dW = P : Z.
Eigen::Matrix2d turned_stress(const Eigen::Vector3d &stress, const Eigen::Vector3d &turning)
{
  const double skew = turning.dot(stress);
  Eigen::Matrix2d P;
  P << stress(0), stress(2) - skew, stress(2) + skew, stress(1);
  return P;
}

/// Second derivative of W in the turned frame. In the plane, over (Z11, Z22, Z12 + Z21, β):
///   [ D        D c + q           ]    q = (−T12 − c·T, T12 − c·T, (T11 − T22)/2)/s,
///   [ (.)^T    c·D c + κ         ]    κ = (T11 + T22)/s − T:U/s².
/// Out of the plane, over z = dF^T n, it is S = U^-1 P, the second Piola-Kirchhoff stress.
struct TurnedHessian
{
  Eigen::Matrix4d in_plane;
  Eigen::Matrix2d out_of_plane;
};

/// S with its compression set to zero: the tension-clamped geometric term.
Eigen::Matrix2d tension_of(const Eigen::Matrix2d &S)
{
  const double mean = 0.5 * (S(0, 0) + S(1, 1)), half = 0.5 * (S(0, 0) - S(1, 1)),
               radius = std::hypot(half, S(0, 1));
  if (mean - radius >= 0.)
    return S;
  if (!(mean + radius > 0.))
    return Eigen::Matrix2d::Zero();
  Eigen::Matrix2d direction;
  direction << half, S(0, 1), S(0, 1), -half;
  return 0.5 * (mean + radius) * (Eigen::Matrix2d::Identity() + direction / radius);
}

template <int dim>
TurnedHessian turned_hessian(const Polar<dim> &polar, const Eigen::Matrix3d &D,
                             const Eigen::Vector3d &stress, const Eigen::Vector3d &c,
                             const Eigen::Matrix3d *compliance)
{
  TurnedHessian hessian;
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  double kappa      = 0.;
  if (polar.defined)
  {
    const double skew = c.dot(stress);
    q << -stress(2) - skew, stress(2) - skew, 0.5 * (stress(0) - stress(1));
    q *= polar.p;
    kappa =
      polar.p *
      (stress(0) + stress(1) -
       polar.p * (stress(0) * polar.U(0) + stress(1) * polar.U(1) + 2. * stress(2) * polar.U(2)));
  }
  // Positive semi-definite if and only if the Schur complement of D is not negative, a question of
  // one number: the stiffness κ against turning is raised to where it is zero.
  if (compliance)
    kappa = std::max(kappa, 2. * c.dot(q) + q.dot(*compliance * q));
  const Eigen::Vector3d Dc                = D * c;
  hessian.in_plane.topLeftCorner<3, 3>()  = D;
  hessian.in_plane.topRightCorner<3, 1>() = Dc + q;
  hessian.in_plane.row(3) << (Dc + q).transpose(), c.dot(Dc) + kappa;
  hessian.out_of_plane.setZero();
  if constexpr (dim == 3)
    if (polar.normal.squaredNorm() > 0.5)
    {
      const Eigen::Matrix2d P = turned_stress(stress, c);
      Eigen::Matrix2d &S      = hessian.out_of_plane;
      S(0, 0)                 = polar.U(1) * P(0, 0) - polar.U(2) * P(1, 0);
      S(1, 1)                 = polar.U(0) * P(1, 1) - polar.U(2) * P(0, 1);
      S(0, 1) = S(1, 0) = polar.U(1) * P(0, 1) - polar.U(2) * P(1, 1);
      S /= polar.J;
      if (compliance)
        S = tension_of(S);
    }
  return hessian;
}

/// Columns of (Z11, Z22, Z12 + Z21, β) by a displacement (along r1, along r2) of a corner whose hat
/// has the gradient g.
Eigen::Matrix<double, 4, 2> turned_strain(const Eigen::RowVector2d &g)
{
  Eigen::Matrix<double, 4, 2> columns;
  columns << g(0), 0., 0., g(1), g(1), g(0), -g(1), g(0);
  return columns;
}

/// Block of the Hessian of W that couples corners with the hat gradients g and h.
template <int dim>
Eigen::Matrix<double, dim, dim> block_of(const Polar<dim> &polar, const TurnedHessian &hessian,
                                         const Eigen::RowVector2d &g, const Eigen::RowVector2d &h)
{
  const Eigen::Matrix2d in_plane =
    turned_strain(g).transpose() * (hessian.in_plane * turned_strain(h));
  Eigen::Matrix<double, dim, dim> block = polar.R * in_plane * polar.R.transpose();
  if constexpr (dim == 3)
    block.noalias() += (g * hessian.out_of_plane).dot(h) * polar.normal * polar.normal.transpose();
  return block;
}
} // namespace

template <int dim>
Eigen::Vector3d biot_strain(const DeformationGradient<dim> &F)
{
  return strain_of(polar_of<dim>(F));
}

template <int dim>
double energy_density(const DeformationGradient<dim> &F, const Eigen::Matrix3d &D)
{
  const Eigen::Vector3d strain = biot_strain<dim>(F);
  return 0.5 * strain.dot(D * strain);
}

template <int dim>
DeformationGradient<dim> energy_gradient(const DeformationGradient<dim> &F,
                                         const Eigen::Matrix3d &D,
                                         const Eigen::Vector3d &initial_stress)
{
  const Polar<dim> polar = polar_of<dim>(F);
  return polar.R * turned_stress(D * strain_of(polar) + initial_stress, turning_of(polar));
}

template <int dim>
GradientHessian<dim> energy_hessian(const DeformationGradient<dim> &F, const Eigen::Matrix3d &D,
                                    const Hessian kind)
{
  const Polar<dim> polar        = polar_of<dim>(F);
  const Eigen::Matrix3d inverse = kind == Hessian::projected ? Eigen::Matrix3d(D.inverse()) : D;
  const TurnedHessian turned    = turned_hessian(polar, D, D * strain_of(polar), turning_of(polar),
                                              kind == Hessian::projected ? &inverse : nullptr);
  GradientHessian<dim> hessian;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      hessian.template block<dim, dim>(a * dim, b * dim) =
        block_of<dim>(polar, turned, Eigen::RowVector2d::Unit(a), Eigen::RowVector2d::Unit(b));
  return hessian;
}

template <int dim>
TriangleDerivatives<dim>
triangle_derivatives(const RestTriangle &rest, const Eigen::Matrix<double, 3, dim> &corners,
                     const MembraneStiffness &stiffness, const Hessian kind,
                     const Eigen::Vector3d &initial_stress)
{
  const Polar<dim> polar         = polar_of<dim>(deformation_gradient<dim>(rest, corners));
  const Eigen::Vector3d stress   = stiffness.D * strain_of(polar) + initial_stress,
                        turning  = turning_of(polar);
  const Eigen::Matrix3d *inverse = kind == Hessian::projected ? &stiffness.inverse : nullptr;
  const TurnedHessian turned     = turned_hessian(polar, stiffness.D, stress, turning, inverse);
  TriangleDerivatives<dim> result;
  result.gradient =
    rest.area * rest.shape_gradients * (polar.R * turned_stress(stress, turning)).transpose();
  const Eigen::RowVector2d g1 = rest.shape_gradients.row(1), g2 = rest.shape_gradients.row(2);
  auto &blocks = result.blocks;
  blocks[3]    = rest.area * block_of<dim>(polar, turned, g1, g1);
  blocks[4]    = rest.area * block_of<dim>(polar, turned, g1, g2);
  blocks[5]    = rest.area * block_of<dim>(polar, turned, g2, g2);
  find_blocks_of_first_corner<dim>(blocks);
  return result;
}

MembraneStiffness::MembraneStiffness(const Eigen::Matrix3d &D)
    : D(D)
    , inverse(D.inverse())
{
}

RestTriangle rest_triangle(const Eigen::Matrix<double, 3, 2> &corners)
{
  return meshes::triangle_geometry(
    (corners.bottomRows<2>().rowwise() - corners.row(0)).transpose());
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
                 const MembraneStiffness &stiffness, const Hessian kind,
                 const Eigen::Vector3d &initial_stress)
{
  return hessian_of_blocks<dim>(
    triangle_derivatives<dim>(rest, corners, stiffness, kind, initial_stress).blocks);
}

// In the plane and in space.
#define HOMESPUN_INSTANTIATE(dim)                                                                 \
  template Eigen::Vector3d biot_strain<dim>(const DeformationGradient<dim> &);                    \
  template double energy_density<dim>(const DeformationGradient<dim> &, const Eigen::Matrix3d &); \
  template DeformationGradient<dim> energy_gradient<dim>(                                         \
    const DeformationGradient<dim> &, const Eigen::Matrix3d &, const Eigen::Vector3d &);          \
  template GradientHessian<dim> energy_hessian<dim>(const DeformationGradient<dim> &,             \
                                                    const Eigen::Matrix3d &, Hessian);            \
  template DeformationGradient<dim> deformation_gradient<dim>(                                    \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &);                                 \
  template double triangle_energy<dim>(                                                           \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &, const Eigen::Matrix3d &);        \
  template Eigen::Matrix<double, 3, dim> triangle_gradient<dim>(                                  \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &, const Eigen::Matrix3d &);        \
  template Eigen::Matrix<double, 3 * dim, 3 * dim> triangle_hessian<dim>(                         \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &, const MembraneStiffness &,       \
    Hessian, const Eigen::Vector3d &);                                                            \
  template TriangleDerivatives<dim> triangle_derivatives<dim>(                                    \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &, const MembraneStiffness &,       \
    Hessian, const Eigen::Vector3d &);
HOMESPUN_INSTANTIATE(2)
HOMESPUN_INSTANTIATE(3)
#undef HOMESPUN_INSTANTIATE
} // namespace homespun::shell
