// SPDX-License-Identifier: MIT
#include "homogenization/bracket/rolled_cell.h"

#include "homogenization/algebra/refined_solution.h"
#include "homogenization/bracket/displacement_shapes.h"
#include "homogenization/bracket/equilibrated_stress.h"
#include "homogenization/bracket/plate.h"
#include "meshes/plain/index.h"
#include "meshes/plain/triangle_kinematics.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
using StrainsOfProducts = Eigen::Matrix<double, 3, 6>;

Eigen::Vector3d cylinder(const double angle)
{
  return curvature_across({std::cos(angle), std::sin(angle)});
}

/// e at a point for each product of entries of K, which e is quadratic in.
/// @param phi (3,3) deflection and its derivatives, a column per entry of K
StrainsOfProducts strains_of_products(const Eigen::Matrix3d &phi)
{
  constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  const auto e              = [&](const Eigen::Vector3d &K)
  {
    const Eigen::Vector3d its = phi * K;
    return strain_of_deflection(K, its(0), its.tail<2>());
  };
  StrainsOfProducts strains;
  for (int k = 0; k < 6; ++k)
  {
    const auto [a, b]           = pairs[k];
    const Eigen::Vector3d first = Eigen::Vector3d::Unit(a), second = Eigen::Vector3d::Unit(b);
    strains.col(k) = a == b ? e(first) : Eigen::Vector3d(e(first + second) - e(first) - e(second));
  }
  return strains;
}

/// The membrane of a cell in six-node triangles, two unknowns per vertex and per edge, under
/// strains that deflections leave: columns of the six products, then of the three mean strains.
struct MembraneOfCell
{
  static constexpr int n_columns = 9;

  MembraneOfCell(const ThinPlate &plate, const TorusMesh &mesh, const Eigen::MatrixXd &phi,
                 const std::vector<Eigen::Matrix3d> &stiffness_of_material);

  std::vector<Eigen::Triplet<double>> entries;          ///< lower triangle of the stiffness
  Eigen::MatrixXd loads;                                ///< integral B^T C e
  Eigen::Matrix<double, n_columns, n_columns> products; ///< integral e^T C e
};

MembraneOfCell::MembraneOfCell(const ThinPlate &plate, const TorusMesh &mesh,
                               const Eigen::MatrixXd &phi,
                               const std::vector<Eigen::Matrix3d> &stiffness_of_material)
    : loads(Eigen::MatrixXd::Zero(2 * (mesh.n_vertices + mesh.n_edges()), n_columns))
{
  // e is quartic in each piece of a Clough-Tocher triangle: its products have degree 8.
  const std::vector<WeightedPoint> points = points_of_pieces(5);
  products.setZero();
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const PlateTriangle &triangle = plate.mesh.triangles[at(t)];
    const Eigen::Matrix3d &C      = stiffness_of_material[at(triangle.material)];
    Eigen::Matrix2d sides;
    sides << triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0];
    const auto [area, gradients] = meshes::triangle_geometry(sides);
    const auto dofs              = plate.dofs_of(t);
    Eigen::Matrix<double, 12, 3> its_phi;
    for (int k = 0; k < 12; ++k)
      its_phi.row(k) = phi.row(dofs[at(k)]);
    std::array<int, 12> unknowns;
    for (int k = 0; k < 6; ++k)
      for (int c = 0; c < 2; ++c)
        unknowns[at(2 * k + c)] =
          2 * (k < 3 ? triangle.vertices[at(k)] : mesh.n_vertices + triangle.sides[at(k - 3)]) + c;
    const auto shapes = plate.values_and_gradients(t, points);
    using Strains     = Eigen::Matrix<double, 3, 12 + n_columns>; // of the unknowns, and e
    Eigen::Matrix<double, 12 + n_columns, 12 + n_columns> sum;
    sum.setZero();
    for (std::size_t q = 0; q < points.size(); ++q)
    {
      Strains strains;
      strains << strain_displacement<6>(gradients, points[q].point.in_triangle),
        strains_of_products(shapes[q] * its_phi), Eigen::Matrix3d::Identity();
      const Strains stresses = points[q].weight * area * C * strains;
      sum.noalias() += strains.transpose() * stresses;
    }
    products += sum.bottomRightCorner<n_columns, n_columns>();
    for (int i = 0; i < 12; ++i)
    {
      loads.row(unknowns[at(i)]) += sum.row(i).tail<n_columns>();
      for (int j = 0; j < 12; ++j)
        if (unknowns[at(j)] <= unknowns[at(i)])
          entries.emplace_back(unknowns[at(i)], unknowns[at(j)], sum(i, j));
    }
  }
}
} // namespace

