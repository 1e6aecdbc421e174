// SPDX-License-Identifier: MIT
#include "verification/reference/equilibrated_sheet.h"

#include "homogenization/algebra/refined_solution.h"
#include "meshes/plain/epsilon.h"
#include "meshes/plain/index.h"
#include "verification/reference/displacement_energy.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace homespun::verification
{
using homogenization::AiryDof;
using homogenization::AiryDofs;
using homogenization::area_of;
using homogenization::CloughTocher;
using homogenization::field_points;
using homogenization::n_field_points;
using homogenization::stress_of_airy;
using meshes::at;

EquilibratedSheet::EquilibratedSheet(const meshes::Sheet &sheet,
                                     const std::vector<Eigen::Matrix3d> &stiffness_of_phase,
                                     const Load &load, const double strain)
    : sheet(sheet)
    , affine(affine_strain(sheet, load, strain))
    , compliances(stiffness_of_phase)
{
  find_edges(load);
  number_unknowns();
  assemble_and_solve();
  evaluate();
}

void EquilibratedSheet::find_edges(const Load &load)
{
  std::map<std::array<int, 2>, int> edge_between;
  edges_of_triangle.resize(at(sheet.mesh.n_triangles()));
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const auto [tail, head] =
        std::minmax({sheet.mesh.triangles(t, k), sheet.mesh.triangles(t, (k + 1) % 3)});
      const auto [place, is_new] =
        edge_between.emplace(std::array<int, 2>{tail, head}, static_cast<int>(edges.size()));
      if (is_new)
        edges.push_back({tail, head});
      edges_of_triangle[at(t)][at(k)] = place->second;
    }

  std::vector<int> parent(at(sheet.mesh.n_vertices()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v)
  {
    while (parent[at(v)] != v)
      v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
  };
  const auto is_held = [&](const Eigen::RowVector2d &point)
  { return load.holds(sheet.fraction(point)); };
  std::vector<int> free_edges;
  for (const auto &[from, to] : meshes::boundary_edges(sheet.mesh))
  {
    const Eigen::RowVector2d ends[2] = {sheet.mesh.vertices.row(from), sheet.mesh.vertices.row(to)};
    // The middle too: a free edge may lead from one clamped edge straight to the other.
    if (is_held(ends[0]) && is_held(ends[1]) && is_held(0.5 * (ends[0] + ends[1])))
      continue;
    free_edges.push_back(edge_between.at({std::min(from, to), std::max(from, to)}));
    parent[at(root(from))] = root(to);
  }
  chain_of_vertex.assign(at(sheet.mesh.n_vertices()), -1);
  std::vector<int> chain_of_root(at(sheet.mesh.n_vertices()), -1);
  for (const int e : free_edges)
  {
    int &chain = chain_of_root[at(root(edges[at(e)].tail))];
    if (chain < 0)
    {
      chain = static_cast<int>(origin_of_chain.size());
      origin_of_chain.push_back(at_vertex(edges[at(e)].tail));
    }
    edges[at(e)].chain                       = chain_of_vertex[at(edges[at(e)].tail)] =
      chain_of_vertex[at(edges[at(e)].head)] = chain;
  }
}

void EquilibratedSheet::number_unknowns()
{
  int n = 0;
  first_of_vertex.assign(at(sheet.mesh.n_vertices()), -1);
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
    if (chain_of_vertex[at(v)] < 0)
    {
      first_of_vertex[at(v)] = n;
      n += 3;
    }
  for (Edge &edge : edges)
    if (edge.chain < 0)
      edge.unknown = n++;
  first_of_chain.assign(origin_of_chain.size(), -1);
  for (std::size_t chain = 1; chain < origin_of_chain.size(); ++chain)
  {
    first_of_chain[chain] = n;
    n += 3;
  }
  n_dofs = static_cast<unsigned>(n);
  unknowns.setZero(n);
}

/// Written out for the reason that edge_normal() of a torus gives.
Eigen::Vector2d EquilibratedSheet::normal(const Edge &edge) const
{
  const Eigen::Vector2d along = at_vertex(edge.head) - at_vertex(edge.tail);
  const double length         = along.norm();
  return {along(1) / length, -along(0) / length};
}

/// phi = A + B . (point − origin) on a chain, of which the row takes a combination of value, d/dx
/// and d/dy.
AiryDof EquilibratedSheet::on_chain(const int chain, const Eigen::Vector2d &point,
                                    const Eigen::RowVector3d &of_value_and_gradient) const
{
  AiryDof dof;
  const int first = first_of_chain[at(chain)];
  if (first < 0)
    return dof;
  const Eigen::Vector2d x = point - origin_of_chain[at(chain)];
  dof.unknowns            = {first, first + 1, first + 2};
  dof.factors             = {of_value_and_gradient(0),
                             of_value_and_gradient(0) * x(0) + of_value_and_gradient(1),
                             of_value_and_gradient(0) * x(1) + of_value_and_gradient(2)};
  return dof;
}

AiryDofs EquilibratedSheet::dofs_of(const int t) const
{
  AiryDofs dofs;
  const auto single = [](const int unknown)
  {
    AiryDof dof;
    dof.unknowns[0] = unknown;
    dof.factors[0]  = 1.;
    return dof;
  };
  for (int k = 0; k < 3; ++k)
  {
    const int v = sheet.mesh.triangles(t, k);
    for (int d = 0; d < 3; ++d)
      dofs[at(3 * k + d)] =
        chain_of_vertex[at(v)] < 0
          ? single(first_of_vertex[at(v)] + d)
          : on_chain(chain_of_vertex[at(v)], at_vertex(v), Eigen::RowVector3d::Unit(d));
    const Edge &edge = edges[at(edges_of_triangle[at(t)][at(k)])];
    if (edge.chain < 0)
      dofs[at(9 + k)] = single(edge.unknown);
    else
    {
      const Eigen::Vector2d n = normal(edge);
      dofs[at(9 + k)]         = on_chain(edge.chain, at_vertex(edge.tail), {0., n(0), n(1)});
    }
  }
  return dofs;
}

/// The corners, seen from the first.
std::array<Eigen::Vector2d, 3> EquilibratedSheet::shape_of(const int t) const
{
  std::array<Eigen::Vector2d, 3> shape;
  for (int k = 0; k < 3; ++k)
    shape[at(k)] = at_vertex(sheet.mesh.triangles(t, k)) - at_vertex(sheet.mesh.triangles(t, 0));
  return shape;
}

CloughTocher EquilibratedSheet::element(const int t) const
{
  std::array<Eigen::Vector2d, 3> normals;
  for (int k = 0; k < 3; ++k)
    normals[at(k)] = normal(edges[at(edges_of_triangle[at(t)][at(k)])]);
  return {shape_of(t), normals};
}

void EquilibratedSheet::assemble_and_solve()
{
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(80 * at(sheet.mesh.n_triangles()));
  Eigen::VectorXd load = Eigen::VectorXd::Zero(n_dofs);
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t)
  {
    const CloughTocher its               = element(t);
    const Eigen::Matrix3d &S             = compliances[at(sheet.mesh.material(t))];
    const double weight                  = area_of(shape_of(t)) / n_field_points;
    Eigen::Matrix<double, 12, 12> matrix = Eigen::Matrix<double, 12, 12>::Zero();
    LocalValues local                    = LocalValues::Zero();
    for (const homogenization::PiecePoint &point : field_points())
    {
      const auto B = stress_of_airy(its, point.piece, point.in_piece);
      matrix.noalias() += weight * B.transpose() * S * B;
      local += weight * B.transpose() * affine;
    }
    const AiryDofs dofs = dofs_of(t);
    for (int i = 0; i < 12; ++i)
      for (int a = 0; a < 3; ++a)
      {
        const int row = dofs[at(i)].unknowns[at(a)];
        if (row < 0)
          continue;
        const double factor = dofs[at(i)].factors[at(a)];
        load(row) += factor * local(i);
        for (int j = 0; j < 12; ++j)
          for (int b = 0; b < 3; ++b)
          {
            const int column = dofs[at(j)].unknowns[at(b)];
            if (column >= 0 && column <= row)
              entries.emplace_back(row, column, factor * matrix(i, j) * dofs[at(j)].factors[at(b)]);
          }
      }
  }
  Eigen::SparseMatrix<double> matrix(n_dofs, n_dofs);
  matrix.setFromTriplets(entries.begin(), entries.end());
  unknowns =
    homogenization::refined_solution(matrix, load, "complementary energy of the sheet").values;
}

