// SPDX-License-Identifier: MIT
#include "meshes/files/cell_edges_file.h"

#include "meshes/plain/errors.h"

#include <cmath>
#include <vector>

namespace homespun::meshes
{
namespace
{
constexpr int n_sides = CellEdges::n_sides;

std::string name_of_modes(const char *kind, const int side)
{
  return std::string("/edges/") + kind + "_" + std::to_string(side);
}

/// Stored as (row, component, strain); in memory a row is strain-major.
std::vector<double> stored(const EdgeModes &modes)
{
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(modes.size()));
  for (Eigen::Index row = 0; row < modes.rows(); ++row)
    for (int c = 0; c < 2; ++c)
      for (int a = 0; a < 3; ++a)
        values.push_back(modes(row, 2 * a + c));
  return values;
}

EdgeModes in_memory(const std::vector<double> &values)
{
  EdgeModes modes(static_cast<Eigen::Index>(values.size()) / 6, 6);
  for (Eigen::Index row = 0; row < modes.rows(); ++row)
    for (int c = 0; c < 2; ++c)
      for (int a = 0; a < 3; ++a)
        modes(row, 2 * a + c) = values[static_cast<std::size_t>(6 * row + 3 * c + a)];
  return modes;
}
} // namespace

void write_edges(const CellEdges &edges, const int n_vertices, Hdf5Writer &file)
{
  std::vector<double> slip, tension, decay, bulk;
  std::vector<int> n_cells;
  for (const CellEdge &edge : edges.sides)
  {
    for (int c = 0; c < 2; ++c)
      for (int a = 0; a < 3; ++a)
        slip.push_back(edge.slip(c, a));
    for (int a = 0; a < 3; ++a)
      tension.push_back(edge.tension(a));
    decay.push_back(edge.decay);
    n_cells.push_back(edge.n_cells);
  }
  for (const Eigen::Matrix3d &of_axis : edges.bulk)
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c)
        bulk.push_back(of_axis(a, c));
  file.write("/edges/slip", {n_sides, 2, 3}, slip.data(), "m");
  file.attribute("/edges/slip", "convention",
                 "edges where lattice coordinate 1 is smallest, largest, then 2; x, y; strain 11, "
                 "22, 12 with engineering shear; a clamped edge acts slip.E off where it is drawn");
  file.write("/edges/tension", {n_sides, 3}, tension.data(), "N");
  file.attribute("/edges/tension", "convention", "along a free edge, positive where it pulls");
  file.write("/edges/bulk", {2, 3, 3}, bulk.data(), "N");
  file.attribute("/edges/bulk", "convention",
                 "M_abc = <(sigma_c e_b).w_a> - <(sigma_a e_b).w_c>; axes: b, a, c; force on the "
                 "cloth: minus M_abc d_b E_a times the strain c of its virtual motion");
  file.write("/edges/decay", {n_sides}, decay.data(), "1");
  file.write("/edges/n_cells", {n_sides}, n_cells.data());
  for (int side = 0; side < n_sides; ++side)
  {
    const CellEdge &edge          = edges.sides[static_cast<std::size_t>(side)];
    const Hdf5Writer::Shape shape = {static_cast<unsigned long long>(edge.n_cells),
                                     static_cast<unsigned long long>(n_vertices), 2, 3};
    file.write(name_of_modes("clamped", side), shape, stored(edge.clamped).data(), "m");
    file.write(name_of_modes("free", side), shape, stored(edge.free).data(), "m");
  }
}

std::optional<CellEdges> read_cell_edges(const std::string &path)
{
  const Hdf5Reader file(path, "a cell.h5: make it with `homespun homogenize`");
  if (!file.has("/edges"))
    return std::nullopt;
  const std::vector<double> slip    = file.numbers("/edges/slip", {n_sides, 2, 3}),
                            tension = file.numbers("/edges/tension", {n_sides, 3}),
                            bulk    = file.numbers("/edges/bulk", {2, 3, 3}),
                            decay   = file.numbers("/edges/decay", {n_sides});
  const std::vector<int> n_cells    = file.integers("/edges/n_cells", {n_sides});
  const auto n                      = file.shape_of("/vertices", {Hdf5Reader::any, 2})[0];
  CellEdges edges;
  for (std::size_t b = 0; b < 2; ++b)
    edges.bulk[b] =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(bulk.data() + 9 * b);
  for (int side = 0; side < n_sides; ++side)
  {
    const auto k   = static_cast<std::size_t>(side);
    CellEdge &edge = edges.sides[k];
    edge.slip = Eigen::Map<const Eigen::Matrix<double, 2, 3, Eigen::RowMajor>>(slip.data() + 6 * k);
    edge.tension = Eigen::Map<const Eigen::Vector3d>(tension.data() + 3 * k);
    edge.decay   = decay[k];
    edge.n_cells = n_cells[k];
    if (edge.n_cells < 1 || !(edge.decay >= 0. && edge.decay < 1.))
      throw BadInput(path + ": edge " + std::to_string(side) + " has /edges/n_cells " +
                     std::to_string(edge.n_cells) + " and /edges/decay " +
                     std::to_string(edge.decay) +
                     "; expected at least one cell and a decay below 1");
    const Hdf5Reader::Shape shape = {static_cast<unsigned long long>(edge.n_cells), n, 2, 3};
    edge.clamped                  = in_memory(file.numbers(name_of_modes("clamped", side), shape));
    edge.free                     = in_memory(file.numbers(name_of_modes("free", side), shape));
    if (!edge.slip.allFinite() || !edge.tension.allFinite() || !edge.clamped.allFinite() ||
        !edge.free.allFinite())
      throw BadInput(path + ": edge " + std::to_string(side) +
                     " of /edges holds values that are not finite");
  }
  return edges;
}
} // namespace homespun::meshes
