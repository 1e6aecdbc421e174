// SPDX-License-Identifier: MIT
#include "homogenization/bracket/plate.h"

#include "homogenization/algebra/refined_solution.h"
#include "homogenization/bracket/equilibrated_stress.h"
#include "meshes/plain/index.h"

#include <algorithm>
#include <utility>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// The pieces of a Clough-Tocher triangle that hold a point, and its coordinates there: where
/// pieces meet all of them, not the one that rounding chooses.
std::vector<std::pair<int, Eigen::Vector3d>> in_pieces(const Eigen::Vector3d &barycentric)
{
  const double least = barycentric.minCoeff();
  std::vector<std::pair<int, Eigen::Vector3d>> pieces;
  for (int farthest = 0; farthest < 3; ++farthest) // corner, which the piece does not touch
    if (barycentric(farthest) <= least + ThinPlate::snap)
    {
      const int piece = (farthest + 1) % 3;
      const double on = barycentric(farthest);
      pieces.push_back(
        {piece, {barycentric(piece) - on, barycentric((piece + 1) % 3) - on, 3. * on}});
    }
  return pieces;
}

Eigen::Matrix<double, 3, 12> curvatures_of(const Eigen::Matrix<double, 3, 12> &second_derivatives)
{
  Eigen::Matrix<double, 3, 12> kappa = second_derivatives;
  kappa.row(2) *= 2.;
  return kappa;
}
} // namespace

ThinPlate::ThinPlate(PlateMesh mesh, std::vector<Eigen::Matrix3d> bending_stiffness_of_material)
    : mesh(std::move(mesh))
    , bending_stiffness_of_material(std::move(bending_stiffness_of_material))
{
}

int ThinPlate::n_dofs() const
{
  return dof_of_side(static_cast<int>(mesh.normals.size()));
}

int ThinPlate::dof_of_side(const int side) const
{
  return 3 * mesh.n_vertices + side;
}

std::array<int, 12> ThinPlate::dofs_of(const int triangle) const
{
  const PlateTriangle &its = mesh.triangles[at(triangle)];
  std::array<int, 12> dofs;
  for (int k = 0; k < 3; ++k)
  {
    for (int d = 0; d < 3; ++d)
      dofs[at(3 * k + d)] = 3 * its.vertices[at(k)] + d;
    dofs[at(9 + k)] = dof_of_side(its.sides[at(k)]);
  }
  return dofs;
}

double ThinPlate::area(const int triangle) const
{
  const auto &corners     = mesh.triangles[at(triangle)].corners;
  const Eigen::Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
  return 0.5 * (a(0) * b(1) - a(1) * b(0));
}

CloughTocher ThinPlate::element(const int triangle) const
{
  const PlateTriangle &its = mesh.triangles[at(triangle)];
  return {
    {Eigen::Vector2d::Zero(), its.corners[1] - its.corners[0], its.corners[2] - its.corners[0]},
    {mesh.normals[at(its.sides[0])], mesh.normals[at(its.sides[1])],
     mesh.normals[at(its.sides[2])]}};
}

ThinPlate::Shapes ThinPlate::shapes(const int triangle, const Eigen::Vector3d &barycentric) const
{
  const CloughTocher its = element(triangle);
  const auto pieces      = in_pieces(barycentric);
  Shapes rows            = Shapes::Zero();
  for (const auto &[piece, point] : pieces)
  {
    rows.topRows<3>() += its.value_and_gradient(piece, point);
    rows.bottomRows<3>() += curvatures_of(its.second_derivatives(piece, point));
  }
  return rows / static_cast<double>(pieces.size());
}

ThinPlate::Values ThinPlate::values(const int triangle, const Eigen::Vector3d &barycentric,
                                    const Eigen::VectorXd &deflection) const
{
  const auto dofs = dofs_of(triangle);
  Eigen::Matrix<double, 12, 1> local;
  for (int k = 0; k < 12; ++k)
    local(k) = deflection(dofs[at(k)]);
  return shapes(triangle, barycentric) * local;
}

std::vector<Eigen::Matrix<double, 3, 12>>
ThinPlate::values_and_gradients(const int triangle, const std::vector<WeightedPoint> &points) const
{
  const CloughTocher its = element(triangle);
  std::vector<Eigen::Matrix<double, 3, 12>> rows;
  for (const WeightedPoint &one : points)
    rows.push_back(its.value_and_gradient(one.point.piece, one.point.in_piece));
  return rows;
}

Eigen::Matrix<double, 27, 12> ThinPlate::curvatures(const int triangle) const
{
  const auto second = second_derivatives_at_field_points(element(triangle));
  Eigen::Matrix<double, 27, 12> rows;
  for (int q = 0; q < n_field_points; ++q)
    rows.middleRows<3>(3 * q) = curvatures_of(second[at(q)]);
  return rows;
}

Eigen::VectorXd ThinPlate::pressure() const
{
  const std::vector<WeightedPoint> points = points_of_pieces(3); // of cubic ones
  Eigen::VectorXd load                    = Eigen::VectorXd::Zero(n_dofs());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
  {
    const auto dofs = dofs_of(t);
    const auto rows = values_and_gradients(t, points);
    for (std::size_t q = 0; q < points.size(); ++q)
      for (int k = 0; k < 12; ++k)
        load(dofs[at(k)]) += area(t) * points[q].weight * rows[q](0, k);
  }
  return load;
}

