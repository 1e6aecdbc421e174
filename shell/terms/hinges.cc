// SPDX-License-Identifier: MIT
#include "shell/terms/hinges.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/singular_values.h"
#include "meshes/plain/triangle_area.h"
#include "shell/algebra/index.h"

#include <Eigen/Dense>

#include <algorithm>
#include <map>
#include <sstream>

namespace homespun::shell
{
namespace
{
// Singular values of G are 1 on regular meshes and above 0.3 where vertices are displaced by a
// quarter of the mesh width; they vanish where six points lie on a conic.
constexpr double smallest_singular_value = 0.2;

Eigen::Matrix<double, 3, 2> rest_corners(const meshes::ClothMesh &mesh, const int t)
{
  Eigen::Matrix<double, 3, 2> corners;
  for (int k = 0; k < 3; ++k)
    corners.row(k) = mesh.rest.vertices.row(mesh.rest.triangles(t, k));
  return corners;
}

std::vector<std::string> faults_of(const meshes::ClothMesh &mesh,
                                   const std::vector<PlateStiffness> &stiffness)
{
  std::vector<std::string> faults;
  const auto fault = [&](const std::string &message)
  {
    if (faults.size() < 10)
      faults.push_back("bending: " + message);
  };
  for (std::size_t phase = 0; phase < stiffness.size(); ++phase)
  {
    const PlateStiffness &D = stiffness[phase];
    if (!D.is_positive_definite())
    {
      std::ostringstream text;
      text << "stiffness of phase " << phase << " is D11 = " << D.D11 << ", D22 = " << D.D22
           << ", D12 = " << D.D12 << ", D66 = " << D.D66 << ", D16 = " << D.D16
           << ", D26 = " << D.D26
           << " N m; expected a positive definite matrix: D11, D22, D66 > 0, D12^2 < D11 D22, and "
              "D16, D26 small enough";
      fault(text.str());
    }
  }
  if (mesh.rest.n_triangles() != mesh.n_triangles() ||
      mesh.rest.material.size() != mesh.n_triangles())
  {
    fault(std::to_string(mesh.n_triangles()) + " triangles in space, " +
          std::to_string(mesh.rest.n_triangles()) + " at rest, " +
          std::to_string(mesh.rest.material.size()) + " phases; expected one each");
    return faults;
  }
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const std::string name = "triangle " + std::to_string(t);
    const auto space = mesh.triangles.row(t), rest = mesh.rest.triangles.row(t);
    if (space.minCoeff() < 0 || space.maxCoeff() >= mesh.n_vertices() || rest.minCoeff() < 0 ||
        rest.maxCoeff() >= mesh.rest.n_vertices())
    {
      fault(name + " has a vertex out of range; expected 0 ... " +
            std::to_string(mesh.n_vertices() - 1) + " in space and 0 ... " +
            std::to_string(mesh.rest.n_vertices() - 1) + " at rest");
      continue;
    }
    const meshes::TriangleArea its = meshes::triangle_area<2>(rest_corners(mesh, t));
    if (!its.is_there() || its.area < 0.)
    {
      std::ostringstream text;
      text << name << " has area " << its.area
           << " m^2 at rest; expected a counter-clockwise triangle of positive area: remove or "
              "turn it";
      fault(text.str());
    }
    if (mesh.rest.material(t) < 0 || mesh.rest.material(t) >= static_cast<int>(stiffness.size()))
      fault(name + " has phase " + std::to_string(mesh.rest.material(t)) + "; expected 0 ... " +
            std::to_string(static_cast<int>(stiffness.size()) - 1) +
            ", one stiffness is given for each");
  }
  return faults;
}

/// Which triangles share an edge in space.
void find_neighbours(const meshes::ClothMesh &mesh, Hinges &hinges)
{
  std::vector<std::string> faults;
  std::map<std::array<int, 2>, std::array<int, 2>>
    sides; // directed edge: triangle, corner opposite
  const auto name = [](const int a, const int b)
  { return "bending: edge (" + std::to_string(a) + ", " + std::to_string(b) + ") "; };
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = mesh.triangles(t, (k + 1) % 3), b = mesh.triangles(t, (k + 2) % 3);
      const auto [other, is_new] = sides.insert({{a, b}, {t, k}});
      if (!is_new && faults.size() < 10)
        faults.push_back(
          name(a, b) + "is traversed the same way by triangles " +
          std::to_string(other->second[0]) + " and " + std::to_string(t) +
          "; expected two triangles that traverse it in opposite ways: turn a panel, or sew two "
          "panels only");
    }
  if (!faults.empty())
    throw meshes::BadInput(faults);
  for (const auto &[edge, side] : sides)
    if (const auto other = sides.find({edge[1], edge[0]}); other != sides.end())
    {
      HalfHinge &hinge       = hinges.of[index(side[0])][index(side[1])];
      hinge.neighbour        = other->second[0];
      hinge.neighbour_corner = other->second[1];
      hinge.opposite         = mesh.triangles(hinge.neighbour, hinge.neighbour_corner);
    }
}

