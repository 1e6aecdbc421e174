// SPDX-License-Identifier: MIT
#include "homogenization/lint/mechanisms.h"

#include "meshes/plain/index.h"
#include "meshes/plain/singular_values.h"
#include "meshes/plain/vertex_images.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace homespun::homogenization
{
using meshes::at;
using meshes::ImageClasses;
using meshes::Lattice;
using meshes::TriangleMesh;

namespace
{
using Shift = Eigen::RowVector2i; ///< in lattice vectors

/// Vertices of the cell with opposite sides glued: of each boundary, for only they have images.
ImageClasses torus_vertices(const TriangleMesh &mesh, const Lattice &lattice)
{
  std::set<int> boundary;
  for (const std::array<int, 2> &edge : meshes::boundary_edges(mesh))
    boundary.insert(edge.begin(), edge.end());
  return meshes::match_images(mesh, {boundary.begin(), boundary.end()}, lattice);
}

/// Triangles in disjoint sets, each with the shift that brings it beside the first of its set.
class ShiftedSets
{
public:
  explicit ShiftedSets(const int n)
      : parent(static_cast<std::size_t>(n))
      , shift_to_parent(static_cast<std::size_t>(n), Shift(0, 0))
  {
    std::iota(parent.begin(), parent.end(), 0);
  }

  /// The first triangle of the set, and the shift of t against it.
  std::pair<int, Shift> find(const int t)
  {
    int root    = t;
    Shift total = Shift(0, 0);
    for (; parent[static_cast<std::size_t>(root)] != root;
         root = parent[static_cast<std::size_t>(root)])
      total += shift_to_parent[static_cast<std::size_t>(root)];
    // Each triangle on the way now hangs on the root itself.
    Shift left = total;
    for (int k = t; parent[static_cast<std::size_t>(k)] != k;)
    {
      const auto here       = static_cast<std::size_t>(k);
      const int next        = parent[here];
      const Shift its       = shift_to_parent[here];
      parent[here]          = root;
      shift_to_parent[here] = left;
      left -= its;
      k = next;
    }
    return {root, total};
  }

  /// Joins the sets so that shift(two) = shift(one) + difference; where they are one already, what
  /// is left of the difference is a lattice vector across which the set is connected with its own
  /// image.
  Shift join(const int one, const int two, const Shift &difference)
  {
    const auto [root1, shift1] = find(one);
    const auto [root2, shift2] = find(two);
    const Shift left           = shift1 + difference - shift2;
    if (root1 == root2)
      return left;
    parent[static_cast<std::size_t>(root2)]          = root1;
    shift_to_parent[static_cast<std::size_t>(root2)] = left;
    return Shift(0, 0);
  }

private:
  std::vector<int> parent;
  std::vector<Shift> shift_to_parent;
};

/// A vertex of a part: its position is that of the representative, shifted.
struct Joint
{
  int vertex, part;
  Shift shift;
};

struct Structure
{
  std::vector<Joint> joints;               ///< of the same vertex one after the other, two or more
  std::vector<std::vector<Shift>> periods; ///< of each part
};

/// Rows of the linear system of rigid motions; lengths are in parts of the cell size.
/// @param with_strain appends the three unknowns e11, e22, gamma12
Eigen::MatrixXd motion_equations(const TriangleMesh &mesh, const Lattice &lattice,
                                 const Structure &structure, const std::size_t n_parts,
                                 const bool with_strain)
{
  const double size       = std::sqrt(lattice.area());
  const Eigen::Matrix2d a = lattice.vectors / size;
  const Eigen::Index n    = 3 * static_cast<Eigen::Index>(n_parts);
  std::vector<Eigen::RowVectorXd> rows;
  // u − e shift of a part at a point, in component k, times sign, added to a row
  const auto add = [&](Eigen::RowVectorXd &row, const int k, const int part,
                       const Eigen::RowVector2d &x, const Eigen::RowVector2d &shift,
                       const double sign)
  {
    row(3 * part + k) += sign;
    row(3 * part + 2) += sign * (k == 0 ? -x(1) : x(0));
    if (!with_strain)
      return;
    row(n + k) -= sign * shift(k);
    row(n + 2) -= sign * 0.5 * shift(1 - k);
  };
  const auto empty_row = [&]()
  { return Eigen::RowVectorXd(Eigen::RowVectorXd::Zero(n + (with_strain ? 3 : 0))); };
  for (std::size_t j = 1; j < structure.joints.size(); ++j)
  {
    const Joint &one = structure.joints[j - 1], &two = structure.joints[j];
    if (one.vertex != two.vertex)
      continue;
    const Eigen::RowVector2d x = mesh.vertices.row(one.vertex) / size;
    for (int k = 0; k < 2; ++k)
    {
      Eigen::RowVectorXd row      = empty_row();
      const Eigen::RowVector2d s1 = one.shift.cast<double>() * a, s2 = two.shift.cast<double>() * a;
      add(row, k, one.part, x + s1, s1, 1.);
      add(row, k, two.part, x + s2, s2, -1.);
      rows.push_back(row);
    }
  }
  for (std::size_t p = 0; p < n_parts; ++p)
    for (const Shift &period : structure.periods[p])
      for (int k = 0; k < 2; ++k)
      {
        Eigen::RowVectorXd row     = empty_row();
        const Eigen::RowVector2d s = period.cast<double>() * a;
        add(row, k, static_cast<int>(p), s, s, 1.);
        add(row, k, static_cast<int>(p), Eigen::RowVector2d(0., 0.), Eigen::RowVector2d(0., 0.),
            -1.);
        rows.push_back(row);
      }
  Eigen::MatrixXd equations(static_cast<Eigen::Index>(rows.size()), n + (with_strain ? 3 : 0));
  for (std::size_t r = 0; r < rows.size(); ++r)
    equations.row(static_cast<Eigen::Index>(r)) = rows[r];
  return equations;
}

/// Orthonormal motions without energy, one per column.
Eigen::MatrixXd kernel_of(const Eigen::MatrixXd &equations)
{
  if (equations.rows() == 0)
    return Eigen::MatrixXd::Identity(equations.cols(), equations.cols());
  // Entries are of size one, or as small as a part is against the cell.
  const meshes::SingularValues svd = meshes::singular_values(equations, Eigen::ComputeFullV);
  Eigen::Index rank                = 0;
  while (rank < svd.values.size() && svd.values(rank) > 1e-9)
    ++rank;
  return svd.V.rightCols(equations.cols() - rank);
}

void find_motions(const TriangleMesh &mesh, const Lattice &lattice, const Structure &structure,
                  Mechanisms &found)
{
  const std::size_t n_parts = found.parts.size();
  const Eigen::MatrixXd internal =
    kernel_of(motion_equations(mesh, lattice, structure, n_parts, false));
  const double size = std::sqrt(lattice.area());
  for (std::size_t p = 1; p < n_parts && internal.cols() > 2; ++p)
  {
    // Against the largest part, at the place of this one.
    const auto here            = static_cast<Eigen::Index>(3 * p);
    const Eigen::RowVector2d x = found.parts[p].place.point / size;
    const auto at              = [&](const Eigen::Index part, const Eigen::Index column)
    {
      return Eigen::Vector2d(internal(part, column) - internal(part + 2, column) * x(1),
                             internal(part + 1, column) + internal(part + 2, column) * x(0));
    };
    for (Eigen::Index column = 0; column < internal.cols(); ++column)
      if ((at(here, column) - at(0, column)).norm() > 1e-7 ||
          std::abs(internal(here + 2, column) - internal(2, column)) > 1e-7)
        found.parts[p].is_free = true;
  }
  const Eigen::MatrixXd all = kernel_of(motion_equations(mesh, lattice, structure, n_parts, true));
  const Eigen::Index n_free =
    std::max<Eigen::Index>(0, std::min<Eigen::Index>(3, all.cols() - internal.cols()));
  if (n_free > 0)
  {
    const Eigen::MatrixXd strains = all.bottomRows(3);
    found.free_strains = meshes::singular_values(strains, Eigen::ComputeFullU).U.leftCols(n_free);
  }
}
// An edge of the torus: both representatives and the shift from one to the other.
using Edge = std::tuple<int, int, int, int>;

/// Triangles joined over their edges.
struct Joined
{
  explicit Joined(const int n_triangles)
      : sets(n_triangles)
  {
  }
  ShiftedSets sets;
  std::map<Edge, int> n_sides;               ///< triangles at an edge
  std::vector<std::pair<int, Shift>> cycles; ///< a triangle that meets its own image, and which
};

Joined join_triangles(const TriangleMesh &mesh, const ImageClasses &torus)
{
  struct Side
  {
    int triangle;
    Shift offset; ///< of the edge's first vertex in that triangle
  };
  std::map<Edge, Side> first_side;
  Joined joined(mesh.n_triangles());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      int u = mesh.triangles(t, k), v = mesh.triangles(t, (k + 1) % 3);
      Shift step              = torus.offset.row(v) - torus.offset.row(u);
      const auto is_backwards = [&]()
      {
        if (torus.representative[at(u)] != torus.representative[at(v)])
          return torus.representative[at(u)] > torus.representative[at(v)];
        return step(0) < 0 || (step(0) == 0 && step(1) < 0);
      };
      if (is_backwards())
      {
        std::swap(u, v);
        step = -step;
      }
      const Edge edge(torus.representative[at(u)], torus.representative[at(v)], step(0), step(1));
      const auto [place, is_new] = first_side.insert({edge, {t, torus.offset.row(u)}});
      ++joined.n_sides[edge];
      if (is_new)
        continue;
      const Shift left =
        joined.sets.join(place->second.triangle, t, place->second.offset - torus.offset.row(u));
      if (left != Shift(0, 0))
        joined.cycles.emplace_back(t, left);
    }
  return joined;
}

/// The parts, the largest first, and which one each triangle belongs to.
Mechanisms parts_of(const TriangleMesh &mesh, ShiftedSets &sets)
{
  Mechanisms found;
  const Eigen::VectorXd areas = meshes::signed_areas(mesh);
  std::map<int, MeshPart> by_root;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    MeshPart &part = by_root[sets.find(t).first];
    if (part.n_triangles++ == 0)
      part.place = {(mesh.vertices.row(mesh.triangles(t, 0)) +
                     mesh.vertices.row(mesh.triangles(t, 1)) +
                     mesh.vertices.row(mesh.triangles(t, 2))) /
                      3.,
                    t, -1};
    part.area += areas(t);
  }
  std::vector<int> roots;
  for (const auto &entry : by_root)
    roots.push_back(entry.first);
  std::stable_sort(roots.begin(), roots.end(),
                   [&](const int a, const int b) { return by_root[a].area > by_root[b].area; });
  std::map<int, int> index_of;
  for (const int root : roots)
  {
    index_of[root] = static_cast<int>(found.parts.size());
    found.parts.push_back(by_root[root]);
  }
  for (int t = 0; t < mesh.n_triangles(); ++t)
    found.part.push_back(index_of[sets.find(t).first]);
  return found;
}

