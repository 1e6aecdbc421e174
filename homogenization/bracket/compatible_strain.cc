// SPDX-License-Identifier: MIT
#include "homogenization/bracket/compatible_strain.h"

#include "homogenization/algebra/refined_solution.h"
#include "homogenization/bracket/displacement_shapes.h"
#include "homogenization/bracket/loewner.h"
#include "meshes/plain/epsilon.h"
#include "meshes/plain/index.h"
#include "meshes/plain/triangle_kinematics.h"

#include <Eigen/LU>

#include <cmath>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
meshes::TriangleGeometry geometry_of(const std::array<Eigen::Vector2d, 3> &shape)
{
  Eigen::Matrix2d sides;
  sides << shape[1], shape[2];
  return meshes::triangle_geometry(sides);
}
} // namespace

CompatibleStrain::CompatibleStrain(const TorusMesh &mesh,
                                   const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                                   const unsigned order, const Holes holes)
    : mesh(mesh)
    , stiffnesses(stiffness_of_material)
    , order(order)
    , rims(holes == Holes::rigid ? std::optional<Rims>(rims_of(mesh)) : std::nullopt)
{
  order == 1 ? assemble_and_solve<3>() : assemble_and_solve<6>();
  evaluate();
}

int CompatibleStrain::first_unknown(const int triangle, const int shape) const
{
  const TorusTriangle &its = mesh.triangles[at(triangle)];
  return shape < 3 ? 2 * its.vertices[at(shape)] : 2 * (mesh.n_vertices + its.edges[at(shape - 3)]);
}

/// The row of an unknown: both displacements of the anchor have none, -1, unless rigid holes choose
/// the translation.
int CompatibleStrain::row_or_pinned(const int unknown) const
{
  const int pinned = 2 * mesh.anchor;
  if (has_rigid_holes() || unknown < pinned)
    return unknown;
  return unknown < pinned + 2 ? -1 : unknown - 2;
}

