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
  Panel panel = panel_of(fine);
  BentModes bent;
  if (dim == 3 && options.surface == Surface::curved)
  {
    bent = bent_modes(cell, options);
    surface.emplace(coarse_rest);
  }
  const auto append = appending(
    [&](const int v)
    { return near_edges.added_to(modes.row(fine.cell_vertex(v)), panel, point_of(fine, v)); },
    [&](const int v) { return bent.row(fine.cell_vertex(v)); });
  for (int t = 0; t < coarse_rest.n_triangles(); ++t)
    panel.triangles.push_back(t);
  if (options.slip == Slip::added)
    slip = near_edges.slip_of({panel}, coarse_rest);
  n_total = fine.mesh.n_vertices();
  n_space = coarse_rest.n_vertices();
  if (const int quads = quads_per_cell(fine, coarse_rest);
      quads > 0 && options.path == Path::automatic)
    cells.fill(fine, quads, near_edges, panel, append);
  place(append, fine, cells.n_cells * cells.n_block);
  records.resize(static_cast<std::size_t>(coarse_rest.n_vertices()) *
                 static_cast<std::size_t>(n_numbers()));
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
  if (dim == 3 && options.surface == Surface::curved)
    surface.emplace(placed.coarse_rest, space_of_rest);
  tabulate(in_triangle, appending([&](const int v) { return placed.modes.row(v).eval(); },
                                  [&](const int v) { return placed.bent.row(v); }));
  at_rest_vertices.resize(placed.coarse_rest.n_vertices(), dim);
  records.resize(static_cast<std::size_t>(placed.coarse_rest.n_vertices()) *
                 static_cast<std::size_t>(n_numbers()));
}

template <int dim, typename Scalar>
template <typename ModesAt, typename BentAt>
auto Upsampler<dim, Scalar>::appending(const ModesAt &modes_at, const BentAt &bent_at) const
{
  return [this, modes_at, bent_at](VertexTable<Scalar> &table, const int v,
                                   const meshes::Location &place)
  {
    table.append(place.weights, modes_at(v));
    if (!surface)
      return;
    Eigen::Matrix<double, 1, 9> deflection = bent_at(v);
    deflection.head<3>() += surface->quadric(place.triangle, place.weights);
    table.append_deflection(deflection);
  };
}

template <int dim, typename Scalar>
template <typename Append>
void Upsampler<dim, Scalar>::place(const Append &append, const meshes::Sheet &fine, const int from)
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
  tabulate(in_triangle, append);
}

template <int dim, typename Scalar>
template <typename Append>
void Upsampler<dim, Scalar>::tabulate(const std::vector<std::vector<Member>> &in_triangle,
                                      const Append &append)
{
  for (std::size_t t = 0; t < in_triangle.size(); ++t)
  {
    if (in_triangle[t].empty())
      continue;
    groups.push_back({static_cast<int>(t), own.size, static_cast<int>(in_triangle[t].size())});
    for (const Member &member : in_triangle[t])
    {
      append(own, member.vertex, meshes::Location{static_cast<int>(t), member.weights});
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

/// Per coarse vertex, also where nothing bends.
template <int dim, typename Scalar>
int Upsampler<dim, Scalar>::n_numbers() const
{
  return record_size(kind_of_modes(options), surface ? curved_surface : flat_triangle);
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
             sizeof(QuadraticBlock<Scalar>) * table.quadratic_blocks.size() +
             sizeof(DeflectionBlock<Scalar>) * table.deflection_blocks.size() +
             sizeof(ChiBlock<Scalar>) * table.slope_blocks.size();
  };
  add(own);
  add(cells.shared);
  for (const auto *const of_kind : {&cells.chi_of_kind, &cells.free_of_kind})
    for (const std::vector<ChiBlock<Scalar>> &blocks : *of_kind)
      bytes += sizeof(ChiBlock<Scalar>) * blocks.size();
  return bytes;
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
void Upsampler<dim, Scalar>::upsample(const Positions<dim> &coarse_current, Fine &fine_current,
                                      Fine &normals) const
{
  fine_current.resize(n_total, dim);
  normals.resize(n_total, dim);
  upsample(PositionsOf<dim>(coarse_current.data(), coarse_current.rows(), dim),
           Eigen::Map<Fine>(fine_current.data(), n_total, dim),
           Eigen::Map<Fine>(normals.data(), n_total, dim));
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::upsample(const PositionsOf<dim> coarse_current,
                                      Eigen::Map<Fine> fine_current) const
{
  check_room(fine_current.rows(), "fine positions");
  run_frame(coarse_current, {fine_current.data(), nullptr});
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::upsample(const PositionsOf<dim> coarse_current,
                                      Eigen::Map<Fine> fine_current, Eigen::Map<Fine> normals) const
{
  if (!surface)
    throw meshes::BadInput("normals: the surface is that of flat triangles in space, or one in the "
                           "plane; expected a curved one, of a method with the term curved");
  check_room(fine_current.rows(), "fine positions");
  check_room(normals.rows(), "normals");
  run_frame(coarse_current, {fine_current.data(), normals.data()});
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::check_room(const Eigen::Index n_rows, const std::string &name) const
{
  if (n_rows != n_total)
    throw meshes::BadInput(name + ": room for " + std::to_string(n_rows) + " rows; expected " +
                           std::to_string(n_total) + ", one per fine vertex");
}

template class Upsampler<2, float>;
template class Upsampler<2, double>;
template class Upsampler<3, float>;
template class Upsampler<3, double>;
} // namespace homespun::localization
