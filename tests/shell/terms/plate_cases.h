// SPDX-License-Identifier: MIT
// Meshes that a plate must not feel, a plate in its plane under small deflections, and the form of
// edge angles written down a second time, with both unknowns and from other formulas, to hold
// shell/terms/edge_angles.h against and to plant faults in.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/algebra/block_cholesky.h"
#include "shell/terms/edge_angles.h"
#include "tests/shell/terms/term_cases.h"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace homespun::tests
{
inline const std::vector<std::string> plate_meshes = {"one diagonal", "alternating", "shaken",
                                                      "Delaunay"};

/// Off its axes: bending along them twists it.
inline const shell::PlateStiffness skewed_plate{2e-6, 8e-7, 2e-7, 5e-7, 4e-7, -2e-7};

inline shell::Vectors crumpled(const meshes::ClothMesh &mesh, const double distance)
{
  std::mt19937 generator(3);
  return mesh.positions + distance * random_matrix<shell::Vectors>(generator, mesh.n_vertices(), 3);
}

/// Turns diagonals until every triangle's circle is empty (Lawson).
inline void make_delaunay(meshes::TriangleMesh &mesh)
{
  const auto angle_at = [&](const int t, const int k)
  {
    const Eigen::RowVector2d x = mesh.vertices.row(mesh.triangles(t, k)),
                             u = mesh.vertices.row(mesh.triangles(t, (k + 1) % 3)) - x,
                             v = mesh.vertices.row(mesh.triangles(t, (k + 2) % 3)) - x;
    return std::atan2(meshes::cross(u, v), u.dot(v));
  };
  for (bool turned = true; turned;)
  {
    turned = false;
    std::map<std::array<int, 2>, std::array<int, 2>> sides;
    std::vector<bool> is_new(static_cast<std::size_t>(mesh.n_triangles()), false);
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        sides[{mesh.triangles(t, (k + 1) % 3), mesh.triangles(t, (k + 2) % 3)}] = {t, k};
    for (const auto &[edge, side] : sides)
    {
      const auto [t, k] = side;
      const auto other  = sides.find({edge[1], edge[0]});
      if (other == sides.end())
        continue;
      const auto [s, l] = other->second;
      if (is_new[static_cast<std::size_t>(t)] || is_new[static_cast<std::size_t>(s)] ||
          angle_at(t, k) + angle_at(s, l) < M_PI + 1e-9)
        continue;
      const int c = mesh.triangles(t, k), d = mesh.triangles(s, l);
      mesh.triangles.row(t) << edge[0], d, c;
      mesh.triangles.row(s) << d, edge[1], c;
      is_new[static_cast<std::size_t>(t)] = is_new[static_cast<std::size_t>(s)] = turned = true;
    }
  }
}

/// The unit square, 2 n² triangles; phase 1 where x > ½, and an edge never crosses that line.
inline meshes::TriangleMesh plate_mesh(const std::string &kind, const int n)
{
  meshes::TriangleMesh mesh = meshes::coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity() / n, n, n);
  const auto vertex         = [n](const int i, const int j) { return j * (n + 1) + i; };
  for (int j = 0, t = 0; j < n; ++j)
    for (int i = 0; i < n; ++i, t += 2)
    {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                d = vertex(i, j + 1);
      if (kind == "alternating" && (i + j) % 2 == 1)
      {
        mesh.triangles.row(t) << a, b, d;
        mesh.triangles.row(t + 1) << b, c, d;
      }
      else
      {
        mesh.triangles.row(t) << a, b, c;
        mesh.triangles.row(t + 1) << a, c, d;
      }
    }
  if (kind == "shaken" || kind == "Delaunay")
  {
    std::mt19937 generator(static_cast<unsigned int>(n));
    const double distance = 0.25 / n;
    std::uniform_real_distribution<double> random(-distance, distance);
    for (int j = 1; j < n; ++j)
      for (int i = 1; i < n; ++i)
        mesh.vertices.row(vertex(i, j)) +=
          Eigen::RowVector2d(2 * i == n ? 0. : random(generator), random(generator));
  }
  if (kind == "Delaunay")
    make_delaunay(mesh);
  mesh.material.resize(mesh.n_triangles());
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    double x = 0.;
    for (int k = 0; k < 3; ++k)
      x += mesh.vertices(mesh.triangles(t, k), 0) / 3.;
    mesh.material(t) = x > 0.5 ? 1 : 0;
  }
  return mesh;
}

