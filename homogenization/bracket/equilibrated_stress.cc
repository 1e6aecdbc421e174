// SPDX-License-Identifier: MIT
#include "homogenization/bracket/equilibrated_stress.h"

#include "homogenization/algebra/refined_solution.h"
#include "homogenization/bracket/loewner.h"
#include "meshes/plain/epsilon.h"
#include "meshes/plain/index.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace homespun::homogenization
{
using meshes::at;

const std::array<PiecePoint, n_field_points> &field_points()
{
  static const std::array<PiecePoint, n_field_points> points = []()
  {
    std::array<PiecePoint, n_field_points> all;
    const Eigen::Vector3d middles[3] = {{0.5, 0.5, 0.}, {0., 0.5, 0.5}, {0.5, 0., 0.5}};
    for (int piece = 0; piece < 3; ++piece)
      for (int m = 0; m < 3; ++m)
      {
        PiecePoint &point = all[at(3 * piece + m)];
        point.piece       = piece;
        point.in_piece    = middles[m];
        point.in_triangle.setConstant(middles[m](2) / 3.);
        point.in_triangle(piece) += middles[m](0);
        point.in_triangle((piece + 1) % 3) += middles[m](1);
      }
    return all;
  }();
  return points;
}

double area_of(const std::array<Eigen::Vector2d, 3> &shape)
{
  return 0.5 * (shape[1](0) * shape[2](1) - shape[1](1) * shape[2](0));
}

/// They are linear in each piece: from its corners to the middles of its sides.
std::array<Eigen::Matrix<double, 3, 12>, n_field_points>
second_derivatives_at_field_points(const CloughTocher &element)
{
  std::array<Eigen::Matrix<double, 3, 12>, n_field_points> second;
  for (int piece = 0; piece < 3; ++piece)
  {
    const auto at_corners = element.second_derivatives_at_corners(piece);
    for (int m = 0; m < 3; ++m)
    {
      const int q                  = 3 * piece + m;
      const Eigen::Vector3d &point = field_points()[at(q)].in_piece;
      second[at(q)]                = point(0) * at_corners[0];
      second[at(q)] += point(1) * at_corners[1];
      second[at(q)] += point(2) * at_corners[2];
    }
  }
  return second;
}

Eigen::Matrix<double, 3, 12> stress_of_airy(const CloughTocher &element, const int piece,
                                            const Eigen::Vector3d &barycentric)
{
  const auto second = element.second_derivatives(piece, barycentric);
  Eigen::Matrix<double, 3, 12> stress;
  stress << second.row(1), second.row(0), -second.row(2);
  return stress;
}

Compliances::Compliances(const std::vector<Eigen::Matrix3d> &stiffnesses)
{
  for (const Eigen::Matrix3d &c : stiffnesses)
  {
    const Eigen::Matrix3d s = c.cast<long double>().inverse().cast<double>();
    inverses.push_back(0.5 * (s + s.transpose()));
    error = std::max(error, (c.cast<long double>() * inverses.back().cast<long double>() -
                             Eigen::Matrix<long double, 3, 3>::Identity())
                              .cast<double>()
                              .cwiseAbs()
                              .rowwise()
                              .sum()
                              .maxCoeff());
  }
}

EquilibratedStress::EquilibratedStress(const TorusMesh &mesh,
                                       const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                                       std::vector<char> flat, const Holes holes,
                                       const NormalDerivatives normal_derivatives)
    : mesh(mesh)
    , holes(holes)
    , normal_derivatives(normal_derivatives)
    , numbering(mesh, holes, normal_derivatives)
    , compliances(stiffness_of_material)
    , flat(std::move(flat))
{
  if (normal_derivatives == NormalDerivatives::linear && !this->flat.empty())
    throw std::logic_error("flat triangles need quadratic normal derivatives");
  n_dofs = static_cast<unsigned>(numbering.number - 1);
  unknowns.setZero(numbering.number, 3);
  assemble_and_solve();
  evaluate();
}

CloughTocher EquilibratedStress::element(const int t) const
{
  const TorusTriangle &triangle = mesh.triangles[at(t)];
  std::array<Eigen::Vector2d, 3> normals;
  for (int k = 0; k < 3; ++k)
    normals[at(k)] = edge_normal(mesh.edges[at(triangle.edges[at(k)])]);
  return {triangle.shape(mesh.edges), normals};
}

EquilibratedStress::StressRows EquilibratedStress::stress_rows(const int t) const
{
  const auto second = second_derivatives_at_field_points(element(t));
  StressRows rows;
  for (int q = 0; q < n_field_points; ++q)
  {
    rows.row(3 * q)     = second[at(q)].row(1);
    rows.row(3 * q + 1) = second[at(q)].row(0);
    rows.row(3 * q + 2) = -second[at(q)].row(2);
  }
  return rows;
}

/// Half the normal of a side, which makes the derivative in its middle from the gradients at its
/// ends where it is linear between them.
Eigen::RowVector2d EquilibratedStress::half_normal(const int t, const int side) const
{
  return 0.5 * edge_normal(mesh.edges[at(mesh.triangles[at(t)].edges[at(side)])]).transpose();
}

/// stress_rows() of what has unknowns: linear normal derivatives are put in terms of the gradients.
EquilibratedStress::StressRows EquilibratedStress::rows_of_unknowns(const int t) const
{
  StressRows rows = stress_rows(t);
  if (normal_derivatives == NormalDerivatives::linear)
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Matrix<double, 3 * n_field_points, 1> of_middle = rows.col(9 + k);
      for (const int corner : {k, (k + 1) % 3})
        rows.middleCols<2>(3 * corner + 1) += of_middle * half_normal(t, k);
      rows.col(9 + k).setZero();
    }
  return rows;
}

