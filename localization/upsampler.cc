// SPDX-License-Identifier: MIT
#include "localization/upsampler.h"

#include "localization/upsampler_faults.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/point_location.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

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
} // namespace

template <int dim, typename Scalar>
Upsampler<dim, Scalar>::Upsampler(const meshes::HomogenizedCell &cell,
                                  const meshes::TriangleMesh &coarse_rest,
                                  const meshes::Sheet &fine, const UpsamplerOptions &options)
    : frames(coarse_rest, options)
    , options(options)
    , fitted(options.fitted ? meshes::FittedResponse(*options.fitted) : meshes::FittedResponse())
{
  auto faults = sheet_faults(cell, fine);
  for (const std::string &fault : edge_faults(cell, options))
    faults.push_back(fault);
  for (const std::string &fault : mode_faults(options))
    faults.push_back(fault);
  if (!faults.empty())
    throw meshes::BadInput(faults);
  const CellModes modes = cell_modes(cell, options);
  const EdgeModes near_edges(cell, options);
  Panel panel         = panel_of(fine);
  const auto modes_at = [&](const int v)
  { return near_edges.added_to(modes.row(fine.cell_vertex(v)), panel, point_of(fine, v)); };
  for (int t = 0; t < coarse_rest.n_triangles(); ++t)
    panel.triangles.push_back(t);
  if (options.slip == Slip::added)
    slip = near_edges.slip_of({panel}, coarse_rest);
  n_total = fine.mesh.n_vertices();
  n_space = coarse_rest.n_vertices();
  if (const int quads = quads_per_cell(fine, coarse_rest);
      quads > 0 && options.path == Path::automatic)
    cells.fill(fine, quads, near_edges, panel, modes_at);
  place(modes_at, fine, cells.n_cells * cells.n_block);
  records.resize(static_cast<std::size_t>(coarse_rest.n_vertices()) *
                 static_cast<std::size_t>(record_size(kind_of_modes(options))));
}

template <int dim, typename Scalar>
Upsampler<dim, Scalar>::Upsampler(const PlacedVertices &placed)
    : frames(placed.coarse_rest, placed.options)
    , options(placed.options)
    , space_of_rest(placed.space_of_rest.begin(), placed.space_of_rest.end())
    , n_space(placed.n_space)
    , n_total(static_cast<int>(placed.triangle.size()))
    , fitted(options.fitted ? meshes::FittedResponse(*options.fitted) : meshes::FittedResponse())
    , slip(placed.slip)
{
  std::vector<std::vector<Member>> in_triangle(
    static_cast<std::size_t>(placed.coarse_rest.n_triangles()));
  for (int v = 0; v < n_total; ++v)
    in_triangle[static_cast<std::size_t>(placed.triangle(v))].push_back(
      {v, placed.weights.row(v).transpose()});
  tabulate(in_triangle, [&](const int v) { return placed.modes.row(v).eval(); });
  at_rest_vertices.resize(placed.coarse_rest.n_vertices(), dim);
  records.resize(static_cast<std::size_t>(placed.coarse_rest.n_vertices()) *
                 static_cast<std::size_t>(record_size(kind_of_modes(options))));
}

template <int dim, typename Scalar>
template <typename ModesAt>
void Upsampler<dim, Scalar>::place(const ModesAt &modes_at, const meshes::Sheet &fine,
                                   const int from)
{
  const meshes::PointLocation location(frames.rest());
  // Points on a coarse edge belong to the triangle at their upper right and below the diagonal, as
  // in the order of the sheet; without blending it matters.
  const Eigen::RowVector2d towards =
    1e-5 * Eigen::RowVector2d(2. / 3., 1. / 3.) * fine.lattice.vectors;
  std::vector<std::vector<Member>> in_triangle(
    static_cast<std::size_t>(frames.rest().n_triangles()));
  std::vector<std::string> faults;
  for (int v = from; v < n_total && faults.size() < 3; ++v)
  {
    const Eigen::RowVector2d point = fine.mesh.vertices.row(v);
    const meshes::Location found   = location.locate(point, towards);
    if (found.triangle >= 0)
    {
      in_triangle[static_cast<std::size_t>(found.triangle)].push_back({v, found.weights});
      continue;
    }
    std::ostringstream text;
    text << "fine vertex " << v << " at (" << point(0) << ", " << point(1)
         << ") m: lies in no coarse triangle; expected a coarse mesh that covers the whole sheet";
    faults.push_back(text.str());
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);
  tabulate(in_triangle, modes_at);
}