Eigen::Vector3d strain_of_deflection(const Eigen::Vector3d &curvature, const double deflection,
                                     const Eigen::Vector2d &gradient)
{
  return Eigen::Vector3d(0.5 * gradient(0) * gradient(0), 0.5 * gradient(1) * gradient(1),
                         gradient(0) * gradient(1)) -
         deflection * curvature;
}

double RolledCell::stretching(const double angle) const
{
  const Eigen::Vector3d K = cylinder(angle);
  Eigen::Matrix<double, 6, 1> products;
  products << K(0) * K(0), K(1) * K(1), K(2) * K(2), K(0) * K(1), K(0) * K(2), K(1) * K(2);
  return std::max(0., products.dot(membrane * products)) / K.dot(stiffness * K);
}

double RolledCell::stiffest(const double angle) const
{
  const Eigen::Vector3d K = cylinder(angle);
  double limit            = K.dot(mean_stiffness * K);
  for (const IsometricBending &its : isometric)
    if (std::abs(std::sin(angle - its.angle)) < 1e-9)
      limit = its.stiffness;
  // Not below one, where D^H is the energy of finite elements.
  return std::max(1., limit / K.dot(stiffness * K));
}

double RolledCell::most(const double angle, const double radius) const
{
  return std::min(1. + stretching(angle) / (radius * radius), stiffest(angle));
}

double RolledCell::least_radius(const double angle, const double tolerance) const
{
  return stiffest(angle) <= 1. + tolerance ? 0. : std::sqrt(stretching(angle) / tolerance);
}

RolledCell::Roll RolledCell::worst(const double tolerance) const
{
  Roll worst{0, 0.};
  for (int degrees = 0; degrees < 180; ++degrees)
    if (const double radius = least_radius(degrees * M_PI / 180., tolerance);
        radius > (1. + 1e-9) * worst.radius)
      worst = {degrees, radius};
  return worst;
}

RolledCell rolled_cell(const TorusMesh &mesh,
                       const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material,
                       const std::vector<Eigen::Matrix3d> &membrane_stiffness_of_material)
{
  const ThinPlate plate(PlateMesh(mesh), bending_stiffness_of_material);
  const PlateCell bent = solve_plate_cell(mesh, bending_stiffness_of_material);
  MembraneOfCell membrane(plate, mesh, bent.deflection, membrane_stiffness_of_material);
  const auto n = static_cast<int>(membrane.loads.rows());
  // The anchor stays where it is.
  const auto is_held = [&](const Eigen::Triplet<double> &entry)
  { return entry.row() / 2 == mesh.anchor || entry.col() / 2 == mesh.anchor; };
  membrane.entries.erase(std::remove_if(membrane.entries.begin(), membrane.entries.end(), is_held),
                         membrane.entries.end());
  for (int c = 0; c < 2; ++c)
    membrane.entries.emplace_back(2 * mesh.anchor + c, 2 * mesh.anchor + c, 1.);
  membrane.loads.middleRows<2>(2 * mesh.anchor).setZero();
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(membrane.entries.begin(), membrane.entries.end());
  const Eigen::MatrixXd u =
    refined_solution(matrix, membrane.loads, "membrane of a rolled cell").values;
  // Energies of e + eps(u), first with the mean strains given, then of the best ones.
  const Eigen::Matrix<double, 9, 9> energies = membrane.products - membrane.loads.transpose() * u;
  const Eigen::Matrix<double, 6, 3> coupling = energies.topRightCorner<6, 3>();
  RolledCell rolled;
  rolled.stiffness = bent.stiffness;
  rolled.membrane =
    (energies.topLeftCorner<6, 6>() -
     coupling * energies.bottomRightCorner<3, 3>().inverse() * coupling.transpose()) /
    mesh.lattice.area();
  for (const std::array<int, 2> &ruling : short_rulings(mesh.lattice))
    rolled.isometric.push_back(
      isometric_bending(plate.mesh, mesh.lattice, bending_stiffness_of_material, ruling));
  rolled.mean_stiffness = mean_of_materials(mesh, bending_stiffness_of_material);
  return rolled;
}
} // namespace homespun::homogenization