inline meshes::ClothMesh lying(const meshes::TriangleMesh &rest)
{
  return meshes::placed_sheet(rest, Eigen::Matrix3d::Identity().leftCols<2>(),
                              Eigen::RowVector3d::Zero());
}

/// A deflection, what it is and how steep.
struct Deflection
{
  std::function<double(const Eigen::RowVector2d &)> value;
  std::function<Eigen::RowVector2d(const Eigen::RowVector2d &)> slope;
};

/// sin(π x) sin(π y), simply supported, or its square, clamped: deflection, curvature and load.
struct Bump
{
  bool is_clamped = false;

  /// Of one factor: itself and four derivatives.
  std::array<double, 5> factor(const double x) const
  {
    const double s = std::sin(M_PI * x), c = std::cos(M_PI * x), p = M_PI;
    if (!is_clamped)
      return {s, p * c, -p * p * s, -p * p * p * c, p * p * p * p * s};
    const double s2 = std::sin(2. * p * x), c2 = std::cos(2. * p * x);
    return {s * s, p * s2, 2. * p * p * c2, -4. * p * p * p * s2, -8. * p * p * p * p * c2};
  }
  Deflection deflection() const
  {
    return {[*this](const Eigen::RowVector2d &x) { return factor(x(0))[0] * factor(x(1))[0]; },
            [*this](const Eigen::RowVector2d &x)
            {
              return Eigen::RowVector2d(factor(x(0))[1] * factor(x(1))[0],
                                        factor(x(0))[0] * factor(x(1))[1]);
            }};
  }
  Eigen::Vector3d curvature(const Eigen::RowVector2d &x) const
  {
    const auto f = factor(x(0)), g = factor(x(1));
    return {f[2] * g[0], f[0] * g[2], 2. * f[1] * g[1]};
  }
  double load(const Eigen::RowVector2d &x, const shell::PlateStiffness &D) const
  {
    const auto f = factor(x(0)), g = factor(x(1));
    return D.D11 * f[4] * g[0] + D.D22 * f[0] * g[4] + 2. * (D.D12 + 2. * D.D66) * f[2] * g[2];
  }
};

/// Directed edges of the outline: from, to.
inline std::vector<std::array<int, 2>> outline_edges(const meshes::TriangleMesh &mesh)
{
  std::map<std::array<int, 2>, bool> sides;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      sides[{mesh.triangles(t, (k + 1) % 3), mesh.triangles(t, (k + 2) % 3)}] = true;
  std::vector<std::array<int, 2>> edges;
  for (const auto &[edge, unused] : sides)
    if (sides.count({edge[1], edge[0]}) == 0)
      edges.push_back(edge);
  return edges;
}

/// Slope of a deflection out of the sheet, at the middle of an edge of the outline.
inline double outward_slope(const meshes::TriangleMesh &mesh, const std::array<int, 2> &edge,
                            const Deflection &deflection)
{
  const Eigen::RowVector2d a = mesh.vertices.row(edge[0]), b = mesh.vertices.row(edge[1]),
                           along = (b - a).normalized();
  return deflection.slope(0.5 * (a + b)).dot(Eigen::RowVector2d(along(1), -along(0)));
}

/// Planes of the outline that make the given deflection's slopes the angles of clamps.
inline std::vector<shell::ClampedEdge> clamps_of(const meshes::TriangleMesh &mesh,
                                                 const Deflection &deflection)
{
  std::vector<shell::ClampedEdge> clamps;
  for (const auto &edge : outline_edges(mesh))
  {
    const Eigen::RowVector2d along =
      (mesh.vertices.row(edge[1]) - mesh.vertices.row(edge[0])).normalized();
    const double angle = outward_slope(mesh, edge, deflection);
    clamps.push_back({edge[0],
                      edge[1],
                      {-std::sin(angle) * along(1), std::sin(angle) * along(0), std::cos(angle)}});
  }
  return clamps;
}

