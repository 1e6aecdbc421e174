// SPDX-License-Identifier: MIT
#include "localization/coarse_frames.h"

#include "meshes/plain/errors.h"

#include <cmath>
#include <string>
#include <type_traits>

namespace homespun::localization
{
namespace
{
/// Calls action(strain, lift) with the two choices as compile-time constants, so that no loop asks.
template <typename Action>
void with_choices(const UpsamplerOptions &options, const Action &action)
{
  const auto biot = std::integral_constant<Strain, Strain::biot>();
  if (options.strain == Strain::linear)
    action(std::integral_constant<Strain, Strain::linear>(),
           std::integral_constant<Lift, Lift::identity>());
  else if (options.lift == Lift::rotation)
    action(biot, std::integral_constant<Lift, Lift::rotation>());
  else if (options.lift == Lift::affine)
    action(biot, std::integral_constant<Lift, Lift::affine>());
  else
    action(biot, std::integral_constant<Lift, Lift::identity>());
}

/// As in the file's head; branches are selections only, so that the loop over triangles vectorises.
/// @param f1, f2 columns of F
/// @param frame 3 + 2 dim values, `stride` apart
template <int dim, Strain strain, Lift lift>
inline void frame_of(const double (&f1)[dim], const double (&f2)[dim], double *const frame,
                     const std::size_t stride)
{
  double C11 = 0., C22 = 0., C12 = 0.;
  for (int i = 0; i < dim; ++i)
  {
    C11 += f1[i] * f1[i];
    C22 += f2[i] * f2[i];
    C12 += f1[i] * f2[i];
  }
  double J, cofactor1[dim], cofactor2[dim], q;
  if constexpr (dim == 2)
  {
    J            = f1[0] * f2[1] - f1[1] * f2[0];
    cofactor1[0] = f2[1];
    cofactor1[1] = -f2[0];
    cofactor2[0] = -f1[1];
    cofactor2[1] = f1[0];
    // tr C + 2 J as a sum of squares: near a reflection nothing cancels.
    q = (f1[0] + f2[1]) * (f1[0] + f2[1]) + (f1[1] - f2[0]) * (f1[1] - f2[0]);
  }
  else
  {
    double n[3]      = {f1[1] * f2[2] - f1[2] * f2[1], f1[2] * f2[0] - f1[0] * f2[2],
                        f1[0] * f2[1] - f1[1] * f2[0]};
    J                = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const bool flat  = J > 1e-14 * (C11 + C22);
    const double one = 1. / (flat ? J : 1.), inverse = flat ? one : 0.;
    for (int i = 0; i < 3; ++i)
      n[i] *= inverse;
    for (int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      cofactor1[i] = f2[j] * n[k] - f2[k] * n[j];
      cofactor2[i] = n[j] * f1[k] - n[k] * f1[j];
    }
    q = C11 + C22 + 2. * J;
  }
  const bool has_size = q > 1e-28 * (C11 + C22);
  const double root = 1. / std::sqrt(has_size ? q : 1.), p = has_size ? root : 0.;
  if constexpr (strain == Strain::linear)
  {
    frame[0 * stride] = f1[0] - 1.;
    frame[1 * stride] = f2[1] - 1.;
    frame[2 * stride] = f1[1] + f2[0];
  }
  else
  {
    frame[0 * stride] = p * (C11 + J) - 1.;
    frame[1 * stride] = p * (C22 + J) - 1.;
    frame[2 * stride] = 2. * p * C12;
  }
  for (std::size_t i = 0; i < dim; ++i)
  {
    double l1 = i == 0 ? 1. : 0., l2 = i == 1 ? 1. : 0.;
    if constexpr (lift == Lift::rotation)
    {
      l1 = p * (f1[i] + cofactor1[i]);
      l2 = p * (f2[i] + cofactor2[i]);
    }
    if constexpr (lift == Lift::affine)
    {
      l1 = f1[i];
      l2 = f2[i];
    }
    frame[(3 + 2 * i) * stride] = l1;
    frame[(4 + 2 * i) * stride] = l2;
  }
}

template <int dim>
Frame<dim> to_frame(const Eigen::Matrix<double, 3 + 2 * dim, 1> &row)
{
  Frame<dim> frame;
  frame.strain = row.template head<3>();
  for (int i = 0; i < dim; ++i)
    frame.lift.row(i) << row(3 + 2 * i), row(4 + 2 * i);
  return frame;
}
} // namespace

template <int dim>
CoarseFrames<dim>::CoarseFrames(const meshes::TriangleMesh &coarse_rest,
                                const UpsamplerOptions &options)
    : mesh(coarse_rest)
    , options(options)
{
  if (const auto faults = meshes::faults_of(coarse_rest, "coarse mesh"); !faults.empty())
    throw meshes::BadInput(faults);
  if (dim == 3 && options.strain == Strain::linear)
    throw meshes::BadInput(
      "up-sampling: the linear strain sym(F − I) exists in the plane only; in space use "
      "Strain::biot");
  const auto m = static_cast<std::size_t>(mesh.n_triangles());
  corners.resize(3 * m);
  inverse_rest.resize(4 * m);
  edges.resize(2 * dim * m);
  per_triangle.resize(n_components * m);
  const Eigen::VectorXd areas = meshes::signed_areas(mesh);
  first.assign(static_cast<std::size_t>(mesh.n_vertices()) + 1, 0);
  for (std::size_t t = 0; t < m; ++t)
  {
    const auto row = static_cast<Eigen::Index>(t);
    for (std::size_t k = 0; k < 3; ++k)
    {
      corners[k * m + t] = mesh.triangles(row, static_cast<Eigen::Index>(k));
      ++first[static_cast<std::size_t>(corners[k * m + t]) + 1];
    }
    const Eigen::RowVector2d x0 = mesh.vertices.row(corners[t]),
                             e1 = mesh.vertices.row(corners[m + t]) - x0,
                             e2 = mesh.vertices.row(corners[2 * m + t]) - x0;
    const double inverse        = 0.5 / areas(row);
    inverse_rest[t]             = inverse * e2(1);
    inverse_rest[m + t]         = -inverse * e2(0);
    inverse_rest[2 * m + t]     = -inverse * e1(1);
    inverse_rest[3 * m + t]     = inverse * e1(0);
  }
  for (std::size_t v = 1; v < first.size(); ++v)
    first[v] += first[v - 1];
  owner.resize(3 * m);
  share.resize(3 * m);
  std::vector<int> next(first.begin(), first.end() - 1);
  for (std::size_t t = 0; t < m; ++t)
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto slot =
        static_cast<std::size_t>(next[static_cast<std::size_t>(corners[k * m + t])]++);
      owner[slot] = static_cast<int>(t);
      share[slot] = areas(static_cast<Eigen::Index>(t));
    }
  for (std::size_t v = 0; v + 1 < first.size(); ++v)
  {
    double sum = 0.;
    for (int slot = first[v]; slot < first[v + 1]; ++slot)
      sum += share[static_cast<std::size_t>(slot)];
    for (int slot = first[v]; slot < first[v + 1]; ++slot)
      share[static_cast<std::size_t>(slot)] /= sum;
  }
  frames.resize(options.blend == Blend::continuous ? mesh.n_vertices() : mesh.n_triangles(),
                n_components);
}

