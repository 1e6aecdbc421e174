// SPDX-License-Identifier: MIT
// A sheet of whole cells that bends by large turns: its mesh as a cloth in space, of the phases or
// homogenized, how it is held and loaded, and what its clamps add to the homogenized one.
//
//   E = Σ_triangles A ( ½ (U−I):C:(U−I) + ½ κ:D:κ ) − p Σ_vertices A_v z
//
// with the membrane of the law `biot` and the curvature of shell/terms/edge_angles.h: order two in
// positions. The load is a dead one, as weight. A clamp holds its vertices and gives its tangent
// plane.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "meshes/plain/sheet.h"
#include "shell/terms/edge_plates.h"
#include "verification/bend/plate_sheet.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::verification
{
/// Stiffness per material of a mesh.
struct ClothStiffness
{
  std::vector<Eigen::Matrix3d> membrane; ///< [N/m]
  std::vector<Eigen::Matrix3d> bending;  ///< [N m]
};

/// A smooth surface through a cloth, at its vertices.
struct ClothSurface
{
  Eigen::MatrixX3d normals;                 ///< of length 1
  std::array<Eigen::MatrixX3d, 2> tangents; ///< along the axes of the sheet at rest [-]
  Eigen::MatrixX3d curvature;               ///< κ11, κ22, 2 κ12 [1/m]
};

class ClothSheet
{
public:
  /// A sheet at rest in the plane z = 0.
  /// @param material of each triangle of the sheet's mesh
  ClothSheet(const meshes::Sheet &sheet, const Eigen::VectorXi &material, ClothStiffness stiffness,
             const BendingLoad &load);

  /// Equilibrium under a pressure along z, from where the cloth is.
  /// @param pressure on its triangles at rest [N/m^2]
  /// @throws NotConverged
  void bend(double pressure);

  /// Turns the planes of its clamps to what the edges of a cell say, b_a K_a of
  /// homogenization/edges/plate_edges.h, and lifts them by c_a K_a.
  /// @param curvatures across each side of its clamps, curvature_of_clamps() of a homogenized cloth
  void turn_clamps(const homogenization::PlateEdges &edges, const Eigen::VectorXd &curvatures);

  /// Across each side of its clamps, along which there is none, from the moment that it carries
  /// [1/m].
  Eigen::VectorXd curvature_of_clamps() const;

  /// Of its clamps on the sheet, about their edges [N m].
  double moment_of_clamps() const;

  /// sqrt(mean of κ11² + κ22² + 2 κ12²) [1/m].
  double mean_curvature() const;

  ClothSurface surface() const;

  meshes::ClothMesh mesh;

private:
  Eigen::MatrixX3d curvature_of_triangles() const;
  Eigen::MatrixX3d moments() const; ///< M = D κ of each triangle (m,3) [N]

  /// A side of a triangle at a clamp, whose plane is turned about it.
  struct ClampSide
  {
    int first, second;
    int triangle;
    int edge;                ///< 0 to 3, as in meshes::CellEdges
    Eigen::Vector2d inwards; ///< of length 1
    double turn = 0.;        ///< [rad]
  };

  std::vector<shell::ClampedEdge> clamped_edges() const;

  const meshes::Sheet &sheet;
  const ClothStiffness stiffness;
  std::vector<shell::PlateStiffness> plates;
  std::vector<ClampSide> clamps;
  std::vector<int> held;
  Eigen::VectorXd areas; ///< of the triangles [m^2]
};
} // namespace homespun::verification