Eigen::MatrixXd ThinPlate::of_moments(const std::vector<Eigen::MatrixXd> &moments_of_triangle) const
{
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(n_dofs(), moments_of_triangle.front().cols());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
  {
    const Eigen::Matrix<double, 27, 12> kappa = curvatures(t);
    Eigen::Matrix<double, 3, 12> integral     = Eigen::Matrix<double, 3, 12>::Zero();
    for (int q = 0; q < n_field_points; ++q)
      integral += area(t) / n_field_points * kappa.middleRows<3>(3 * q);
    const auto dofs              = dofs_of(t);
    const Eigen::MatrixXd forces = integral.transpose() * moments_of_triangle[at(t)];
    for (int k = 0; k < 12; ++k)
      loads.row(dofs[at(k)]) += forces.row(k);
  }
  return loads;
}

Eigen::Matrix<double, 12, 12> ThinPlate::stiffness(const int triangle) const
{
  const Eigen::Matrix<double, 27, 12> kappa = curvatures(triangle);
  const Eigen::Matrix3d &D =
    bending_stiffness_of_material[at(mesh.triangles[at(triangle)].material)];
  Eigen::Matrix<double, 12, 12> of_shapes = Eigen::Matrix<double, 12, 12>::Zero();
  for (int q = 0; q < n_field_points; ++q)
    of_shapes += area(triangle) / n_field_points * kappa.middleRows<3>(3 * q).transpose() * D *
                 kappa.middleRows<3>(3 * q);
  return of_shapes;
}

/// The stiffness of the unknowns, lower triangle; what is held goes to the right.
Eigen::SparseMatrix<double> ThinPlate::reduced(const std::vector<int> &unknown, const int n,
                                               const Eigen::MatrixXd &held,
                                               Eigen::MatrixXd &right) const
{
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(78 * mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
  {
    const Eigen::Matrix<double, 12, 12> of_triangle = stiffness(t);
    const auto dofs                                 = dofs_of(t);
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
      {
        const int row = unknown[at(dofs[at(i)])], column = unknown[at(dofs[at(j)])];
        if (row < 0)
          continue;
        if (column < 0)
          right.row(row) -= of_triangle(i, j) * held.row(dofs[at(j)]);
        else if (row >= column)
          entries.emplace_back(row, column, of_triangle(i, j));
      }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::MatrixXd ThinPlate::solve(const Eigen::MatrixXd &loads,
                                 const std::vector<HeldDof> &held) const
{
  Eigen::MatrixXd solution = Eigen::MatrixXd::Zero(n_dofs(), loads.cols());
  std::vector<int> unknown(at(n_dofs()), 0);
  for (const HeldDof &one : held)
  {
    unknown[at(one.dof)] = -1;
    solution.row(one.dof).setConstant(one.value);
  }
  int n = 0;
  for (int &number : unknown)
    if (number >= 0)
      number = n++;
  Eigen::MatrixXd right(n, loads.cols());
  for (int d = 0; d < n_dofs(); ++d)
    if (unknown[at(d)] >= 0)
      right.row(unknown[at(d)]) = loads.row(d);
  const Eigen::SparseMatrix<double> matrix = reduced(unknown, n, solution, right);
  const Eigen::MatrixXd found              = refined_solution(matrix, right, "plate").values;
  for (int d = 0; d < n_dofs(); ++d)
    if (unknown[at(d)] >= 0)
      solution.row(d) = found.row(unknown[at(d)]);
  return solution;
}

Eigen::Vector3d curvature_across(const Eigen::Vector2d &n)
{
  return {n(0) * n(0), n(1) * n(1), 2. * n(0) * n(1)};
}

Eigen::Matrix3d mean_of_materials(const TorusMesh &mesh,
                                  const std::vector<Eigen::Matrix3d> &stiffness_of_material)
{
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const TorusTriangle &triangle : mesh.triangles)
    mean += area_of(triangle.shape(mesh.edges)) / mesh.lattice.area() *
            stiffness_of_material[at(triangle.material)];
  return mean;
}

PlateCell solve_plate_cell(const TorusMesh &mesh,
                           const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material)
{
  const ThinPlate plate(PlateMesh(mesh), bending_stiffness_of_material);
  std::vector<Eigen::MatrixXd> moments;
  PlateCell cell;
  cell.stiffness.setZero();
  for (int t = 0; t < static_cast<int>(plate.mesh.triangles.size()); ++t)
  {
    const Eigen::Matrix3d &D =
      bending_stiffness_of_material[at(plate.mesh.triangles[at(t)].material)];
    moments.emplace_back(-D);
    cell.stiffness += plate.area(t) * D;
  }
  const Eigen::MatrixXd loads = plate.of_moments(moments);
  cell.deflection             = plate.solve(loads, {{3 * mesh.anchor, 0.}});
  const Eigen::VectorXd areas = plate.pressure();
  const Eigen::RowVector3d mean =
    areas.transpose() * cell.deflection /
    areas.head(3 * mesh.n_vertices)(Eigen::seqN(0, mesh.n_vertices, 3)).sum();
  for (int v = 0; v < mesh.n_vertices; ++v)
    cell.deflection.row(3 * v) -= mean;
  // The minimum is the energy without phi, less that of phi, which is ½ loads.phi.
  const Eigen::Matrix3d gained = loads.transpose() * cell.deflection;
  cell.stiffness = (cell.stiffness - 0.5 * (gained + gained.transpose())) / mesh.lattice.area();
  return cell;
}
} // namespace homespun::homogenization