/// The degrees of freedom of a triangle without their affine part, which has no stress: second
/// differences keep their digits.
/// @param rounded how wrong each may be
EquilibratedSheet::LocalValues EquilibratedSheet::local_values(const int t,
                                                               LocalValues &rounded) const
{
  const AiryDofs dofs = dofs_of(t);
  LocalValues values, sizes;
  for (int i = 0; i < 12; ++i)
  {
    values(i) = sizes(i) = 0.;
    for (int a = 0; a < 3; ++a)
      if (dofs[at(i)].unknowns[at(a)] >= 0)
      {
        const double term = dofs[at(i)].factors[at(a)] * unknowns(dofs[at(i)].unknowns[at(a)]);
        values(i) += term;
        sizes(i) += std::abs(term);
      }
  }
  const auto shape               = shape_of(t);
  const double value             = values(0);
  const Eigen::Vector2d gradient = values.segment<2>(1);
  const double size = sizes(0), size_of_gradient = sizes.segment<2>(1).sum();
  for (int k = 0; k < 3; ++k)
  {
    values(3 * k) -= value + shape[at(k)].dot(gradient);
    values.segment<2>(3 * k + 1) -= gradient;
    values(9 + k) -= normal(edges[at(edges_of_triangle[at(t)][at(k)])]).dot(gradient);
    sizes(3 * k) += size + shape[at(k)].lpNorm<1>() * size_of_gradient;
    sizes(3 * k + 1) += size_of_gradient;
    sizes(3 * k + 2) += size_of_gradient;
    sizes(9 + k) += size_of_gradient;
  }
  rounded = 4. * meshes::epsilon * sizes + 12. * meshes::epsilon * values.cwiseAbs();
  return values;
}

