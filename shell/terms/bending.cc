// SPDX-License-Identifier: MIT
#include "shell/terms/bending.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/index.h"
#include "shell/algebra/vertex_matrix.h"
#include "shell/terms/hinges.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace homespun::shell
{
namespace
{
/// E = −½ Σ_pairs w |x_a − x_b|²: the Hessian has w I at (a,b) and −Σ w I on the diagonal.
class Bending final : public Term
{
public:
  Bending(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness)
      : diagonal(Eigen::VectorXd::Zero(mesh.n_vertices()))
  {
    const Hinges hinges = hinges_of(mesh, stiffness);
    std::map<std::array<int, 2>, double> sums;
    for (int t = 0; t < mesh.n_triangles(); ++t)
    {
      const Patch &patch = hinges.patches[index(t)];
      for (std::size_t i = 0; i < patch.corner.size(); ++i)
        for (std::size_t j = 0; j < patch.corner.size(); ++j)
        {
          const HalfHinge &one   = hinges.of[index(t)][index(patch.corner[i])],
                          &other = hinges.of[index(t)][index(patch.corner[j])];
          const auto rows        = vertices_of(mesh, t, patch.corner[i], one);
          const auto cols        = vertices_of(mesh, t, patch.corner[j], other);
          const double Q =
            patch.stiffness(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
          for (int p = 0; p < 4; ++p)
            for (int q = 0; q < 4; ++q)
              if (rows[index(p)] < cols[index(q)]) // the others follow by symmetry, and translation
                sums[{rows[index(p)], cols[index(q)]}] += Q * one.weights(p) * other.weights(q);
        }
    }
    pairs.reserve(sums.size());
    weights.reserve(sums.size());
    for (const auto &[pair, weight] : sums)
    {
      pairs.push_back(pair);
      weights.push_back(weight);
      diagonal(pair[0]) -= weight;
      diagonal(pair[1]) -= weight;
    }
  }

  std::string name() const override
  {
    return "bending";
  }

  void couple(std::vector<std::array<int, 2>> &all) const override
  {
    all.insert(all.end(), pairs.begin(), pairs.end());
  }

  void attach(const BlockMatrix &matrix) override
  {
    places.clear();
    for (const auto &pair : pairs)
      places.push_back(matrix.slot(pair[0], pair[1]));
    diagonal_places.clear();
    for (int v = 0; v < static_cast<int>(diagonal.size()); ++v)
      diagonal_places.push_back(matrix.slot(v, v));
  }

  double energy(const Vectors &x) const override
  {
    double sum = 0.;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      sum -= weights[p] * (x.row(pairs[p][0]) - x.row(pairs[p][1])).squaredNorm();
    return 0.5 * sum;
  }

  // Pairs of both signs add up to a small part of what they are: each brings its own rounding.
  double round_off(const Vectors &x) const override
  {
    double sum = 0.;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      sum += std::abs(weights[p]) * (x.row(pairs[p][0]) - x.row(pairs[p][1])).squaredNorm();
    return 0.5 * std::numeric_limits<double>::epsilon() * sum;
  }

  void add_gradient(const Vectors &x, Vectors &gradient) const override
  {
    for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      const Eigen::RowVector3d pull = weights[p] * (x.row(pairs[p][1]) - x.row(pairs[p][0]));
      gradient.row(pairs[p][0]) += pull;
      gradient.row(pairs[p][1]) -= pull;
    }
  }

  void add_derivatives(const Vectors &x, Hessian, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    add_gradient(x, gradient);
    for (std::size_t p = 0; p < pairs.size(); ++p)
      add_scalar(places[p], weights[p], matrix);
    for (std::size_t v = 0; v < diagonal_places.size(); ++v)
      add_scalar(diagonal_places[v], diagonal(static_cast<Eigen::Index>(v)), matrix);
  }

  bool has_discrete_gradient() const override
  {
    return true;
  }

  // Of a quadratic energy it is the gradient half way.
  void add_discrete_gradient(const Vectors &old, const Vectors &x, Vectors &gradient,
                             VertexMatrix &jacobian) const override
  {
    add_gradient(0.5 * (old + x), gradient);
    const auto add = [&](const int a, const int b, const double weight)
    { jacobian.add(a, b, 0.5 * weight * Eigen::Matrix3d::Identity()); };
    for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      add(pairs[p][0], pairs[p][1], weights[p]);
      add(pairs[p][1], pairs[p][0], weights[p]);
    }
    for (int v = 0; v < static_cast<int>(diagonal.size()); ++v)
      add(v, v, diagonal(v));
  }

  std::size_t bytes() const override
  {
    return pairs.size() * (sizeof(pairs[0]) + sizeof(weights[0]) + sizeof(places[0])) +
           static_cast<std::size_t>(diagonal.size()) * (sizeof(double) + sizeof(places[0]));
  }

  /// The scalar matrix that all three components have (n,n) [N/m].
  Eigen::SparseMatrix<double> matrix() const
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      for (const int side : {0, 1})
        entries.emplace_back(pairs[p][index(side)], pairs[p][index(1 - side)], weights[p]);
    for (int v = 0; v < static_cast<int>(diagonal.size()); ++v)
      entries.emplace_back(v, v, diagonal(v));
    Eigen::SparseMatrix<double> result(diagonal.size(), diagonal.size());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

private:
  static void add_scalar(const BlockMatrix::Slot &where, const double value, BlockMatrix &matrix)
  {
    if (where.block >= 0)
      matrix.blocks[index(where.block)].diagonal().array() += value;
  }

  std::vector<std::array<int, 2>> pairs; ///< first < second
  std::vector<double> weights;           ///< [N/m]
  Eigen::VectorXd diagonal;              ///< (n) [N/m]
  std::vector<BlockMatrix::Slot> places, diagonal_places;
};

/// Vertices at rest farther than one edge from the outline.
std::vector<int> inside_two_rings(const meshes::TriangleMesh &rest)
{
  std::map<std::array<int, 2>, int> sides;
  const auto side = [&](const int t, const int k) {
    return std::array<int, 2>{rest.triangles(t, k), rest.triangles(t, (k + 1) % 3)};
  };
  for (int t = 0; t < rest.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      sides[side(t, k)] = t;
  std::vector<bool> is_outline(index(rest.n_vertices()), false);
  for (const auto &[edge, unused] : sides)
    if (sides.count({edge[1], edge[0]}) == 0)
      is_outline[index(edge[0])] = is_outline[index(edge[1])] = true;
  std::vector<bool> is_held(index(rest.n_vertices()), true);
  for (int t = 0; t < rest.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      is_held[index(rest.triangles(t, k))] = false; // but for vertices of no triangle
  for (int t = 0; t < rest.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      if (is_outline[index(rest.triangles(t, k))])
        for (int l = 0; l < 3; ++l)
          is_held[index(rest.triangles(t, l))] = true;
  std::vector<int> inside;
  for (int v = 0; v < rest.n_vertices(); ++v)
    if (!is_held[index(v)])
      inside.push_back(v);
  return inside;
}

/// Whether a triangle and those that share an edge with it lie at rest as each other's images in
/// the middles of these edges, as in a lattice cut along one diagonal.
/// @param slack of an edge; the gain is of second order in it
bool is_of_a_lattice(const meshes::TriangleMesh &rest, const Hinges &hinges, const int t,
                     const double slack)
{
  const auto corner = [&](const int triangle, const int k) -> Eigen::RowVector2d
  { return rest.vertices.row(rest.triangles(triangle, k % 3)); };
  for (int k = 0; k < 3; ++k)
    if (const HalfHinge &hinge = hinges.of[index(t)][index(k)]; hinge.opposite >= 0)
    {
      const Eigen::RowVector2d one = corner(t, k + 1), other = corner(t, k + 2),
                               image = one + other - corner(t, k);
      if (!((corner(hinge.neighbour, hinge.neighbour_corner) - image).norm() <=
            slack * (other - one).norm()))
        return false;
    }
  return true;
}

/// Whether the patch test tells all: each triangle is near to a vertex inside, or nearly one of a
/// lattice.
bool is_told_by(const std::vector<int> &inside, const meshes::TriangleMesh &rest,
                const Hinges &hinges)
{
  constexpr int rings_to_a_corner = 4;   // of a rectangle, cut along either diagonal
  constexpr double slack          = 0.1; // a gain below half of a per cent
  std::vector<bool> is_near(index(rest.n_vertices()), false);
  for (const int v : inside)
    is_near[index(v)] = true;
  const auto n_near = [&](const int t)
  {
    int n = 0;
    for (int k = 0; k < 3; ++k)
      n += is_near[index(rest.triangles(t, k))] ? 1 : 0;
    return n;
  };
  for (int ring = 0; ring < rings_to_a_corner; ++ring)
  {
    std::vector<int> reached;
    for (int t = 0; t < rest.n_triangles(); ++t)
      if (n_near(t) > 0)
        reached.push_back(t);
    for (const int t : reached)
      for (int k = 0; k < 3; ++k)
        is_near[index(rest.triangles(t, k))] = true;
  }
  for (int t = 0; t < rest.n_triangles(); ++t)
    if (n_near(t) < 3 && !is_of_a_lattice(rest, hinges, t, slack))
      return false;
  return true;
}

/// One stiffness on all of some panels that lie flat and are not sewn.
double gain_of(const meshes::ClothMesh &panels, const std::vector<int> &inside,
               const PlateStiffness &stiffness)
{
  if (inside.empty())
    return 0.;
  const Eigen::SparseMatrix<double> all = Bending(panels, {stiffness}).matrix();
  std::vector<int> place(index(all.rows()), -1);
  for (std::size_t i = 0; i < inside.size(); ++i)
    place[index(inside[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < all.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(all, c); entry; ++entry)
      if (place[index(c)] >= 0 && place[index(entry.row())] >= 0)
        entries.emplace_back(place[index(entry.row())], place[index(c)], entry.value());
  const auto n = static_cast<Eigen::Index>(inside.size());
  Eigen::SparseMatrix<double> free(n, n);
  free.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(free);
  const meshes::Points centred =
    panels.rest.vertices.rowwise() - panels.rest.vertices.colwise().mean();
  const Eigen::ArrayXd y1 = centred.col(0), y2 = centred.col(1);
  double largest = 0.;
  for (const Eigen::ArrayXd &shape : {(y1 * y1).eval(), (y2 * y2).eval(), (y1 * y2).eval()})
  {
    const Eigen::VectorXd z = shape, forces = all * z;
    Eigen::VectorXd residual(n);
    for (Eigen::Index i = 0; i < n; ++i)
      residual(i) = forces(inside[index(i)]);
    largest = std::max(largest, residual.dot(solver.solve(residual)) / z.dot(forces));
  }
  return largest;
}
} // namespace

double patch_test_gain(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness)
{
  neighbours_of(mesh, stiffness); // its refusals
  const std::vector<int> inside = inside_two_rings(mesh.rest);
  meshes::ClothMesh panels;
  panels.rest      = mesh.rest;
  panels.triangles = mesh.rest.triangles;
  panels.rest.material.setZero();
  panels.positions = meshes::SpacePoints::Zero(mesh.rest.n_vertices(), 3);
  if (!is_told_by(inside, mesh.rest, neighbours_of(panels, stiffness)))
    return std::numeric_limits<double>::infinity();
  double largest = 0.;
  for (const PlateStiffness &of_phase : stiffness)
    largest = std::max(largest, gain_of(panels, inside, of_phase));
  return largest;
}

bool is_cut_along_one_diagonal(const meshes::ClothMesh &mesh,
                               const std::vector<PlateStiffness> &stiffness)
{
  const Hinges hinges    = neighbours_of(mesh, stiffness);
  constexpr double slack = 1e-4; // a gain below 1e-9
  for (int t = 0; t < mesh.n_triangles(); ++t)
    if (!is_of_a_lattice(mesh.rest, hinges, t, slack))
      return false;
  return true;
}

std::unique_ptr<Term> bending_term(const meshes::ClothMesh &mesh,
                                   const std::vector<PlateStiffness> &stiffness)
{
  if (const double gain = patch_test_gain(mesh, stiffness); gain > largest_patch_test_gain)
  {
    std::ostringstream text;
    text.precision(2);
    text << "bending over hinges: on this mesh, held at a constant curvature, the plate is too "
            "soft by ";
    if (std::isfinite(gain))
      text << 100. * gain << " %";
    else
      text
        << "an unknown part, as some of a panel has no vertex inside two rings along its outline";
    text << "; expected at most " << 100. * largest_patch_test_gain
         << " %: cut the mesh along one diagonal, or take bending by edge angles "
            "(shell/terms/edge_angles.h), with the linearly implicit or the implicit integrator";
    throw meshes::BadInput(text.str());
  }
  return std::make_unique<Bending>(mesh, stiffness);
}
} // namespace homespun::shell