void EquilibratedStress::assemble_and_solve()
{
  const int n = static_cast<int>(n_dofs);
  // Unknowns behind the pinned one move up by one place.
  const auto row_of = [this](const int unknown) { return unknown - (unknown > numbering.pinned); };
  // Those of flat triangles are in other unknowns.
  std::vector<Eigen::Triplet<double>> entries, entries_of_flat;
  entries.reserve(80 * mesh.triangles.size());
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(n, 3), loads_of_flat = loads;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const Eigen::Matrix3d &s      = compliances[at(triangle.material)];
    StressRows B                  = rows_of_unknowns(t);
    AiryDofs dofs                 = numbering.of_triangle(t);
    if (is_flat(t))
      change_basis(t, B, dofs);
    const double weight = area_of(triangle.shape(mesh.edges)) / n_field_points;
    StressRows sB;
    for (int q = 0; q < n_field_points; ++q)
      sB.middleRows<3>(3 * q).noalias() = weight * s * B.middleRows<3>(3 * q);
    const Eigen::Matrix<double, 12, 12> matrix = B.transpose() * sB;
    LocalValues load                           = LocalValues::Zero();
    for (int q = 0; q < n_field_points; ++q)
      load -= sB.middleRows<3>(3 * q).transpose();

    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
        if (!dofs[at(j)].known.isZero(0.))
          load.row(i) -= matrix(i, j) * dofs[at(j)].known;
    for (int i = 0; i < 12; ++i)
      for (int a = 0; a < 3; ++a)
      {
        const int row = dofs[at(i)].unknowns[at(a)];
        if (row < 0)
          continue;
        const double factor = dofs[at(i)].factors[at(a)];
        (is_flat(t) ? loads_of_flat : loads).row(row_of(row)) += factor * load.row(i);
        for (int j = 0; j < 12; ++j)
          for (int b = 0; b < 3; ++b)
          {
            const int column = dofs[at(j)].unknowns[at(b)];
            if (column >= 0 && column <= row)
              (is_flat(t) ? entries_of_flat : entries)
                .emplace_back(row_of(row), row_of(column),
                              factor * matrix(i, j) * dofs[at(j)].factors[at(b)]);
          }
      }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  entries = {};
  Eigen::SparseMatrix<double> basis;
  if (!flat.empty())
  {
    basis                                  = basis_of_flat_triangles();
    const Eigen::SparseMatrix<double> full = matrix.selfadjointView<Eigen::Lower>();
    Eigen::SparseMatrix<double> of_flat(n, n);
    of_flat.setFromTriplets(entries_of_flat.begin(), entries_of_flat.end());
    const Eigen::SparseMatrix<double> changed = basis.transpose() * full * basis;
    matrix = Eigen::SparseMatrix<double>(changed.triangularView<Eigen::Lower>()) + of_flat;
    loads  = loads_of_flat + basis.transpose() * loads;
  }
  RefinedSolution solution = refined_solution(matrix, loads, "complementary energy");
  if (!flat.empty())
    solution.values = basis * solution.values;
  for (int unknown = 0; unknown <= n; ++unknown)
    if (unknown != numbering.pinned)
      unknowns.row(unknown) = solution.values.row(row_of(unknown));
  excess     = solution.excess;
  iterations = solution.iterations;
}