template <int n_shapes>
void CompatibleStrain::assemble_and_solve()
{
  const int n_unknowns = 2 * (mesh.n_vertices + (order == 2 ? mesh.n_edges() : 0));
  n_dofs               = static_cast<unsigned>(has_rigid_holes() ? n_unknowns : n_unknowns - 2);
  const auto row_of    = [this](const int unknown) { return row_or_pinned(unknown); };
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(n_shapes * (2 * n_shapes + 1)) * mesh.triangles.size());
  Eigen::MatrixXd loads        = Eigen::MatrixXd::Zero(n_dofs, 3);
  const Eigen::Vector3d thirds = Eigen::Vector3d::Constant(1. / 3.);
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const Eigen::Matrix3d &c      = stiffnesses[at(triangle.material)];
    const auto [area, gradients]  = geometry_of(triangle.shape(mesh.edges));
    Eigen::Matrix<double, 2 * n_shapes, 2 * n_shapes> matrix;
    Eigen::Matrix<double, 2 * n_shapes, 3> load;
    matrix.setZero();
    load.setZero();
    constexpr int n_points = n_shapes == 3 ? 1 : 3;
    for (int q = 0; q < n_points; ++q)
    {
      Eigen::Vector3d point = thirds;
      if (n_shapes == 6)
        point = Eigen::Vector3d::Constant(0.5) - 0.5 * Eigen::Vector3d::Unit(q);
      const auto B = strain_displacement<n_shapes>(gradients, point);
      const Eigen::Matrix<double, 2 * n_shapes, 3> stress_rows =
        area / n_points * B.transpose() * c;
      matrix.noalias() += stress_rows * B;
      load += stress_rows;
    }
    for (int i = 0; i < 2 * n_shapes; ++i)
    {
      const int row = row_of(first_unknown(t, i / 2) + i % 2);
      if (row < 0)
        continue;
      loads.row(row) += load.row(i);
      for (int j = 0; j < 2 * n_shapes; ++j)
      {
        const int column = row_of(first_unknown(t, j / 2) + j % 2);
        if (column >= 0 && column <= row)
          entries.emplace_back(row, column, matrix(i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(n_dofs, n_dofs);
  matrix.setFromTriplets(entries.begin(), entries.end());
  entries = {};
  unknowns.setZero(n_unknowns, 3);
  if (has_rigid_holes())
  {
    solve_with_rigid_holes(matrix, loads);
    return;
  }
  const RefinedSolution solution = refined_solution(matrix, loads, "cell problems");
  for (int unknown = 0; unknown < n_unknowns; ++unknown)
    if (row_of(unknown) >= 0)
      unknowns.row(unknown) = solution.values.row(row_of(unknown));
  excess     = solution.excess;
  iterations = solution.iterations;
}

/// On rims chi = e.y − a − b (−y2, y1), with y from the first vertex of the rim; a of the first
/// hole is zero in the place of chi at the anchor.
void CompatibleStrain::solve_with_rigid_holes(const Eigen::SparseMatrix<double> &matrix,
                                              const Eigen::MatrixXd &loads)
{
  const auto n_all = static_cast<int>(unknowns.rows());
  // Unknowns of holes stand in front: a1, a2, b, without a of the first one.
  int n_kept                  = 3 * rims->n_holes - 2;
  const auto row_of_hole      = [](const int hole, const int k) { return 3 * hole + k - 2; };
  Eigen::MatrixXd known       = Eigen::MatrixXd::Zero(n_all, 3);
  const double length         = std::sqrt(mesh.lattice.area()); // b in parts of a over this
  std::vector<char> is_on_rim = std::vector<char>(at(n_all), 0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int node = 0; 2 * node < n_all; ++node)
  {
    const RimPoint &rim      = node < mesh.n_vertices ? rims->of_vertex[at(node)]
                                                      : rims->of_edge[at(node - mesh.n_vertices)];
    const Eigen::Vector2d &y = rim.position;
    if (rim.hole < 0)
    {
      entries.emplace_back(2 * node, n_kept, 1.);
      entries.emplace_back(2 * node + 1, n_kept + 1, 1.);
      n_kept += 2;
      continue;
    }
    known.middleRows<2>(2 * node) << y(0), 0., 0.5 * y(1), 0., y(1), 0.5 * y(0);
    for (int c = 0; c < 2; ++c)
    {
      is_on_rim[at(2 * node + c)] = 1;
      if (rim.hole > 0)
        entries.emplace_back(2 * node + c, row_of_hole(rim.hole, c), -1.);
      entries.emplace_back(2 * node + c, row_of_hole(rim.hole, 2),
                           (c == 0 ? y(1) : -y(0)) / length);
    }
  }
  Eigen::SparseMatrix<double> basis(n_all, n_kept);
  basis.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> full    = matrix.selfadjointView<Eigen::Lower>();
  const Eigen::SparseMatrix<double> reduced = basis.transpose() * full * basis;
  const RefinedSolution solution =
    refined_solution(reduced.triangularView<Eigen::Lower>(),
                     basis.transpose() * (loads - full * known), "cell problems with rigid holes");
  unknowns   = known + basis * solution.values;
  n_dofs     = static_cast<unsigned>(n_kept);
  excess     = solution.excess;
  iterations = solution.iterations;
  // A rigid motion that is rounded is none any more: other displacements may have any values.
  roundings =
    4. * meshes::epsilon * (known.cwiseAbs() + basis.cwiseAbs() * solution.values.cwiseAbs());
  for (int k = 0; k < n_all; ++k)
    if (!is_on_rim[at(k)])
      roundings.row(k).setZero();
}

template <int n_shapes>
Eigen::Matrix<double, 2 * n_shapes, 3>
CompatibleStrain::displacements_from_first_vertex(const int t) const
{
  // Differences from vertex 0: the translation has no strain.
  Eigen::Matrix<double, 2 * n_shapes, 3> chi;
  for (int i = 0; i < n_shapes; ++i)
    chi.template middleRows<2>(2 * i) =
      unknowns.middleRows<2>(first_unknown(t, i)) - unknowns.middleRows<2>(first_unknown(t, 0));
  return chi;
}

template <int n_shapes>
Eigen::Matrix<double, 2 * n_shapes, 3> CompatibleStrain::roundings_of(const int t) const
{
  Eigen::Matrix<double, 2 * n_shapes, 3> bar = Eigen::Matrix<double, 2 * n_shapes, 3>::Zero();
  if (roundings.size() > 0)
    for (int i = 0; i < n_shapes; ++i)
      bar.template middleRows<2>(2 * i) = roundings.middleRows<2>(first_unknown(t, i));
  return bar;
}

template <int n_shapes>
FieldOfLoads CompatibleStrain::strain_of(const int t, FieldOfLoads *const bar) const
{
  const auto gradients = geometry_of(mesh.triangles[at(t)].shape(mesh.edges)).shape_gradients;
  const auto chi       = displacements_from_first_vertex<n_shapes>(t);
  FieldOfLoads field;
  for (int q = 0; q < n_field_points; ++q)
  {
    const auto B = strain_displacement<n_shapes>(gradients, field_points()[at(q)].in_triangle);
    field.middleRows<3>(3 * q) = Eigen::Matrix3d::Identity() - B * chi;
    if (bar)
      bar->middleRows<3>(3 * q) =
        B.cwiseAbs() * (12. * meshes::epsilon * chi.cwiseAbs() + roundings_of<n_shapes>(t));
  }
  return field;
}

FieldOfLoads CompatibleStrain::strain(const int triangle) const
{
  return order == 1 ? strain_of<3>(triangle, nullptr) : strain_of<6>(triangle, nullptr);
}

std::vector<FieldProducts> CompatibleStrain::products() const
{
  std::vector<FieldProducts> products(stiffnesses.size(), FieldProducts::Zero());
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const double weight =
      geometry_of(triangle.shape(mesh.edges)).area / (n_field_points * mesh.lattice.area());
    const FieldOfLoads field = strain(t);
    for (int q = 0; q < n_field_points; ++q)
      add_products(weight, field.middleRows<3>(3 * q), products[at(triangle.material)]);
  }
  return products;
}

Eigen::VectorXd CompatibleStrain::unbalanced_tractions(const Eigen::Matrix3d &weights) const
{
  return order == 1 ? unbalanced_tractions_of<3>(weights) : unbalanced_tractions_of<6>(weights);
}

template <int n_shapes>
Eigen::VectorXd CompatibleStrain::unbalanced_tractions_of(const Eigen::Matrix3d &weights) const
{
  // At two Gauss points of each edge, from its tail on: exact for products of linear tractions.
  const double gauss[2] = {0.5 - 0.5 / std::sqrt(3.), 0.5 + 0.5 / std::sqrt(3.)};
  struct OfEdge
  {
    Eigen::Matrix<double, 2, 3> jumps[2] = {Eigen::Matrix<double, 2, 3>::Zero(),
                                            Eigen::Matrix<double, 2, 3>::Zero()};
    Eigen::Matrix2d stiffness            = Eigen::Matrix2d::Zero();
  };
  std::vector<OfEdge> of_edge(mesh.edges.size());
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const Eigen::Matrix3d &c      = stiffnesses[at(triangle.material)];
    const auto gradients          = geometry_of(triangle.shape(mesh.edges)).shape_gradients;
    const auto chi                = displacements_from_first_vertex<n_shapes>(t);
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector2d &edge = mesh.edges[at(triangle.edges[at(k)])].vector;
      const Eigen::Vector2d along = edge / edge.norm();
      Eigen::Matrix<double, 2, 3> normal; // of the edge, acting on stresses in Voigt order
      normal << along(1), 0., -along(0), 0., -along(0), along(1);
      OfEdge &its = of_edge[at(triangle.edges[at(k)])];
      its.stiffness += normal * c * normal.transpose();
      for (int g = 0; g < 2; ++g)
      {
        const double part = triangle.signs[at(k)] > 0. ? gauss[g] : 1. - gauss[g];
        const Eigen::Vector3d point =
          (1. - part) * Eigen::Vector3d::Unit(k) + part * Eigen::Vector3d::Unit((k + 1) % 3);
        const Eigen::Matrix3d strain =
          Eigen::Matrix3d::Identity() - strain_displacement<n_shapes>(gradients, point) * chi;
        its.jumps[g] += triangle.signs[at(k)] * normal * c * strain;
      }
    }
  }
  std::vector<double> on_edge(mesh.edges.size());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
  {
    if (rims && rims->of_edge[e].hole >= 0)
      continue; // a rigid hole holds any traction
    const Eigen::Matrix2d inverse = of_edge[e].stiffness.inverse();
    for (const auto &jump : of_edge[e].jumps)
      on_edge[e] += 0.5 * mesh.edges[e].vector.squaredNorm() *
                    (jump.transpose() * inverse * jump).cwiseProduct(weights).sum();
  }
  Eigen::VectorXd of_triangle = Eigen::VectorXd::Zero(mesh.n_triangles());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (const int edge : mesh.triangles[at(t)].edges)
      of_triangle(t) += 0.5 * on_edge[at(edge)];
  return of_triangle;
}