/// Weights and g of a hinge, its neighbour unfolded into the rest plane of triangle t.
void measure(const meshes::ClothMesh &mesh, const Hinges &hinges, const int t, const int corner,
             HalfHinge &hinge)
{
  const auto own = rest_corners(mesh, t), far = rest_corners(mesh, hinge.neighbour);
  const int k = corner, l = hinge.neighbour_corner;
  const Eigen::RowVector2d first = own.row((k + 1) % 3), edge = own.row((k + 2) % 3) - first,
                           far_edge = far.row((l + 1) % 3) - far.row((l + 2) % 3),
                           far_arm  = far.row(l) - far.row((l + 2) % 3);
  const double length = edge.norm(), far_length = far_edge.norm(), area = hinges.area[index(t)],
               far_area          = hinges.area[index(hinge.neighbour)];
  hinge.length                   = length;
  const Eigen::RowVector2d along = edge / length, outward(along(1), -along(0));
  // Along the edge as a part of it, so that sides of a seam may differ in length (easing).
  const double part     = far_arm.dot(far_edge) / (far_length * far_length);
  const double own_part = (own.row(k) - first).dot(along) / length;
  const double height = 2. * area / length, far_height = 2. * far_area / far_length;
  // Slopes out of t on both sides, (x at the opposite corner − x at its foot)/height; k is their
  // difference over the mean height: 2/(h + h') = |e|/(A + A').
  const double scale = 2. / (height + far_height);
  hinge.weights << -(1. - part) / far_height - (1. - own_part) / height,
    -part / far_height - own_part / height, 1. / height, 1. / far_height;
  hinge.weights *= scale;
  Eigen::Matrix<double, 4, 2> points;
  points.row(0) = Eigen::RowVector2d::Zero();
  points.row(1) = edge;
  points.row(2) = own.row(k) - first;
  points.row(3) = part * edge + far_height * outward;
  hinge.curvature.setZero();
  for (int p = 0; p < 4; ++p)
  {
    const double y1 = points(p, 0), y2 = points(p, 1);
    hinge.curvature += 0.5 * hinge.weights(p) * Eigen::RowVector3d(y1 * y1, y2 * y2, y1 * y2);
  }
}

} // namespace

Hinges neighbours_of(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness)
{
  if (const auto faults = faults_of(mesh, stiffness); !faults.empty())
    throw meshes::BadInput(faults);
  Hinges hinges;
  hinges.of.resize(index(mesh.n_triangles()));
  find_neighbours(mesh, hinges);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    hinges.area.push_back(meshes::triangle_area<2>(rest_corners(mesh, t)).area);
  return hinges;
}

Hinges hinges_of(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness)
{
  Hinges hinges = neighbours_of(mesh, stiffness);
  hinges.patches.resize(hinges.of.size());
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    Patch &patch = hinges.patches[index(t)];
    Eigen::Matrix<double, Eigen::Dynamic, 3> G(3, 3);
    for (int k = 0; k < 3; ++k)
      if (HalfHinge &hinge = hinges.of[index(t)][index(k)]; hinge.opposite >= 0)
      {
        measure(mesh, hinges, t, k, hinge);
        G.row(static_cast<Eigen::Index>(patch.corner.size())) = hinge.curvature;
        patch.corner.push_back(k);
      }
    if (patch.corner.empty())
      continue;
    G.conservativeResize(static_cast<Eigen::Index>(patch.corner.size()), 3);
    const meshes::SingularValues svd =
      meshes::singular_values(G, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::MatrixXd tame =
      svd.U * svd.values.cwiseMax(smallest_singular_value).asDiagonal() * svd.V.transpose();
    const Eigen::Matrix3d D          = stiffness[index(mesh.rest.material(t))].matrix();
    const Eigen::MatrixXd compliance = tame * D.ldlt().solve(Eigen::MatrixXd(tame.transpose()));
    patch.stiffness                  = hinges.area[index(t)] * compliance.inverse();
    patch.stiffness = (0.5 * (patch.stiffness + patch.stiffness.transpose())).eval();
  }
  return hinges;
}

std::array<int, 4> vertices_of(const meshes::ClothMesh &mesh, const int t, const int corner,
                               const HalfHinge &hinge)
{
  return {mesh.triangles(t, (corner + 1) % 3), mesh.triangles(t, (corner + 2) % 3),
          mesh.triangles(t, corner), hinge.opposite};
}
} // namespace homespun::shell