void find_periods(const std::vector<std::pair<int, Shift>> &cycles, Structure &structure,
                  Mechanisms &found)
{
  structure.periods.resize(found.parts.size());
  for (const auto &[t, period] : cycles)
  {
    std::vector<Shift> &its =
      structure.periods[static_cast<std::size_t>(found.part[static_cast<std::size_t>(t)])];
    const auto cross = [](const Shift &one, const Shift &other)
    { return one(0) * other(1) - one(1) * other(0); };
    if (its.empty() || (its.size() == 1 && cross(its[0], period) != 0))
      its.push_back(period);
  }
  for (std::size_t p = 0; p < found.parts.size(); ++p)
    found.parts[p].n_periods = static_cast<int>(structure.periods[p].size());
}

void find_hinges(const std::map<Edge, int> &n_sides, Mechanisms &found)
{
  // Vertices where triangles meet in nothing but the vertex: more than two edges there have one
  // triangle.
  std::map<int, int> n_free_edges;
  for (const auto &[edge, n] : n_sides)
    if (n == 1)
    {
      ++n_free_edges[std::get<0>(edge)];
      ++n_free_edges[std::get<1>(edge)];
    }
  std::set<int> hinges;
  for (const auto &[vertex, n] : n_free_edges)
    if (n > 2)
      hinges.insert(vertex);
  found.hinges.assign(hinges.begin(), hinges.end());
}