template <int dim>
void CoarseFrames<dim>::evaluate_triangles(const PositionsOf<dim> current) const
{
  // First the edges, which must be collected one by one; then arithmetic on consecutive numbers.
  const auto m                        = static_cast<std::size_t>(mesh.n_triangles());
  const double *const __restrict x    = current.data();
  const int *const __restrict corner  = corners.data();
  double *const __restrict edge       = edges.data();
  const double *const __restrict rest = inverse_rest.data();
  double *const __restrict frame      = per_triangle.data();
  for (std::size_t t = 0; t < m; ++t)
  {
    const double *const x0 = x + dim * corner[t], *const x1 = x + dim * corner[m + t],
                        *const x2 = x + dim * corner[2 * m + t];
    for (std::size_t i = 0; i < dim; ++i)
    {
      edge[i * m + t]         = x1[i] - x0[i];
      edge[(dim + i) * m + t] = x2[i] - x0[i];
    }
  }
  with_choices(options,
               [=](const auto strain, const auto lift)
               {
#pragma GCC ivdep
                 for (std::size_t t = 0; t < m; ++t)
                 {
                   double f1[dim], f2[dim];
                   for (std::size_t i = 0; i < dim; ++i)
                   {
                     const double e1 = edge[i * m + t], e2 = edge[(dim + i) * m + t];
                     f1[i] = e1 * rest[t] + e2 * rest[2 * m + t];
                     f2[i] = e1 * rest[m + t] + e2 * rest[3 * m + t];
                   }
                   frame_of<dim, strain(), lift()>(f1, f2, frame + t, m);
                 }
               });
}

