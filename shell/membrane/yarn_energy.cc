// SPDX-License-Identifier: MIT
#include "shell/membrane/yarn_energy.h"

#include "meshes/plain/symmetric_eigen.h"
#include "shell/membrane/triangle_blocks.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace homespun::shell
{
using meshes::YarnAxes;

namespace
{
// Below this sine of the angle between them yarns count as lying along each other.
constexpr double parallel_yarns = 1e-14;

/// The yarns in their frames.
template <int dim>
struct Frames
{
  using Vector = Eigen::Matrix<double, dim, 1>;
  bool defined = true;            ///< false: a yarn has no length
  std::array<double, 2> l;        ///< stretches
  std::array<Vector, 2> t;        ///< along each yarn
  std::array<Vector, 2> n;        ///< across it, counter-clockwise; zero at a collapse
  Vector normal = Vector::Zero(); ///< of the sheet in space; zero at a collapse
  double sine = 0., cosine = 1.;  ///< of gamma
  Eigen::Vector3d strain    = Eigen::Vector3d::Zero(); ///< e
  Eigen::Vector3d stress    = Eigen::Vector3d::Zero(); ///< T [N/m]
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero(); ///< dT/de [N/m]
};

template <int dim>
Frames<dim> frames_of(const DeformationGradient<dim> &F, const YarnAxes &yarns)
{
  Frames<dim> frames;
  for (std::size_t i = 0; i < 2; ++i)
  {
    const Eigen::Matrix<double, dim, 1> f = F * yarns.axes.col(static_cast<Eigen::Index>(i));
    frames.l[i]                           = f.norm();
    if (frames.l[i] == 0.)
    {
      frames.defined = false;
      return frames;
    }
    frames.t[i] = f / frames.l[i];
  }
  const auto &t = frames.t;
  frames.sine   = t[0].dot(t[1]);
  if constexpr (dim == 2)
  {
    frames.cosine = t[0](0) * t[1](1) - t[0](1) * t[1](0);
    for (std::size_t i = 0; i < 2; ++i)
      frames.n[i] << -t[i](1), t[i](0);
  }
  else
  {
    const Eigen::Vector3d cross = t[0].cross(t[1]);
    frames.cosine               = cross.norm();
    if (!(frames.cosine <= parallel_yarns))
      frames.normal = cross / frames.cosine;
    for (std::size_t i = 0; i < 2; ++i)
      frames.n[i] = frames.normal.cross(t[i]);
  }
  frames.strain << frames.l[0] - 1., frames.l[1] - 1., std::atan2(frames.sine, frames.cosine);
  frames.stress    = yarns.C * frames.strain;
  frames.stiffness = yarns.C;
  return frames;
}

/// dW/df1 and dW/df2 in columns: each yarn is pulled along itself and turned by the shear.
template <int dim>
DeformationGradient<dim> pulls_of(const Frames<dim> &frames)
{
  DeformationGradient<dim> pulls = DeformationGradient<dim>::Zero();
  if (!frames.defined)
    return pulls;
  const Eigen::Vector3d &T = frames.stress;
  pulls.col(0)             = T(0) * frames.t[0] + T(2) / frames.l[0] * frames.n[0];
  pulls.col(1)             = T(1) * frames.t[1] - T(2) / frames.l[1] * frames.n[1];
  return pulls;
}

/// d²W over (α1, β1, α2, β2).
template <int dim>
Eigen::Matrix4d in_plane_part(const Frames<dim> &frames)
{
  const double l1 = frames.l[0], l2 = frames.l[1];
  const Eigen::Vector3d &T = frames.stress;
  Eigen::Matrix<double, 3, 4> strain; // de
  strain << 1., 0., 0., 0.,           //
    0., 0., 1., 0.,                   //
    0., 1. / l1, 0., -1. / l2;
  Eigen::Matrix4d hessian = strain.transpose() * frames.stiffness * strain;
  hessian(1, 1) += T(0) / l1;
  hessian(3, 3) += T(1) / l2;
  hessian(0, 1) -= T(2) / (l1 * l1);
  hessian(1, 0) = hessian(0, 1);
  hessian(2, 3) += T(2) / (l2 * l2);
  hessian(3, 2) = hessian(2, 3);
  return hessian;
}

/// d²W over (ζ1, ζ2).
Eigen::Matrix2d out_of_plane_part(const Frames<3> &frames)
{
  const double l1 = frames.l[0], l2 = frames.l[1];
  const Eigen::Vector3d &T = frames.stress;
  const double tangent     = frames.sine / frames.cosine;
  const double mixed       = T(2) / (frames.cosine * l1 * l2);
  Eigen::Matrix2d hessian;
  hessian << T(0) / l1 - T(2) * tangent / (l1 * l1), mixed, //
    mixed, T(1) / l2 - T(2) * tangent / (l2 * l2);
  return hessian;
}

/// d²W by (f1, f2).
template <int dim>
GradientHessian<dim> hessian_of(const Frames<dim> &frames, const Hessian kind)
{
  GradientHessian<dim> hessian = GradientHessian<dim>::Zero();
  if (!frames.defined)
    return hessian;
  Eigen::Matrix4d in_plane = in_plane_part(frames);
  if (kind == Hessian::projected)
    in_plane = meshes::positive_part<4>(in_plane);
  Eigen::Matrix<double, 2 * dim, 4> directions = Eigen::Matrix<double, 2 * dim, 4>::Zero();
  for (int i = 0; i < 2; ++i)
  {
    directions.template block<dim, 1>(dim * i, 2 * i)     = frames.t[static_cast<std::size_t>(i)];
    directions.template block<dim, 1>(dim * i, 2 * i + 1) = frames.n[static_cast<std::size_t>(i)];
  }
  hessian = directions * in_plane * directions.transpose();
  if constexpr (dim == 3)
    if (frames.normal.squaredNorm() > 0.5)
    {
      Eigen::Matrix2d out_of_plane = out_of_plane_part(frames);
      if (kind == Hessian::projected)
        out_of_plane = meshes::positive_part<2>(out_of_plane);
      const Eigen::Matrix3d across = frames.normal * frames.normal.transpose();
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          hessian.template block<dim, dim>(dim * i, dim * j) += out_of_plane(i, j) * across;
    }
  return hessian;
}

/// Block of the Hessian of W where one side moves F by displacement times g^T, the other by h.
template <int dim>
Eigen::Matrix<double, dim, dim> block_of(const GradientHessian<dim> &hessian,
                                         const Eigen::RowVector2d &g, const Eigen::RowVector2d &h)
{
  Eigen::Matrix<double, dim, dim> block = Eigen::Matrix<double, dim, dim>::Zero();
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      block += g(i) * h(j) * hessian.template block<dim, dim>(dim * i, dim * j);
  return block;
}
} // namespace

template <int dim>
Eigen::Vector3d yarn_strain(const DeformationGradient<dim> &F, const YarnAxes &yarns)
{
  const Frames<dim> frames = frames_of<dim>(F, yarns);
  return frames.defined ? frames.strain
                        : Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

template <int dim>
bool has_length(const DeformationGradient<dim> &F, const YarnAxes &yarns)
{
  return (F * yarns.axes).colwise().norm().minCoeff() > 0.;
}

template <int dim>
double yarn_energy_density(const DeformationGradient<dim> &F, const YarnAxes &yarns)
{
  const Frames<dim> frames = frames_of<dim>(F, yarns);
  if (!frames.defined)
    return std::numeric_limits<double>::infinity();
  return 0.5 * frames.strain.dot(frames.stress);
}

template <int dim>
DeformationGradient<dim> yarn_energy_gradient(const DeformationGradient<dim> &F,
                                              const YarnAxes &yarns)
{
  return pulls_of(frames_of<dim>(F, yarns)) * yarns.axes.transpose();
}

template <int dim>
GradientHessian<dim> yarn_energy_hessian(const DeformationGradient<dim> &F, const YarnAxes &yarns,
                                         const Hessian kind)
{
  const GradientHessian<dim> by_yarns = hessian_of(frames_of<dim>(F, yarns), kind);
  GradientHessian<dim> hessian;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      hessian.template block<dim, dim>(dim * a, dim * b) =
        block_of<dim>(by_yarns, yarns.axes.row(a), yarns.axes.row(b));
  return hessian;
}

template <int dim>
Eigen::Matrix<double, 3, dim> yarn_triangle_gradient(const RestTriangle &rest,
                                                     const Eigen::Matrix<double, 3, dim> &corners,
                                                     const YarnAxes &yarns)
{
  const DeformationGradient<dim> P =
    rest.area * yarn_energy_gradient<dim>(deformation_gradient<dim>(rest, corners), yarns);
  return rest.shape_gradients * P.transpose();
}

template <int dim>
TriangleDerivatives<dim> yarn_triangle_derivatives(const RestTriangle &rest,
                                                   const Eigen::Matrix<double, 3, dim> &corners,
                                                   const YarnAxes &yarns, const Hessian kind)
{
  const Frames<dim> frames = frames_of<dim>(deformation_gradient<dim>(rest, corners), yarns);
  const GradientHessian<dim> hessian     = rest.area * hessian_of(frames, kind);
  const Eigen::Matrix<double, 3, 2> hats = rest.shape_gradients * yarns.axes; // along the yarns
  TriangleDerivatives<dim> result;
  result.gradient = rest.area * (hats * pulls_of(frames).transpose());
  auto &blocks    = result.blocks;
  blocks[3]       = block_of<dim>(hessian, hats.row(1), hats.row(1));
  blocks[4]       = block_of<dim>(hessian, hats.row(1), hats.row(2));
  blocks[5]       = block_of<dim>(hessian, hats.row(2), hats.row(2));
  find_blocks_of_first_corner<dim>(blocks);
  return result;
}

// In the plane and in space.
#define HOMESPUN_INSTANTIATE(dim)                                                                \
  template Eigen::Vector3d yarn_strain<dim>(const DeformationGradient<dim> &, const YarnAxes &); \
  template bool has_length<dim>(const DeformationGradient<dim> &, const YarnAxes &);             \
  template double yarn_energy_density<dim>(const DeformationGradient<dim> &, const YarnAxes &);  \
  template DeformationGradient<dim> yarn_energy_gradient<dim>(const DeformationGradient<dim> &,  \
                                                              const YarnAxes &);                 \
  template GradientHessian<dim> yarn_energy_hessian<dim>(const DeformationGradient<dim> &,       \
                                                         const YarnAxes &, Hessian);             \
  template Eigen::Matrix<double, 3, dim> yarn_triangle_gradient<dim>(                            \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &, const YarnAxes &);              \
  template TriangleDerivatives<dim> yarn_triangle_derivatives<dim>(                              \
    const RestTriangle &, const Eigen::Matrix<double, 3, dim> &, const YarnAxes &, Hessian);
HOMESPUN_INSTANTIATE(2)
HOMESPUN_INSTANTIATE(3)
#undef HOMESPUN_INSTANTIATE
} // namespace homespun::shell