EquilibratedStress::LocalValues EquilibratedStress::local_values(const int t) const
{
  const AiryDofs dofs = numbering.of_triangle(t);
  LocalValues values;
  for (int i = 0; i < 12; ++i)
  {
    values.row(i) = dofs[at(i)].known;
    for (int a = 0; a < 3; ++a)
      if (dofs[at(i)].unknowns[at(a)] >= 0)
        values.row(i) += dofs[at(i)].factors[at(a)] * unknowns.row(dofs[at(i)].unknowns[at(a)]);
  }
  // The affine part has no stress: without it the second differences keep their digits.
  const TorusTriangle &triangle              = mesh.triangles[at(t)];
  const auto shape                           = triangle.shape(mesh.edges);
  const Eigen::RowVector3d value             = values.row(0);
  const Eigen::Matrix<double, 2, 3> gradient = values.middleRows<2>(1);
  for (int k = 0; k < 3; ++k)
  {
    values.row(3 * k) -= value + shape[at(k)].transpose() * gradient;
    values.middleRows<2>(3 * k + 1) -= gradient;
    values.row(9 + k) -= edge_normal(mesh.edges[at(triangle.edges[at(k)])]).transpose() * gradient;
  }
  if (normal_derivatives == NormalDerivatives::linear)
    for (int k = 0; k < 3; ++k)
      values.row(9 + k) = half_normal(t, k) * (values.middleRows<2>(3 * k + 1) +
                                               values.middleRows<2>(3 * ((k + 1) % 3) + 1));
  return values;
}

FieldOfLoads EquilibratedStress::stress(const int triangle) const
{
  FieldOfLoads field = stress_rows(triangle) * local_values(triangle);
  for (int q = 0; q < n_field_points; ++q)
    field.middleRows<3>(3 * q) += Eigen::Matrix3d::Identity();
  return field;
}

Eigen::VectorXd EquilibratedStress::incompatible_strains(const Eigen::Matrix3d &weights) const
{
  // At two Gauss points of each edge, from its tail on: exact for products of linear strains.
  const double gauss[2] = {0.5 - 0.5 / std::sqrt(3.), 0.5 + 0.5 / std::sqrt(3.)};
  struct OfEdge
  {
    Eigen::RowVector3d jumps[2] = {Eigen::RowVector3d::Zero(), Eigen::RowVector3d::Zero()};
    double compliance           = 0.;
    int n_sides                 = 0;
  };
  const auto stretch_along = [](const Eigen::Vector2d &along) -> Eigen::RowVector3d {
    return {along(0) * along(0), along(1) * along(1), along(0) * along(1)};
  };
  const auto jump_energy = [&](const Eigen::RowVector3d &jump)
  { return (jump.transpose() * jump).cwiseProduct(weights).sum(); };
  std::vector<OfEdge> of_edge(mesh.edges.size());
  Eigen::VectorXd of_triangle = Eigen::VectorXd::Zero(mesh.n_triangles());
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const Eigen::Matrix3d &s      = compliances[at(triangle.material)];
    const auto shape              = triangle.shape(mesh.edges);
    const CloughTocher its        = element(t);
    const LocalValues values      = local_values(t);
    const auto strain = [&](const int piece, const Eigen::Vector3d &point) -> Eigen::Matrix3d
    { return s * (stress_of_airy(its, piece, point) * values + Eigen::Matrix3d::Identity()); };
    const Eigen::Vector2d centroid = (shape[0] + shape[1] + shape[2]) / 3.;
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector2d edge       = mesh.edges[at(triangle.edges[at(k)])].vector;
      const Eigen::RowVector3d stretch = stretch_along(edge / edge.norm());
      OfEdge &its_edge                 = of_edge[at(triangle.edges[at(k)])];
      its_edge.compliance += stretch * s * stretch.transpose();
      ++its_edge.n_sides;
      const Eigen::Vector2d spoke            = centroid - shape[at(k)];
      const Eigen::RowVector3d spoke_stretch = stretch_along(spoke / spoke.norm());
      const double spoke_compliance = 2. * (spoke_stretch * s * spoke_stretch.transpose()).value();
      for (const double from_tail : gauss)
      {
        const double part = triangle.signs[at(k)] > 0. ? from_tail : 1. - from_tail;
        its_edge.jumps[from_tail > 0.5] +=
          triangle.signs[at(k)] * stretch * strain(k, {1. - part, part, 0.});
        const Eigen::RowVector3d jump =
          spoke_stretch * (strain(k, {1. - from_tail, 0., from_tail}) -
                           strain((k + 2) % 3, {0., 1. - from_tail, from_tail}));
        of_triangle(t) += 0.5 * spoke.squaredNorm() * jump_energy(jump) / spoke_compliance;
      }
    }
  }
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (const int e : mesh.triangles[at(t)].edges)
      // On the rim of an empty hole the strain is free, on that of a rigid one it is zero.
      if (of_edge[at(e)].n_sides == 2 || holes == Holes::rigid)
        for (const Eigen::RowVector3d &jump : of_edge[at(e)].jumps)
          of_triangle(t) += 0.25 * mesh.edges[at(e)].vector.squaredNorm() * jump_energy(jump) /
                            of_edge[at(e)].compliance;
  return of_triangle;
}