template <int dim>
const Eigen::Matrix<double, Eigen::Dynamic, CoarseFrames<dim>::n_components, Eigen::RowMajor> &
CoarseFrames<dim>::values(const PositionsOf<dim> current) const
{
  evaluate_triangles(current);
  const auto m              = static_cast<std::size_t>(mesh.n_triangles());
  const double *const frame = per_triangle.data();
  if (options.blend == Blend::piecewise)
  {
    for (std::size_t t = 0; t < m; ++t)
      for (std::size_t c = 0; c < n_components; ++c)
        frames(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(c)) = frame[c * m + t];
    return frames;
  }
  for (std::size_t v = 0; v + 1 < first.size(); ++v)
  {
    double sum[n_components] = {};
    for (int slot = first[v]; slot < first[v + 1]; ++slot)
    {
      const double weight        = share[static_cast<std::size_t>(slot)];
      const double *const source = frame + owner[static_cast<std::size_t>(slot)];
      for (std::size_t c = 0; c < n_components; ++c)
        sum[c] += weight * source[c * m];
    }
    for (int c = 0; c < n_components; ++c)
      frames(static_cast<Eigen::Index>(v), c) = sum[c];
  }
  return frames;
}

template <int dim>
Frame<dim> CoarseFrames<dim>::of_triangle(const int triangle, const Positions<dim> &current) const
{
  const auto m = static_cast<std::size_t>(mesh.n_triangles()),
             t = static_cast<std::size_t>(triangle);
  double f1[dim], f2[dim];
  for (int i = 0; i < dim; ++i)
  {
    const double x0 = current(corners[t], i), e1 = current(corners[m + t], i) - x0,
                 e2 = current(corners[2 * m + t], i) - x0;
    f1[i]           = e1 * inverse_rest[t] + e2 * inverse_rest[2 * m + t];
    f2[i]           = e1 * inverse_rest[m + t] + e2 * inverse_rest[3 * m + t];
  }
  Eigen::Matrix<double, n_components, 1> row;
  with_choices(options, [&](const auto strain, const auto lift)
               { frame_of<dim, strain(), lift()>(f1, f2, row.data(), 1); });
  return to_frame<dim>(row);
}

template <int dim>
Frame<dim> CoarseFrames<dim>::at(const int triangle, const Eigen::Vector3d &weights,
                                 const Positions<dim> &current) const
{
  if (options.blend == Blend::piecewise)
    return of_triangle(triangle, current);
  values(current);
  Eigen::Matrix<double, n_components, 1> row = Eigen::Matrix<double, n_components, 1>::Zero();
  for (int k = 0; k < 3; ++k)
    row += weights(k) * frames.row(mesh.triangles(triangle, k)).transpose();
  return to_frame<dim>(row);
}

