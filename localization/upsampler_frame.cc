// SPDX-License-Identifier: MIT
// What an up-sampler does each frame.
#include "localization/upsampler.h"

#include "localization/curved_kernel.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <array>

namespace homespun::localization
{
namespace
{
/// Vertices that go through a buffer at once.
constexpr int chunk = 8 * lanes;

constexpr int n_blocks_of(const int n_vertices)
{
  return (n_vertices + lanes - 1) / lanes;
}

/// Fine vertices of one coarse triangle.
template <int dim, int terms, int modes, int between, typename Scalar>
void fine_block(const Corners<Scalar, record_size(modes, between)> &corners,
                const Blocks<Scalar> &blocks, const int n_blocks, const FineRows<Scalar> &to)
{
  if constexpr (between == flat_triangle)
    fine_positions<dim, terms, modes>(corners, blocks, n_blocks, to.positions);
  else
    curved_positions<terms, modes, between>(corners, blocks, n_blocks, to);
}

/// A chunk on its way to where it belongs.
template <int dim, typename Scalar>
struct RowBuffer
{
  Scalar positions[chunk * dim], normals[chunk * dim];

  FineRows<Scalar> rows()
  {
    return {positions, normals};
  }

  /// @param target_of the row of one of the n rows
  template <typename TargetOf>
  void copy(const int n, const FineRows<Scalar> &to, const TargetOf &target_of) const
  {
    for (int k = 0; k < n; ++k)
      std::copy_n(positions + k * dim, dim, to.positions + target_of(k) * dim);
    for (int k = 0; to.normals != nullptr && k < n; ++k)
      std::copy_n(normals + k * dim, dim, to.normals + target_of(k) * dim);
  }
};
} // namespace

template <int dim, typename Scalar>
PositionsOf<dim> Upsampler<dim, Scalar>::gathered(const PositionsOf<dim> coarse_current) const
{
  for (std::size_t v = 0; v < space_of_rest.size(); ++v)
    at_rest_vertices.row(static_cast<Eigen::Index>(v)) = coarse_current.row(space_of_rest[v]);
  return PositionsOf<dim>(at_rest_vertices.data(), at_rest_vertices.rows(), dim);
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::fill_records(const PositionsOf<dim> coarse_current) const
{
  const Eigen::Index n = coarse_current.rows();
  const int size       = n_numbers();
  if constexpr (dim == 3)
    if (surface)
      add_surface(coarse_current);
  for (Eigen::Index v = 0; v < n; ++v)
    for (int i = 0; i < dim; ++i)
      records[static_cast<std::size_t>(v * size + i)] = static_cast<Scalar>(coarse_current(v, i));
  if (!options.microscopic)
    return;
  const auto &values = frames.values(coarse_current);
  if (options.blend == Blend::continuous)
    for (Eigen::Index v = 0; v < n; ++v)
      for (int c = 0; c < frames.n_components; ++c)
        records[static_cast<std::size_t>(v * size + dim + c)] = static_cast<Scalar>(values(v, c));
  if (are_fitted(kind_of_modes(options)))
    fill_fitted_records(values);
  if (!slip.sources.empty())
    add_slip(coarse_current);
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::add_surface(const PositionsOf<3> coarse_current) const
{
  const CoarseSurface::Values &values = surface->values(coarse_current);
  const int size = n_numbers(), begin = bent_begin(dim, kind_of_modes(options));
  for (Eigen::Index v = 0; v < values.rows(); ++v)
    for (int c = 0; c < CoarseSurface::n_components; ++c)
      records[static_cast<std::size_t>(v * size + begin + c)] = static_cast<Scalar>(values(v, c));
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::add_slip(const PositionsOf<dim> coarse_current) const
{
  const int size = n_numbers();
  slip.evaluate(records.data(), size, moves_of_edges);
  moves.noalias() = slip.of_sources * moves_of_edges;
  for (Eigen::Index v = 0; v < moves.rows(); ++v)
    for (int i = 0; i < dim; ++i)
      records[static_cast<std::size_t>(v * size + i)] =
        static_cast<Scalar>(coarse_current(v, i) + moves(v, i));
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::fill_fitted_records(
  const typename CoarseFrames<dim>::Values &values) const
{
  using meshes::FittedResponse;
  constexpr std::size_t behind = dim + CoarseFrames<dim>::n_components, // what fitted modes add
    of_free                    = behind + meshes::FittedModes::n_modes;
  const auto size              = static_cast<std::size_t>(n_numbers());
  for (Eigen::Index first = 0; first < values.rows(); first += FittedResponse::width)
  {
    const Eigen::Index n = std::min<Eigen::Index>(FittedResponse::width, values.rows() - first);
    std::array<FittedResponse::Pack, 3> strains, free;
    for (Eigen::Index a = 0; a < 3; ++a)
    {
      FittedResponse::Pack &pack = strains[static_cast<std::size_t>(a)];
      pack.setZero();
      pack.head(n) = values.col(a).segment(first, n);
    }
    const auto response = fitted.at(strains);
    for (std::size_t a = 0; a < 3; ++a)
      free[a] = meshes::strain_of_free_edges(response[a], strains[a]);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      Scalar *const record = records.data() + static_cast<std::size_t>(first + i) * size;
      for (std::size_t k = 0; k < 3; ++k)
      {
        record[dim + k]     = static_cast<Scalar>(response[k](i));
        record[of_free + k] = static_cast<Scalar>(free[k](i));
      }
      for (std::size_t k = 3; k < response.size(); ++k)
        record[behind + k - 3] = static_cast<Scalar>(response[k](i));
    }
  }
}

template <int dim, typename Scalar>
template <int terms>
void Upsampler<dim, Scalar>::run_modes(const FineRows<Scalar> &to) const
{
  switch (kind_of_modes(options))
  {
  case linear_modes:
    return run_surface<terms, linear_modes>(to);
  case quadratic_modes:
    return run_surface<terms, quadratic_modes>(to);
  case fitted_modes:
    return run_surface<terms, fitted_modes>(to);
  case fitted_modes_and_free_edges:
    return run_surface<terms, fitted_modes_and_free_edges>(to);
  }
}

/// Where nothing bends the positions are those of flat triangles, to the bit.
template <int dim, typename Scalar>
template <int terms, int modes>
void Upsampler<dim, Scalar>::run_surface(const FineRows<Scalar> &to) const
{
  if constexpr (dim == 3 && (terms == affine || terms == blended))
  {
    const bool is_bent = surface && surface->is_bent();
    if (to.normals != nullptr)
      run<terms, modes, curved_surface_and_normals>(to);
    else if (is_bent)
      run<terms, modes, curved_surface>(to);
    if (is_bent)
      return;
  }
  run<terms, modes, flat_triangle>({to.positions, nullptr});
}

template <int dim, typename Scalar>
template <int terms, int modes, int between>
Corners<Scalar, record_size(modes, between)>
Upsampler<dim, Scalar>::corners_at(const int triangle) const
{
  const auto corner = frames.rest().triangles.row(triangle);
  auto corners      = corners_of<record_size(modes, between)>(
    records.data(), n_numbers(), std::array<int, 3>{corner(0), corner(1), corner(2)});
  if constexpr (terms == constant || terms == constant_plane)
    for (int c = 0; c < CoarseFrames<dim>::n_components; ++c)
      corners.at0[dim + c] = static_cast<Scalar>(frames.last_values()(triangle, c));
  return corners;
}

template <int dim, typename Scalar>
template <int terms, int modes, int between>
void Upsampler<dim, Scalar>::run_cells(const FineRows<Scalar> &to) const
{
  // A run is computed in whole blocks of lanes. What it writes too much lies in runs after it,
  // which are written later; at the end of the output it goes through a buffer.
  RowBuffer<dim, Scalar> buffer;
  for (int cell = 0; cell < cells.n_cells; ++cell)
    for (std::size_t t = 0; t < cells.triangles.size(); ++t)
    {
      const CellTriangle &run = cells.triangles[t];
      const int count = run.end - run.begin, first = cell * cells.n_block + run.begin,
                row = cells.first_row[t];
      if (count == 0)
        continue;
      const auto corners = corners_at<terms, modes, between>(coarse_triangle(
        run.in_cell, cells.quads, cells.n_along, cell % cells.n_along, cell / cells.n_along));
      if (first + count + lanes <= n_total)
      {
        fine_block<dim, terms, modes, between>(corners, cells.from(row, cell), n_blocks_of(count),
                                               to.from(first * dim));
        continue;
      }
      for (int done = 0; done < count; done += chunk)
      {
        const int part = std::min(chunk, count - done);
        fine_block<dim, terms, modes, between>(corners, cells.from(row + done, cell),
                                               n_blocks_of(part), buffer.rows());
        buffer.copy(part, to, [&](const int k) { return first + done + k; });
      }
    }
}

template <int dim, typename Scalar>
template <int terms, int modes, int between>
void Upsampler<dim, Scalar>::run(const FineRows<Scalar> &to) const
{
  run_cells<terms, modes, between>(to);
  RowBuffer<dim, Scalar> buffer;
  for (const Group &group : groups)
  {
    const auto corners = corners_at<terms, modes, between>(group.triangle);
    for (int done = 0; done < group.count; done += chunk)
    {
      const int part = std::min(chunk, group.count - done);
      fine_block<dim, terms, modes, between>(
        corners, own.from(group.begin + done, own.chi_blocks, own.free_blocks), n_blocks_of(part),
        buffer.rows());
      const int *const targets = target.data() + group.begin + done;
      buffer.copy(part, to, [&](const int k) { return targets[k]; });
    }
  }
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::run_frame(const PositionsOf<dim> coarse_current,
                                       const FineRows<Scalar> &to) const
{
  if (coarse_current.rows() != n_space)
    throw meshes::BadInput("coarse positions: have " + std::to_string(coarse_current.rows()) +
                           " rows; expected " + std::to_string(n_space) +
                           ", one per coarse vertex");
  if (!coarse_current.allFinite())
    for (Eigen::Index v = 0; v < coarse_current.rows(); ++v)
      if (!coarse_current.row(v).allFinite())
        throw meshes::BadInput(
          "coarse vertex " + std::to_string(v) +
          ": its position is not finite; the coarse solver should have refused it");
  fill_records(space_of_rest.empty() ? coarse_current : gathered(coarse_current));
  const bool in_plane  = options.lift == Lift::identity || options.strain == Strain::linear;
  const bool is_smooth = options.blend == Blend::continuous;
  if (!options.microscopic)
    run_surface<affine, linear_modes>(to);
  else if (is_smooth && in_plane)
    run_modes<blended_plane>(to);
  else if (is_smooth && dim == 2 && options.lift == Lift::rotation)
    run_modes<dim == 2 ? blended_rotation : blended>(to);
  else if (is_smooth)
    run_modes<blended>(to);
  else if (in_plane)
    run_modes<constant_plane>(to);
  else
    run_modes<constant>(to);
}

template void Upsampler<2, float>::run_frame(PositionsOf<2>, const FineRows<float> &) const;
template void Upsampler<2, double>::run_frame(PositionsOf<2>, const FineRows<double> &) const;
template void Upsampler<3, float>::run_frame(PositionsOf<3>, const FineRows<float> &) const;
template void Upsampler<3, double>::run_frame(PositionsOf<3>, const FineRows<double> &) const;
} // namespace homespun::localization