Eigen::Matrix<double, Eigen::Dynamic, 3>
EquilibratedStress::stress_function_at_given_vertices() const
{
  const auto n = static_cast<Eigen::Index>(mesh.vertex_of_original.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> phi(n, 3);
  for (Eigen::Index v = 0; v < n; ++v)
  {
    const AiryDof dof = numbering.value_at(mesh.vertex_of_original[static_cast<std::size_t>(v)]);
    phi.row(v)        = dof.known;
    for (int a = 0; a < 3; ++a)
      if (dof.unknowns[at(a)] >= 0)
        phi.row(v) += dof.factors[at(a)] * unknowns.row(dof.unknowns[at(a)]);
  }
  return phi;
}

void EquilibratedStress::evaluate()
{
  using Sum            = Eigen::Matrix<long double, 3, 3>;
  Sum energy           = Sum::Zero();
  Eigen::Matrix3d bars = Eigen::Matrix3d::Zero(); // of each product, as for compatible strains
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const Eigen::Matrix3d &s      = compliances[at(triangle.material)];
    const auto shape              = triangle.shape(mesh.edges);
    const double weight           = area_of(shape) / n_field_points;
    const StressRows B            = stress_rows(t);
    const LocalValues values      = local_values(t);
    FieldOfLoads field            = B * values;
    // How wrong each may be: products of the rounded values, and the values from their differences.
    LocalValues bar                     = 12. * meshes::epsilon * values.cwiseAbs();
    const AiryDofs dofs                 = numbering.of_triangle(t);
    Eigen::RowVector3d size_of_gradient = Eigen::RowVector3d::Zero();
    for (int d = 1; d < 3; ++d)
      for (int a = 0; a < 3; ++a)
        if (dofs[at(d)].unknowns[at(a)] >= 0)
          size_of_gradient += unknowns.row(dofs[at(d)].unknowns[at(a)]).cwiseAbs();
    for (int k = 0; k < 3; ++k)
    {
      bar.row(3 * k) += 2. * meshes::epsilon * shape[at(k)].norm() * size_of_gradient;
      bar.row(9 + k) += 2. * meshes::epsilon * size_of_gradient;
      if (normal_derivatives == NormalDerivatives::linear) // whose sum of two may cancel
        bar.row(9 + k) += 4. * meshes::epsilon * half_normal(t, k).cwiseAbs() *
                          (values.middleRows<2>(3 * k + 1).cwiseAbs() +
                           values.middleRows<2>(3 * ((k + 1) % 3) + 1).cwiseAbs());
    }
    const FieldOfLoads field_bar = B.cwiseAbs() * bar;
    for (int q = 0; q < n_field_points; ++q)
    {
      const Eigen::Matrix3d sigma = field.middleRows<3>(3 * q) + Eigen::Matrix3d::Identity();
      energy += (weight * (sigma.transpose() * s * sigma)).cast<long double>();
      const Eigen::Matrix3d wrong =
        field_bar.middleRows<3>(3 * q) + meshes::epsilon * sigma.cwiseAbs();
      bars += weight * (sigma.cwiseAbs().transpose() * s.cwiseAbs() * wrong);
    }
  }
  const Eigen::Matrix3d unsymmetric =
    (energy / static_cast<long double>(mesh.lattice.area())).cast<double>();
  compliance = 0.5 * (unsymmetric + unsymmetric.transpose());
  round_off =
    relative_error(bars + bars.transpose(), mesh.lattice.area() * compliance) + compliances.error;
}
} // namespace homespun::homogenization