template <int dim>
Eigen::Matrix<double, dim, 1>
fine_position(const CoarseFrames<dim> &frames, const int triangle, const Eigen::Vector3d &weights,
              const Eigen::Matrix<double, 1, 6> &chi, const Positions<dim> &current,
              const Eigen::Matrix<double, 1, 12> &quadratic)
{
  const Frame<dim> frame = frames.at(triangle, weights, current);
  Eigen::Vector2d w      = Eigen::Vector2d::Zero();
  for (int a = 0; a < 3; ++a)
    w -= frame.strain(a) * chi.segment<2>(2 * a).transpose();
  const Eigen::Matrix<double, 6, 1> factors = meshes::quadratic_factors(frame.strain);
  for (int k = 0; k < 6; ++k)
    w -= factors(k) * quadratic.segment<2>(2 * k).transpose();
  Eigen::Matrix<double, dim, 1> position = frame.lift * w;
  for (int k = 0; k < 3; ++k)
    position += weights(k) * current.row(frames.rest().triangles(triangle, k)).transpose();
  return position;
}

namespace
{
/// Columns of modes minus what the anchor says.
/// @param name of the modes, for the refusal
template <typename Rows>
Rows with_constant(const meshes::HomogenizedCell &cell, const Rows &modes, const Anchor anchor,
                   const std::string &name)
{
  if (modes.rows() != cell.mesh.n_vertices())
    throw meshes::BadInput("cell: has " + std::to_string(modes.rows()) + " rows of " + name +
                           "; expected " + std::to_string(cell.mesh.n_vertices()) +
                           ", one per vertex");
  if (!modes.allFinite())
    throw meshes::BadInput("cell: its " + name + " are not all finite");
  Eigen::Matrix<double, 1, Rows::ColsAtCompileTime> constant =
    Eigen::Matrix<double, 1, Rows::ColsAtCompileTime>::Zero();
  if (anchor == Anchor::lattice)
  {
    if (cell.anchor < 0 || cell.anchor >= cell.mesh.n_vertices())
      throw meshes::BadInput("cell: its anchor is vertex " + std::to_string(cell.anchor) +
                             "; expected 0 ... " + std::to_string(cell.mesh.n_vertices() - 1));
    constant = modes.row(cell.anchor);
  }
  else
  {
    const Eigen::VectorXd areas = meshes::signed_areas(cell.mesh);
    for (int t = 0; t < cell.mesh.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        constant += areas(t) / (3. * areas.sum()) * modes.row(cell.mesh.triangles(t, k));
  }
  return modes.rowwise() - constant;
}
} // namespace

meshes::Chi anchored(const meshes::HomogenizedCell &cell, const Anchor anchor)
{
  return with_constant(cell, cell.chi, anchor, "characteristic displacements");
}

meshes::QuadraticChi anchored_quadratic(const meshes::HomogenizedCell &cell, const std::string &law,
                                        const Anchor anchor)
{
  const auto found = cell.second_order.find(law);
  if (found == cell.second_order.end())
  {
    std::string laws;
    for (const auto &[name, second] : cell.second_order)
      laws += (laws.empty() ? "" : ", ") + name;
    throw meshes::BadInput("cell: has no quadratic modes under the law `" + law + "`; found " +
                           (laws.empty() ? "none" : "those of " + laws) +
                           ": make its cell.h5 again with `homespun homogenize`, or do without");
  }
  return with_constant(cell, found->second.chi, anchor, "quadratic modes");
}

meshes::QuadraticChi anchored_fitted(const meshes::HomogenizedCell &cell,
                                     const meshes::FittedModes &fitted, const Anchor anchor)
{
  return with_constant<meshes::QuadraticChi>(cell, fitted.modes, anchor, "fitted modes");
}

template class CoarseFrames<2>;
template class CoarseFrames<3>;
template Eigen::Vector2d fine_position<2>(const CoarseFrames<2> &, int, const Eigen::Vector3d &,
                                          const Eigen::Matrix<double, 1, 6> &, const Positions<2> &,
                                          const Eigen::Matrix<double, 1, 12> &);
template Eigen::Vector3d fine_position<3>(const CoarseFrames<3> &, int, const Eigen::Vector3d &,
                                          const Eigen::Matrix<double, 1, 6> &, const Positions<3> &,
                                          const Eigen::Matrix<double, 1, 12> &);
} // namespace homespun::localization