/// Which parts meet in which hinges.
void find_joints(const TriangleMesh &mesh, const ImageClasses &torus, ShiftedSets &sets,
                 Structure &structure, Mechanisms &found)
{
  const std::set<int> hinges(found.hinges.begin(), found.hinges.end());
  std::set<std::array<int, 4>> incidences;
  for (int t = 0; t < mesh.n_triangles() && !hinges.empty(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const auto v = static_cast<std::size_t>(mesh.triangles(t, k));
      if (hinges.count(torus.representative[at(v)]) == 0)
        continue;
      const Shift shift = torus.offset.row(v) + sets.find(t).second;
      incidences.insert(
        {torus.representative[at(v)], found.part[static_cast<std::size_t>(t)], shift(0), shift(1)});
    }
  for (const auto &[vertex, part, n1, n2] : incidences)
    structure.joints.push_back({vertex, part, Shift(n1, n2)});
  for (std::size_t j = 0; j < structure.joints.size(); ++j)
  {
    const bool is_shared =
      (j > 0 && structure.joints[j - 1].vertex == structure.joints[j].vertex) ||
      (j + 1 < structure.joints.size() &&
       structure.joints[j + 1].vertex == structure.joints[j].vertex);
    found.parts[static_cast<std::size_t>(structure.joints[j].part)].n_joints += is_shared ? 1 : 0;
  }
}
} // namespace

Mechanisms find_mechanisms(const TriangleMesh &mesh, const Lattice &lattice)
{
  const ImageClasses torus = torus_vertices(mesh, lattice);
  Joined joined            = join_triangles(mesh, torus);
  Mechanisms found         = parts_of(mesh, joined.sets);
  Structure structure;
  find_periods(joined.cycles, structure, found);
  find_hinges(joined.n_sides, found);
  find_joints(mesh, torus, joined.sets, structure, found);
  const bool holds = found.parts.size() == 1 && found.parts[0].n_periods == 2;
  if (holds)
    return found;
  if (found.parts.size() <= static_cast<std::size_t>(most_parts))
    find_motions(mesh, lattice, structure, found);
  else
  {
    found.is_determined = false;
    for (std::size_t p = 1; p < found.parts.size(); ++p)
      found.parts[p].is_free = found.parts[p].n_joints == 0;
  }
  return found;
}
} // namespace homespun::homogenization