template <int dim, typename Scalar>
template <typename ChiAt>
void Upsampler<dim, Scalar>::tabulate(const std::vector<std::vector<Member>> &in_triangle,
                                      const ChiAt &chi_at)
{
  for (std::size_t t = 0; t < in_triangle.size(); ++t)
  {
    if (in_triangle[t].empty())
      continue;
    groups.push_back({static_cast<int>(t), own.size, static_cast<int>(in_triangle[t].size())});
    for (const Member &member : in_triangle[t])
    {
      own.append(member.weights, chi_at(member.vertex));
      target.push_back(member.vertex);
    }
    own.pad();
    target.resize(static_cast<std::size_t>(own.size), -1);
  }
  if (options.microscopic)
    return;
  own.chi_blocks = std::vector<ChiBlock<Scalar>>();
  for (std::vector<ChiBlock<Scalar>> &chi : cells.chi_of_kind)
    chi = std::vector<ChiBlock<Scalar>>();
}

template <int dim, typename Scalar>
bool Upsampler<dim, Scalar>::is_aligned() const
{
  return cells.quads > 0;
}

template <int dim, typename Scalar>
int Upsampler<dim, Scalar>::n_fine() const
{
  return n_total;
}

template <int dim, typename Scalar>
int Upsampler<dim, Scalar>::n_coarse() const
{
  return n_space;
}

