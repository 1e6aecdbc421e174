// SPDX-License-Identifier: MIT
#include "shell/terms/edge_plates.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/index.h"
#include "shell/terms/hinges.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <map>

namespace homespun::shell
{
namespace
{
/// κ = G a (Voigt, engineering twist) of a triangle at rest.
Eigen::Matrix3d curvature_of_angles(const meshes::ClothMesh &mesh, const int t, const double area)
{
  Eigen::Matrix3d G;
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::RowVector2d side = mesh.rest.vertices.row(mesh.rest.triangles(t, (k + 2) % 3)) -
                                    mesh.rest.vertices.row(mesh.rest.triangles(t, (k + 1) % 3));
    // |e| n n^T with n = (side 2, −side 1)/|e|
    G.col(k) << side(1) * side(1), side(0) * side(0), -2. * side(0) * side(1);
    G.col(k) /= side.norm() * area;
  }
  return G;
}

void find_edges(const Hinges &hinges, EdgePlates &all)
{
  all.plates.resize(hinges.of.size());
  for (int t = 0; t < static_cast<int>(hinges.of.size()); ++t)
    for (int k = 0; k < 3; ++k)
      if (const HalfHinge &hinge = hinges.of[index(t)][index(k)]; hinge.neighbour > t)
      {
        EdgePlate &own = all.plates[index(t)], &other = all.plates[index(hinge.neighbour)];
        own.edge[index(k)]                        = static_cast<int>(all.edges.size());
        own.sign[index(k)]                        = 1.;
        other.edge[index(hinge.neighbour_corner)] = static_cast<int>(all.edges.size());
        other.sign[index(hinge.neighbour_corner)] = -1.;
        all.edges.push_back({{t, hinge.neighbour}, {k, hinge.neighbour_corner}, {}, {}});
      }
}

void add_clamps(const meshes::Triangles &triangles, const Hinges &hinges,
                const std::vector<ClampedEdge> &clamps, EdgePlates &all)
{
  std::map<std::array<int, 2>, std::array<int, 2>> outline;
  for (int t = 0; t < static_cast<int>(hinges.of.size()); ++t)
    for (int k = 0; k < 3; ++k)
      if (hinges.of[index(t)][index(k)].neighbour < 0)
        outline[{triangles(t, (k + 1) % 3), triangles(t, (k + 2) % 3)}] = {t, k};
  std::vector<std::string> faults;
  for (const ClampedEdge &clamp : clamps)
  {
    auto found = outline.find({clamp.first, clamp.second});
    if (found == outline.end())
      found = outline.find({clamp.second, clamp.first});
    const std::string its_name = "bending: clamp of edge (" + std::to_string(clamp.first) + ", " +
                                 std::to_string(clamp.second) + ") ";
    if (found == outline.end())
      faults.push_back(its_name + "is not at the outline, or there twice; expected an edge of one "
                                  "triangle");
    else if (!clamp.normal.allFinite() || !(clamp.normal.norm() > 0.))
      faults.push_back(its_name + "has no normal; expected a vector that is not zero");
    else
    {
      const auto [t, k]                   = found->second;
      all.plates[index(t)].edge[index(k)] = static_cast<int>(all.edges.size());
      all.edges.push_back({{t, -1}, {k, -1}, clamp.normal.normalized(), {}});
      outline.erase(found);
    }
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);
}

/// Free edges carry no moment: their rows and columns of K^-1 do not count.
void add_plate(const Eigen::Matrix3d &K, EdgePlate &plate,
               std::vector<Eigen::Triplet<double>> &entries)
{
  std::vector<Eigen::Index> there;
  for (Eigen::Index k = 0; k < 3; ++k)
    if (plate.edge[index(k)] >= 0)
      there.push_back(k);
  plate.K.setZero();
  if (there.empty())
    return;
  const Eigen::Matrix3d inverse = K.ldlt().solve(Eigen::Matrix3d::Identity());
  const Eigen::MatrixXd kept    = (0.5 * (inverse + inverse.transpose()))(there, there),
                        own     = kept.inverse();
  plate.K(there, there)         = own;
  plate.K                       = (0.5 * (plate.K + plate.K.transpose())).eval();
  for (std::size_t i = 0; i < there.size(); ++i)
    for (std::size_t j = 0; j < there.size(); ++j)
      entries.emplace_back(plate.edge[index(there[i])], plate.edge[index(there[j])],
                           kept(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
}

void give_places(const meshes::Triangles &triangles, const int n_vertices, EdgePlates &all)
{
  struct Open
  {
    int node = -1, n_edges = 3;
  };
  std::vector<Open> of_vertex(index(n_vertices));
  for (PlateEdge &edge : all.edges)
  {
    if (edge.triangle[1] < 0)
      continue;
    const int t = edge.triangle[0], a = triangles(t, (edge.corner[0] + 1) % 3),
              b     = triangles(t, (edge.corner[0] + 2) % 3);
    Open *open      = &of_vertex[index(std::min(a, b))];
    Open &elsewhere = of_vertex[index(std::max(a, b))];
    if (open->node >= 0 && open->n_edges == 3 && (elsewhere.node < 0 || elsewhere.n_edges < 3))
      open = &elsewhere;
    if (open->n_edges == 3)
      *open = {all.n_nodes++, 0};
    edge.place.node      = open->node;
    edge.place.component = open->n_edges++;
  }
  for (const Open &open : of_vertex)
    for (int component = open.n_edges; component < 3; ++component)
      all.padding.push_back({open.node, component});
}

} // namespace

EdgePlates edge_plates(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness,
                       const std::vector<ClampedEdge> &clamps)
{
  const Hinges hinges = neighbours_of(mesh, stiffness);
  EdgePlates all;
  find_edges(hinges, all);
  add_clamps(mesh.triangles, hinges, clamps, all);
  std::vector<Eigen::Triplet<double>> entries;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const Eigen::Matrix3d G = curvature_of_angles(mesh, t, hinges.area[index(t)]);
    const Eigen::Matrix3d D = stiffness[index(mesh.rest.material(t))].matrix();
    add_plate(hinges.area[index(t)] * G.transpose() * D * G, all.plates[index(t)], entries);
  }
  const auto n = static_cast<Eigen::Index>(all.edges.size());
  all.compliance.resize(n, n);
  all.compliance.setFromTriplets(entries.begin(), entries.end());
  give_places(mesh.triangles, mesh.n_vertices(), all);
  return all;
}

Eigen::VectorXd angles_at_edges(const std::vector<PlateEdge> &edges,
                                const meshes::Triangles &triangles, const meshes::SpacePoints &x)
{
  const auto side = [&](const int t, const int k) -> Eigen::Vector3d
  { return (x.row(triangles(t, (k + 2) % 3)) - x.row(triangles(t, (k + 1) % 3))).transpose(); };
  std::vector<Eigen::Vector3d> normals;
  for (int t = 0; t < static_cast<int>(triangles.rows()); ++t)
    normals.push_back(side(t, 0).cross(side(t, 1)).normalized());
  Eigen::VectorXd theta(static_cast<Eigen::Index>(edges.size()));
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    const PlateEdge &edge      = edges[e];
    const Eigen::Vector3d &own = normals[index(edge.triangle[0])],
                          &other =
                            edge.triangle[1] < 0 ? edge.normal : normals[index(edge.triangle[1])],
                          along         = side(edge.triangle[0], edge.corner[0]).normalized();
    theta(static_cast<Eigen::Index>(e)) = std::atan2(other.cross(own).dot(along), own.dot(other));
  }
  return theta;
}

Eigen::MatrixX3d bending_moments(const meshes::ClothMesh &mesh,
                                 const std::vector<PlateStiffness> &stiffness,
                                 const std::vector<ClampedEdge> &clamps)
{
  const EdgePlates all        = edge_plates(mesh, stiffness, clamps);
  const Eigen::VectorXd theta = angles_at_edges(all.edges, mesh.triangles, mesh.positions);
  Eigen::VectorXd r           = theta; // C r = θ
  if (theta.size() > 0)
    r = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(all.compliance).solve(theta);
  const Eigen::VectorXd areas = meshes::signed_areas(mesh.rest).cwiseAbs();
  Eigen::MatrixX3d moments(mesh.n_triangles(), 3);
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    // r = dE/da = A G^T M, zero at free edges.
    Eigen::Vector3d own = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      if (const int e = all.plates[index(t)].edge[index(k)]; e >= 0)
        own(k) = r(e);
    const Eigen::Matrix3d G = curvature_of_angles(mesh, t, areas(t));
    moments.row(t)          = G.transpose().inverse() * own / areas(t);
  }
  return moments;
}
} // namespace homespun::shell
