// SPDX-License-Identifier: MIT
#include "localization/coarse_frames.h"

#include "meshes/plain/errors.h"

#include <algorithm>
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
  inverse_rest.resize(4 * ((m + abreast - 1) / abreast * abreast));
  of_triangles.resize(mesh.n_triangles(), n_components);
  const Eigen::VectorXd areas = meshes::signed_areas(mesh);
  first.assign(static_cast<std::size_t>(mesh.n_vertices()) + 1, 0);
  for (std::size_t t = 0; t < m; ++t)
  {
    const auto row = static_cast<Eigen::Index>(t);
    for (std::size_t k = 0; k < 3; ++k)
    {
      corners[3 * t + k] = mesh.triangles(row, static_cast<Eigen::Index>(k));
      ++first[static_cast<std::size_t>(corners[3 * t + k]) + 1];
    }
    const Eigen::RowVector2d x0 = mesh.vertices.row(corners[3 * t]),
                             e1 = mesh.vertices.row(corners[3 * t + 1]) - x0,
                             e2 = mesh.vertices.row(corners[3 * t + 2]) - x0;
    const double inverse        = 0.5 / areas(row);
    double *const entries       = inverse_rest.data() + 4 * (t - t % abreast) + t % abreast;
    entries[0]                  = inverse * e2(1);
    entries[abreast]            = -inverse * e2(0);
    entries[2 * abreast]        = -inverse * e1(1);
    entries[3 * abreast]        = inverse * e1(0);
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
        static_cast<std::size_t>(next[static_cast<std::size_t>(corners[3 * t + k])]++);
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
  if (options.blend == Blend::continuous)
    of_vertices.resize(mesh.n_vertices(), n_components);
}

template <int dim>
template <Strain strain, Lift lift>
void CoarseFrames<dim>::evaluate(const double *const __restrict x, const std::size_t begin) const
{
  double edge[2 * dim][abreast], frame[n_components][abreast];
  const auto last = static_cast<std::size_t>(mesh.n_triangles()) - 1;
  for (std::size_t k = 0; k < abreast; ++k)
  {
    const int *const corner = corners.data() + 3 * std::min(begin + k, last);
    const double *const x0 = x + dim * corner[0], *const x1 = x + dim * corner[1],
                        *const x2 = x + dim * corner[2];
    for (std::size_t i = 0; i < dim; ++i)
    {
      edge[i][k]       = x1[i] - x0[i];
      edge[dim + i][k] = x2[i] - x0[i];
    }
  }
  const double *const inverse = inverse_rest.data() + 4 * begin;
#pragma GCC ivdep
  for (std::size_t k = 0; k < abreast; ++k)
  {
    double f1[dim], f2[dim];
    for (std::size_t i = 0; i < dim; ++i)
    {
      const double e1 = edge[i][k], e2 = edge[dim + i][k];
      f1[i] = e1 * inverse[k] + e2 * inverse[2 * abreast + k];
      f2[i] = e1 * inverse[abreast + k] + e2 * inverse[3 * abreast + k];
    }
    frame_of<dim, strain, lift>(f1, f2, &frame[0][k], abreast);
  }
  double *const rows  = of_triangles.data() + n_components * begin;
  const std::size_t n = std::min(abreast, last + 1 - begin);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t c = 0; c < n_components; ++c)
      rows[n_components * k + c] = frame[c][k];
}

template <int dim>
const typename CoarseFrames<dim>::Values &
CoarseFrames<dim>::values(const PositionsOf<dim> current) const
{
  with_choices(options,
               [&](const auto strain, const auto lift)
               {
                 const auto m = static_cast<std::size_t>(mesh.n_triangles());
                 for (std::size_t begin = 0; begin < m; begin += abreast)
                   evaluate<strain(), lift()>(current.data(), begin);
               });
  if (options.blend == Blend::piecewise)
    return of_triangles;
  const double *const __restrict rows = of_triangles.data();
  double *const __restrict averages   = of_vertices.data();
  for (std::size_t v = 0; v + 1 < first.size(); ++v)
  {
    double sum[n_components] = {};
    for (int slot = first[v]; slot < first[v + 1]; ++slot)
    {
      const double weight     = share[static_cast<std::size_t>(slot)];
      const double *const row = rows + owner[static_cast<std::size_t>(slot)] * n_components;
#pragma GCC unroll 16
      for (int c = 0; c < n_components; ++c)
        sum[c] += weight * row[c];
    }
    for (std::size_t c = 0; c < n_components; ++c)
      averages[v * n_components + c] = sum[c];
  }
  return of_vertices;
}

template <int dim>
Frame<dim> CoarseFrames<dim>::of_triangle(const int triangle, const Positions<dim> &current) const
{
  const auto t                = static_cast<std::size_t>(triangle);
  const double *const inverse = inverse_rest.data() + 4 * (t - t % abreast) + t % abreast;
  double f1[dim], f2[dim];
  for (int i = 0; i < dim; ++i)
  {
    const double x0 = current(corners[3 * t], i), e1 = current(corners[3 * t + 1], i) - x0,
                 e2 = current(corners[3 * t + 2], i) - x0;
    f1[i]           = e1 * inverse[0] + e2 * inverse[2 * abreast];
    f2[i]           = e1 * inverse[abreast] + e2 * inverse[3 * abreast];
  }
  Eigen::Matrix<double, n_components, 1> row;
  with_choices(options, [&](const auto strain, const auto lift)
               { frame_of<dim, strain(), lift()>(f1, f2, row.data(), 1); });
  Frame<dim> frame;
  frame.strain = row.template head<3>();
  for (int i = 0; i < dim; ++i)
    frame.lift.row(i) << row(3 + 2 * i), row(4 + 2 * i);
  return frame;
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

meshes::Deflection anchored_deflection(const meshes::HomogenizedCell &cell, const Anchor anchor)
{
  if (!cell.bending)
    throw meshes::BadInput("cell: has no deflection of a bent sheet, which a curved surface takes: "
                           "make its cell.h5 again with `homespun homogenize`, with both "
                           "stiffnesses, or do without");
  return with_constant(cell, cell.bending->deflection, anchor, "deflections");
}

meshes::QuadraticChi anchored_fitted(const meshes::HomogenizedCell &cell,
                                     const meshes::FittedModes &fitted, const Anchor anchor)
{
  return with_constant<meshes::QuadraticChi>(cell, fitted.modes, anchor, "fitted modes");
}

template class CoarseFrames<2>;
template class CoarseFrames<3>;
} // namespace homespun::localization