template <int dim, typename Scalar>
std::size_t Upsampler<dim, Scalar>::table_bytes() const
{
  std::size_t bytes = sizeof(int) * (target.size() + cells.kind_of_cell.size());
  const auto add    = [&](const VertexTable<Scalar> &table)
  {
    bytes += sizeof(Weights<Scalar>) * table.weights.size() +
             sizeof(ChiBlock<Scalar>) * (table.chi_blocks.size() + table.free_blocks.size()) +
             sizeof(QuadraticBlock<Scalar>) * table.quadratic_blocks.size();
  };
  add(own);
  add(cells.shared);
  for (const auto *const of_kind : {&cells.chi_of_kind, &cells.free_of_kind})
    for (const std::vector<ChiBlock<Scalar>> &blocks : *of_kind)
      bytes += sizeof(ChiBlock<Scalar>) * blocks.size();
  return bytes;
}

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
  const int size       = record_size(kind_of_modes(options));
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
void Upsampler<dim, Scalar>::add_slip(const PositionsOf<dim> coarse_current) const
{
  const int size = record_size(kind_of_modes(options));
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
  const auto size              = static_cast<std::size_t>(record_size(kind_of_modes(options)));
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
void Upsampler<dim, Scalar>::run_modes(Scalar *const fine_current) const
{
  switch (kind_of_modes(options))
  {
  case linear_modes:
    return run<terms, linear_modes>(fine_current);
  case quadratic_modes:
    return run<terms, quadratic_modes>(fine_current);
  case fitted_modes:
    return run<terms, fitted_modes>(fine_current);
  case fitted_modes_and_free_edges:
    return run<terms, fitted_modes_and_free_edges>(fine_current);
  }
}

template <int dim, typename Scalar>
template <int terms, int modes>
Corners<Scalar, modes> Upsampler<dim, Scalar>::corners_at(const int triangle) const
{
  const auto corner = frames.rest().triangles.row(triangle);
  auto corners =
    corners_of<modes>(records.data(), std::array<int, 3>{corner(0), corner(1), corner(2)});
  if constexpr (terms == constant || terms == constant_plane)
    for (int c = 0; c < CoarseFrames<dim>::n_components; ++c)
      corners.at0[dim + c] = static_cast<Scalar>(frames.last_values()(triangle, c));
  return corners;
}

template <int dim, typename Scalar>
template <int terms, int modes>
void Upsampler<dim, Scalar>::run_cells(Scalar *const fine_current) const
{
  // A run is computed in whole blocks of lanes. What it writes too much lies in runs after it,
  // which are written later; at the end of the output it goes through a buffer.
  Scalar buffer[chunk * dim];
  for (int cell = 0; cell < cells.n_cells; ++cell)
    for (std::size_t t = 0; t < cells.triangles.size(); ++t)
    {
      const CellTriangle &run = cells.triangles[t];
      const int count = run.end - run.begin, first = cell * cells.n_block + run.begin,
                row = cells.first_row[t];
      if (count == 0)
        continue;
      const auto corners = corners_at<terms, modes>(coarse_triangle(
        run.in_cell, cells.quads, cells.n_along, cell % cells.n_along, cell / cells.n_along));
      if (first + count + lanes <= n_total)
      {
        fine_positions<dim, terms>(corners, cells.from(row, cell), n_blocks_of(count),
                                   fine_current + first * dim);
        continue;
      }
      for (int done = 0; done < count; done += chunk)
      {
        const int part = std::min(chunk, count - done);
        fine_positions<dim, terms>(corners, cells.from(row + done, cell), n_blocks_of(part),
                                   buffer);
        std::copy_n(buffer, part * dim, fine_current + (first + done) * dim);
      }
    }
}

template <int dim, typename Scalar>
template <int terms, int modes>
void Upsampler<dim, Scalar>::run(Scalar *const fine_current) const
{
  run_cells<terms, modes>(fine_current);
  Scalar buffer[chunk * dim];
  for (const Group &group : groups)
  {
    const auto corners  = corners_at<terms, modes>(group.triangle);
    const int *const to = target.data() + group.begin;
    for (int done = 0; done < group.count; done += chunk)
    {
      const int part = std::min(chunk, group.count - done);
      fine_positions<dim, terms>(corners,
                                 own.from(group.begin + done, own.chi_blocks, own.free_blocks),
                                 n_blocks_of(part), buffer);
      for (int k = 0; k < part; ++k)
        for (int i = 0; i < dim; ++i)
          fine_current[to[done + k] * dim + i] = buffer[k * dim + i];
    }
  }
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::upsample(const Positions<dim> &coarse_current,
                                      Fine &fine_current) const
{
  fine_current.resize(n_total, dim);
  upsample(PositionsOf<dim>(coarse_current.data(), coarse_current.rows(), dim),
           Eigen::Map<Fine>(fine_current.data(), n_total, dim));
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::upsample(const PositionsOf<dim> coarse_current,
                                      Eigen::Map<Fine> fine_current) const
{
  if (fine_current.rows() != n_total)
    throw meshes::BadInput("fine positions: room for " + std::to_string(fine_current.rows()) +
                           " rows; expected " + std::to_string(n_total) + ", one per fine vertex");
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
    run<affine, linear_modes>(fine_current.data());
  else if (is_smooth && in_plane)
    run_modes<blended_plane>(fine_current.data());
  else if (is_smooth && dim == 2 && options.lift == Lift::rotation)
    run_modes<dim == 2 ? blended_rotation : blended>(fine_current.data());
  else if (is_smooth)
    run_modes<blended>(fine_current.data());
  else if (in_plane)
    run_modes<constant_plane>(fine_current.data());
  else
    run_modes<constant>(fine_current.data());
}

template class Upsampler<2, float>;
template class Upsampler<2, double>;
template class Upsampler<3, float>;
template class Upsampler<3, double>;
} // namespace homespun::localization
