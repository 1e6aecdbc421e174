// SPDX-License-Identifier: MIT
#include "verification/bend/cloth_sheet.h"

#include "meshes/plain/index.h"
#include "meshes/plain/triangle_kinematics.h"
#include "shell/solver/cloth.h"
#include "shell/terms/edge_angles.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "verification/bend/edge_means.h"

#include <Eigen/Dense>

#include <cmath>
#include <map>
#include <set>

namespace homespun::verification
{
using homogenization::curvature_across;
using meshes::at;

namespace
{
bool is_on(const meshes::Sheet &sheet, const int edge, const int vertex)
{
  const double fraction = sheet.fraction(sheet.mesh.vertices.row(vertex))(edge / 2);
  return std::abs(fraction - edge % 2) < 2. * meshes::image_tolerance;
}
} // namespace

ClothSheet::ClothSheet(const meshes::Sheet &sheet, const Eigen::VectorXi &material,
                       ClothStiffness given, const BendingLoad &load)
    : mesh(meshes::placed_sheet(sheet.mesh, Eigen::Matrix3d::Identity().leftCols<2>(),
                                Eigen::RowVector3d::Zero()))
    , sheet(sheet)
    , stiffness(std::move(given))
    , areas(meshes::signed_areas(sheet.mesh))
{
  mesh.rest.material = material;
  for (const Eigen::Matrix3d &D : stiffness.bending)
    plates.push_back(shell::PlateStiffness::from(D));
  std::set<int> vertices;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      for (int edge = 0; edge < meshes::CellEdges::n_sides; ++edge)
      {
        const int from = mesh.triangles(t, k), to = mesh.triangles(t, (k + 1) % 3);
        if (!load.is_clamped[at(edge)] || !is_on(sheet, edge, from) || !is_on(sheet, edge, to))
          continue;
        const Eigen::RowVector2d along =
          (sheet.mesh.vertices.row(to) - sheet.mesh.vertices.row(from)).normalized();
        clamps.push_back({from, to, t, edge, {-along(1), along(0)}});
        vertices.insert({from, to});
      }
  held.assign(vertices.begin(), vertices.end());
}

std::vector<shell::ClampedEdge> ClothSheet::clamped_edges() const
{
  std::vector<shell::ClampedEdge> edges;
  for (const ClampSide &one : clamps)
  {
    Eigen::Vector3d normal(0., 0., std::cos(one.turn));
    normal.head<2>() = -std::sin(one.turn) * one.inwards;
    const Eigen::Vector3d along =
      (mesh.positions.row(one.second) - mesh.positions.row(one.first)).transpose().normalized();
    edges.push_back({one.first, one.second, (normal - normal.dot(along) * along).normalized()});
  }
  return edges;
}

void ClothSheet::bend(const double pressure)
{
  const Eigen::VectorXd shares = shell::lumped_masses(
    mesh, std::vector<double>(stiffness.bending.size(), 1.)); // areas, in the place of masses
  shell::Cloth cloth(mesh.positions, shares, held);
  cloth.add(shell::membrane_term(mesh, stiffness.membrane));
  cloth.add(shell::edge_angles_term(mesh, plates, clamped_edges()));
  cloth.add(shell::gravity_term(shares, {0., 0., pressure}));
  cloth.solve_equilibrium(1e-9);
  mesh.positions = cloth.positions();
}

void ClothSheet::turn_clamps(const homogenization::PlateEdges &edges,
                             const Eigen::VectorXd &curvatures)
{
  std::map<int, EdgeMeans> means;
  for (std::size_t k = 0; k < clamps.size(); ++k)
  {
    ClampSide &one = clamps[k];
    const Eigen::RowVector3d K =
      curvatures(static_cast<Eigen::Index>(k)) * curvature_across(one.inwards).transpose();
    one.turn = edges.sides[at(one.edge)].slip.slope.dot(K);
    means.try_emplace(one.edge, sheet, one.edge)
      .first->second.add({sheet.mesh.vertices.row(one.first).transpose(),
                          sheet.mesh.vertices.row(one.second).transpose()},
                         K.transpose());
  }
  for (const ClampSide &one : clamps)
    for (const int v : {one.first, one.second})
      mesh.positions(v, 2) = edges.sides[at(one.edge)].slip.value.dot(
        means.at(one.edge).at(sheet.mesh.vertices.row(v).transpose()));
}

Eigen::MatrixX3d ClothSheet::moments() const
{
  return shell::bending_moments(mesh, plates, clamped_edges());
}

Eigen::VectorXd ClothSheet::curvature_of_clamps() const
{
  const Eigen::MatrixX3d all = moments();
  Eigen::VectorXd curvature(static_cast<Eigen::Index>(clamps.size()));
  for (std::size_t k = 0; k < clamps.size(); ++k)
  {
    const Eigen::RowVector3d n = curvature_across(clamps[k].inwards);
    const Eigen::Matrix3d &D   = stiffness.bending[at(mesh.rest.material(clamps[k].triangle))];
    curvature(static_cast<Eigen::Index>(k)) = all.row(clamps[k].triangle).dot(n) / n.dot(n * D);
  }
  return curvature;
}

double ClothSheet::moment_of_clamps() const
{
  const Eigen::MatrixX3d all = moments();
  double sum                 = 0.;
  for (const ClampSide &one : clamps)
    sum += (sheet.mesh.vertices.row(one.second) - sheet.mesh.vertices.row(one.first)).norm() *
           all.row(one.triangle).dot(curvature_across(one.inwards));
  return sum;
}

Eigen::MatrixX3d ClothSheet::curvature_of_triangles() const
{
  Eigen::MatrixX3d curvature = moments();
  std::vector<Eigen::Matrix3d> inverse;
  for (const Eigen::Matrix3d &D : stiffness.bending)
    inverse.push_back(D.inverse());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    curvature.row(t) *= inverse[at(mesh.rest.material(t))]; // symmetric
  return curvature;
}

double ClothSheet::mean_curvature() const
{
  const Eigen::MatrixX3d curvature = curvature_of_triangles();
  const Eigen::VectorXd squares =
    curvature.leftCols<2>().rowwise().squaredNorm() + 0.5 * curvature.col(2).cwiseAbs2();
  return std::sqrt(areas.dot(squares) / areas.sum());
}

/// Through the corners of each triangle goes the quadric of its curvature,
///   −½ Σ_i<j l_i l_j κ(e_ij) along the normal,   κ(e) = e.κ e,
/// and at a vertex the mean of all its triangles counts, by their areas: as good where the
/// curvature jumps.
ClothSurface ClothSheet::surface() const
{
  const Eigen::MatrixX3d of_triangles = curvature_of_triangles();
  const Eigen::MatrixX3d zero         = Eigen::MatrixX3d::Zero(mesh.n_vertices(), 3);
  ClothSurface surface                = {zero, {zero, zero}, zero};
  Eigen::VectorXd sums                = Eigen::VectorXd::Zero(mesh.n_vertices());
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const auto corners = mesh.triangles.row(t);
    const Eigen::Matrix<double, 3, 2> gradients =
      meshes::triangle_geometry(meshes::sides_of_triangle<2>(corners, mesh.rest.vertices))
        .shape_gradients;
    const Eigen::Matrix<double, 3, 2> F =
      meshes::deformation_gradient<3>(mesh.rest, t, mesh.positions);
    const Eigen::Vector3d normal   = F.col(0).cross(F.col(1)).normalized();
    const Eigen::Matrix3d in_space = F * (F.transpose() * F).inverse() * gradients.transpose();
    for (int k = 0; k < 3; ++k)
    {
      Eigen::Vector3d own = normal;
      for (int j = 0; j < 3; ++j)
      {
        const Eigen::RowVector2d e =
          mesh.rest.vertices.row(corners(j)) - mesh.rest.vertices.row(corners(k));
        own += 0.5 * in_space.col(j) *
               of_triangles.row(t).dot(Eigen::RowVector3d(e(0) * e(0), e(1) * e(1), e(0) * e(1)));
      }
      const int v = corners(k);
      surface.normals.row(v) += areas(t) * own.transpose();
      surface.curvature.row(v) += areas(t) * of_triangles.row(t);
      for (int axis = 0; axis < 2; ++axis)
        surface.tangents[at(axis)].row(v) += areas(t) * F.col(axis).transpose();
      sums(v) += areas(t);
    }
  }
  surface.normals.rowwise().normalize();
  for (Eigen::MatrixX3d &one : surface.tangents)
  {
    const Eigen::VectorXd along_normal = one.cwiseProduct(surface.normals).rowwise().sum();
    one -= along_normal.asDiagonal() * surface.normals;
  }
  for (Eigen::MatrixX3d *one : {&surface.tangents[0], &surface.tangents[1], &surface.curvature})
    one->array().colwise() /= sums.array();
  return surface;
}
} // namespace homespun::verification