/// Small deflections of a plate by a term's own matrix.
/// @param held deflections that are given
/// @param loads (n) [N]
/// @return (n) [m]
inline Eigen::VectorXd deflected(const meshes::TriangleMesh &mesh, shell::Term &term,
                                 const std::map<int, double> &held, const Eigen::VectorXd &loads)
{
  std::vector<bool> is_held(static_cast<std::size_t>(mesh.n_vertices()), false);
  shell::Vectors given = shell::Vectors::Zero(mesh.n_vertices(), 3);
  for (const auto &[v, value] : held)
  {
    is_held[static_cast<std::size_t>(v)] = true;
    given(v, 2)                          = value;
  }
  shell::BlockMatrix matrix    = matrix_for(term, mesh.n_vertices(), is_held);
  const meshes::ClothMesh flat = lying(mesh);
  shell::Vectors gradient      = shell::Vectors::Zero(mesh.n_vertices(), 3), result;
  term.add_derivatives(flat.positions, shell::Hessian::projected, gradient, matrix);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    matrix.add(matrix.slot(v, v), Eigen::Vector3d(1., 1., 0.).asDiagonal().toDenseMatrix());
  shell::Vectors right_side             = shell::Vectors::Zero(matrix.n_vertices(), 3);
  right_side.topRows(mesh.n_vertices()) = -gradient;
  right_side.col(2).head(mesh.n_vertices()) += loads;
  matrix.subtract_held(given, right_side);
  shell::BlockCholesky cholesky(matrix);
  if (!cholesky.factorize(matrix))
    throw std::runtime_error("the plate is loose");
  cholesky.solve(right_side, result);
  return result.col(2).head(mesh.n_vertices()) + given.col(2);
}

/// What may be wrong with the form.
enum class PlateFault
{
  none,
  sign_of_phi,
  half_of_outline,
  neighbours_stiffness
};

/// E(z, φ) = ½ Σ_t A κ·D·κ of small deflections z, φ at all edges those of the outline included,
/// from the gradients of z in the two triangles: a second writing, for independence only.
class AnglesPlate
{
public:
  AnglesPlate(const meshes::TriangleMesh &mesh, const std::vector<shell::PlateStiffness> &stiffness,
              const PlateFault fault = PlateFault::none)
      : mesh(mesh)
  {
    std::map<std::array<int, 2>, std::array<int, 2>> sides;
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        sides[{mesh.triangles(t, (k + 1) % 3), mesh.triangles(t, (k + 2) % 3)}] = {t, k};
    for (const auto &[edge, side] : sides)
      if (edges.count({edge[1], edge[0]}) == 0)
        edges.insert({edge, static_cast<int>(edges.size())});
    const int n = mesh.n_vertices();
    std::vector<Eigen::Triplet<double>> rows;
    for (int t = 0; t < mesh.n_triangles(); ++t)
    {
      int of_stiffness = t;
      for (int k = 0; k < 3; ++k)
      {
        const int a = mesh.triangles(t, (k + 1) % 3), b = mesh.triangles(t, (k + 2) % 3);
        const bool is_first = edges.count({a, b}) != 0;
        const int phi       = n + edges.at(is_first ? std::array{a, b} : std::array{b, a});
        const auto other    = sides.find({b, a});
        const Eigen::RowVector2d edge = mesh.vertices.row(b) - mesh.vertices.row(a);
        const Eigen::RowVector2d out(edge(1), -edge(0)); // times the length
        const Eigen::Vector3d kappa =
          Eigen::Vector3d(out(0) * out(0), out(1) * out(1), 2. * out(0) * out(1)) /
          (edge.norm() * area(t));
        const auto put = [&](const int column, const double value)
        {
          for (int i = 0; i < 3; ++i)
            rows.emplace_back(3 * t + i, column, value * kappa(i));
        };
        if (other == sides.end())
        {
          // φ is the slope of the plane beyond.
          put(phi, 1.);
          for (int v = 0; v < 3; ++v)
            put(mesh.triangles(t, v), (fault == PlateFault::half_of_outline ? -0.5 : -1.) *
                                        gradient(t, v).dot(out) / edge.norm());
          continue;
        }
        if (mesh.material(other->second[0]) != mesh.material(t))
          of_stiffness = other->second[0];
        put(phi, is_first || fault == PlateFault::sign_of_phi ? 1. : -1.);
        for (const auto &[triangle, sign] : {std::pair{t, -1.}, {other->second[0], 1.}})
          for (int v = 0; v < 3; ++v)
            put(mesh.triangles(triangle, v),
                0.5 * sign * gradient(triangle, v).dot(out) / edge.norm());
      }
      if (fault != PlateFault::neighbours_stiffness)
        of_stiffness = t;
      D.push_back(stiffness[static_cast<std::size_t>(mesh.material(of_stiffness))].matrix());
    }
    curvature.resize(3 * mesh.n_triangles(), n + static_cast<int>(edges.size()));
    curvature.setFromTriplets(rows.begin(), rows.end());
    std::vector<Eigen::Triplet<double>> weights;
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          weights.emplace_back(3 * t + i, 3 * t + j,
                               area(t) * D[static_cast<std::size_t>(t)](i, j));
    Eigen::SparseMatrix<double> weight(3 * mesh.n_triangles(), 3 * mesh.n_triangles());
    weight.setFromTriplets(weights.begin(), weights.end());
    hessian = curvature.transpose() * weight * curvature;
  }