Eigen::Vector3d EquilibratedSheet::stress(const int triangle, const int piece,
                                          const Eigen::Vector3d &barycentric) const
{
  LocalValues rounded;
  return stress_of_airy(element(triangle), piece, barycentric) * local_values(triangle, rounded);
}

void EquilibratedSheet::evaluate()
{
  long double sum_of_work = 0., complementary = 0.;
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t)
  {
    const CloughTocher its   = element(t);
    const Eigen::Matrix3d &S = compliances[at(sheet.mesh.material(t))];
    const double weight      = area_of(shape_of(t)) / n_field_points;
    LocalValues rounded;
    const LocalValues values = local_values(t, rounded);
    for (const homogenization::PiecePoint &point : field_points())
    {
      const auto B                = stress_of_airy(its, point.piece, point.in_piece);
      const Eigen::Vector3d sigma = B * values, eps = S * sigma;
      const Eigen::Vector3d wrong = B.cwiseAbs() * rounded + meshes::epsilon * sigma.cwiseAbs();
      sum_of_work += weight * sigma.dot(affine);
      complementary += 0.5 * weight * sigma.dot(eps);
      round_off += weight * ((affine - eps).cwiseAbs().dot(wrong) +
                             4. * meshes::epsilon * sigma.cwiseAbs().dot(affine.cwiseAbs()));
    }
  }
  work   = static_cast<double>(sum_of_work);
  energy = static_cast<double>(sum_of_work - complementary);
  round_off += compliances.error * static_cast<double>(complementary);
}
} // namespace homespun::verification
