// SPDX-License-Identifier: MIT
// Stress functions on triangles that are much flatter than their neighbours, such as those between
// a chord and its arc: unknowns in which the system of the complementary energy keeps its
// condition.
#include "homogenization/bracket/equilibrated_stress.h"

#include "meshes/plain/index.h"

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// Degrees of freedom of a flat triangle: at both ends of the long side and in its middle; at the
/// vertex near it and on the other sides.
constexpr std::array<int, 7> long_side = {0, 1, 2, 3, 4, 5, 9};
constexpr std::array<int, 5> near_side = {6, 7, 8, 10, 11};

} // namespace

/// On a flat triangle phi(x, y) = a(x) + y b(x) goes on from its long side, x along it and y
/// across, with the cubic a of the values and slopes at the ends and the quadratic b of the three
/// normal derivatives. Rows: its degrees of freedom at the near vertex and on the short sides
/// (near_side), of those on the long one (long_side).
Eigen::Matrix<double, 5, 7> EquilibratedStress::continued(const int t) const
{
  const TorusTriangle &triangle  = mesh.triangles[at(t)];
  const auto shape               = triangle.shape(mesh.edges);
  const double length            = shape[1].norm();
  const Eigen::RowVector2d along = shape[1].transpose() / length, across(-along(1), along(0));
  std::array<Eigen::Vector2d, 3> normals;
  for (int k = 0; k < 3; ++k)
    normals[at(k)] = edge_normal(mesh.edges[at(triangle.edges[at(k)])]);
  const double sign = across.dot(normals[0]);
  // Value, d/dx and d/dy of phi at a point.
  const auto phi = [&](const Eigen::Vector2d &point)
  {
    const double x = along.dot(point) / length, y = across.dot(point), z = 1. - x;
    const double a[4]     = {z * z * (1. + 2. * x), x * z * z * length, x * x * (3. - 2. * x),
                             -x * x * z * length};
    const double slope[4] = {-6. * x * z / length, z * (1. - 3. * x), 6. * x * z / length,
                             x * (3. * x - 2.)};
    const double b[3]     = {z * (1. - 2. * x), 4. * x * z, x * (2. * x - 1.)};
    const double bend[3]  = {(4. * x - 3.) / length, 4. * (1. - 2. * x) / length,
                             (4. * x - 1.) / length};
    Eigen::Matrix<double, 3, 7> rows;
    for (int end = 0; end < 2; ++end)
    {
      const int e = 2 * end; // of a, and of b, whose middle is between
      rows.col(3 * end) << a[e], slope[e] * along.transpose();
      rows.block<1, 2>(0, 3 * end + 1) = a[e + 1] * along + y * b[e] * across;
      rows.block<2, 2>(1, 3 * end + 1) =
        along.transpose() * (slope[e + 1] * along + y * bend[e] * across) +
        across.transpose() * b[e] * across;
    }
    rows.col(6) << sign * y * b[1], sign * (y * bend[1] * along + b[1] * across).transpose();
    return rows;
  };
  Eigen::Matrix<double, 5, 7> rows;
  rows.topRows<3>() = phi(shape[2]);
  for (int k = 1; k < 3; ++k)
    rows.row(2 + k) = normals[at(k)].transpose() *
                      phi(0.5 * (shape[at(k)] + shape[at((k + 1) % 3)])).bottomRows<2>();
  return rows;
}

/// Unknowns in terms of others, in which flat triangles leave the system its condition: what
/// continued() gives becomes the distance from it. On a triangle of height H that is of order H^2
/// for smooth phi, and would otherwise be a difference of values whose energies are H^-3 as large.
Eigen::SparseMatrix<double> EquilibratedStress::basis_of_flat_triangles() const
{
  const auto row_of = [this](const int unknown) { return unknown - (unknown > numbering.pinned); };
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < static_cast<int>(n_dofs); ++row)
    entries.emplace_back(row, row, 1.);
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    if (!is_flat(t))
      continue;
    const Eigen::Matrix<double, 5, 7> factors = continued(t);
    const AiryDofs dofs                       = numbering.of_triangle(t);
    for (int i = 0; i < 5; ++i)
    {
      const AiryDof &near = dofs[at(near_side[at(i)])];
      const int row       = row_of(near.unknowns[0]);
      for (std::size_t a = 1; a < 3; ++a)
        if (near.unknowns[a] >= 0)
          entries.emplace_back(row, row_of(near.unknowns[a]), -near.factors[a]);
      for (int k = 0; k < 7; ++k)
        for (std::size_t a = 0; a < 3; ++a)
        {
          const AiryDof &its = dofs[at(long_side[at(k)])];
          if (its.unknowns[a] >= 0)
            entries.emplace_back(row, row_of(its.unknowns[a]), factors(i, k) * its.factors[a]);
        }
    }
  }
  const auto n = static_cast<Eigen::Index>(n_dofs);
  Eigen::SparseMatrix<double> basis(n, n);
  basis.setFromTriplets(entries.begin(), entries.end());
  return basis;
}

/// Turns the stresses and degrees of freedom of a flat triangle to these unknowns, before products
/// of them lose the digits.
void EquilibratedStress::change_basis(const int t, StressRows &B, AiryDofs &dofs) const
{
  const Eigen::Matrix<double, 5, 7> factors = continued(t);
  for (int i = 0; i < 5; ++i)
  {
    AiryDof distance;
    distance.unknowns[0] = dofs[at(near_side[at(i)])].unknowns[0];
    distance.factors[0]  = 1.;
    for (int k = 0; k < 7; ++k)
    {
      distance.known -= factors(i, k) * dofs[at(long_side[at(k)])].known;
      B.col(long_side[at(k)]) += factors(i, k) * B.col(near_side[at(i)]);
    }
    dofs[at(near_side[at(i)])] = distance;
  }
}
} // namespace homespun::homogenization