  /// z and φ, some of which are given, at the minimum.
  Eigen::VectorXd minimum(const std::map<int, double> &given) const
  {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(hessian.rows());
    std::vector<int> place(static_cast<std::size_t>(hessian.rows()), -1);
    int n = 0;
    for (int i = 0; i < static_cast<int>(hessian.rows()); ++i)
      if (const auto its = given.find(i); its != given.end())
        all(i) = its->second;
      else
        place[static_cast<std::size_t>(i)] = n++;
    std::vector<Eigen::Triplet<double>> entries;
    for (int c = 0; c < hessian.outerSize(); ++c)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(hessian, c); entry; ++entry)
        if (const int i = place[static_cast<std::size_t>(entry.row())],
            j           = place[static_cast<std::size_t>(c)];
            i >= 0 && j >= 0)
          entries.emplace_back(i, j, entry.value());
    Eigen::SparseMatrix<double> free(n, n);
    free.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd residual = hessian * all;
    Eigen::VectorXd right_side(n);
    for (int i = 0; i < static_cast<int>(hessian.rows()); ++i)
      if (place[static_cast<std::size_t>(i)] >= 0)
        right_side(place[static_cast<std::size_t>(i)]) = -residual(i);
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(free);
    const Eigen::VectorXd result = solver.solve(right_side);
    for (int i = 0; i < static_cast<int>(hessian.rows()); ++i)
      if (place[static_cast<std::size_t>(i)] >= 0)
        all(i) = result(place[static_cast<std::size_t>(i)]);
    return all;
  }

  double energy(const Eigen::VectorXd &all) const
  {
    return 0.5 * all.dot(hessian * all);
  }

  /// Where φ of an edge of the outline is, in the order of its triangle.
  int unknown_of(const std::array<int, 2> &edge) const
  {
    return mesh.n_vertices() + edges.at(edge);
  }

  double area(const int t) const
  {
    const Eigen::RowVector2d a = mesh.vertices.row(mesh.triangles(t, 0));
    return 0.5 * meshes::cross(Eigen::RowVector2d(mesh.vertices.row(mesh.triangles(t, 1)) - a),
                               Eigen::RowVector2d(mesh.vertices.row(mesh.triangles(t, 2)) - a));
  }

  Eigen::SparseMatrix<double> curvature, hessian; ///< κ of (z, φ); second derivative of E
  std::vector<Eigen::Matrix3d> D;

private:
  /// Of the linear function that is 1 at corner v.
  Eigen::RowVector2d gradient(const int t, const int v) const
  {
    const Eigen::RowVector2d edge = mesh.vertices.row(mesh.triangles(t, (v + 2) % 3)) -
                                    mesh.vertices.row(mesh.triangles(t, (v + 1) % 3));
    return Eigen::RowVector2d(-edge(1), edge(0)) / (2. * area(t));
  }

  const meshes::TriangleMesh mesh;
  std::map<std::array<int, 2>, int> edges;
};
} // namespace homespun::tests