void CompatibleStrain::evaluate()
{
  using Sum  = Eigen::Matrix<long double, 3, 3>;
  Sum energy = Sum::Zero(), flux = Sum::Zero();
  // Of each product of two loads, and not of their energies alone: where one is stiff and the other
  // soft, what the soft field lacks in the stiff phase is nothing to its energy and much to theirs.
  Eigen::Matrix3d bars = Eigen::Matrix3d::Zero();
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const Eigen::Matrix3d &c      = stiffnesses[at(triangle.material)];
    const double weight           = geometry_of(triangle.shape(mesh.edges)).area / n_field_points;
    FieldOfLoads bar;
    const FieldOfLoads field = order == 1 ? strain_of<3>(t, &bar) : strain_of<6>(t, &bar);
    for (int q = 0; q < n_field_points; ++q)
    {
      const Eigen::Matrix3d strain = field.middleRows<3>(3 * q);
      const Eigen::Matrix3d stress = weight * c * strain;
      energy += (strain.transpose() * stress).cast<long double>();
      flux += stress.cast<long double>();
      const Eigen::Matrix3d wrong = bar.middleRows<3>(3 * q) + meshes::epsilon * strain.cwiseAbs();
      bars += weight * (strain.cwiseAbs().transpose() * c.cwiseAbs() * wrong);
    }
  }
  const auto averaged = [this](const Sum &sum) -> Eigen::Matrix3d
  { return (sum / static_cast<long double>(mesh.lattice.area())).cast<double>(); };
  const Eigen::Matrix3d unsymmetric = averaged(energy);
  stiffness                         = 0.5 * (unsymmetric + unsymmetric.transpose());
  stiffness_by_flux                 = averaged(flux);
  round_off = relative_error(bars + bars.transpose(), mesh.lattice.area() * stiffness);
}

meshes::Chi CompatibleStrain::chi_at_given_vertices() const
{
  const auto n = static_cast<Eigen::Index>(mesh.vertex_of_original.size());
  meshes::Chi chi(n, 6);
  for (Eigen::Index v = 0; v < n; ++v)
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 2; ++c)
        chi(v, 2 * a + c) =
          unknowns(2 * mesh.vertex_of_original[static_cast<std::size_t>(v)] + c, a);
  return chi;
}
} // namespace homespun::homogenization
