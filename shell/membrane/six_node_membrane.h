// SPDX-License-Identifier: MIT
// A membrane of triangles with six nodes: corners and the middles of the sides, displacements
// quadratic on each triangle (P2), the energy that of membrane.h at three points of a triangle,
// which is exact in small strain. At a point F = sum_k x_k grad N_k is linear in the nodes. So the
// point is written as a small triangle of its own with the same F and the area of its weight, whose
// corners are combinations of the nodes: every law of a Membrane serves here unchanged, and value,
// gradient and Hessian follow by the chain rule.
#pragma once

#include "shell/membrane/membrane.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::shell
{
/// Triangles of six nodes over a coarse sheet, two of its quads wide: its vertices are the nodes.
struct SixNodeMesh
{
  meshes::Points nodes; ///< (n,2) at rest [m]
  /// (m,6) corners 0, 1, 2, counter-clockwise, then the middles of 01, 12, 20
  Eigen::Matrix<int, Eigen::Dynamic, 6, Eigen::RowMajor> triangles;
};

/// The six-node triangles on the vertices of meshes::coarse_sheet() of n1 x n2 quads.
/// @param coarse its mesh, whose vertices become the nodes
/// @throws BadInput where n1 or n2 is odd
SixNodeMesh six_node_mesh(const meshes::TriangleMesh &coarse, int n1, int n2);

/// A membrane of six-node triangles at rest, of one phase.
struct SixNodeMembrane
{
  meshes::Points vertices;                                          ///< the nodes at rest (n,2) [m]
  Eigen::Matrix<int, Eigen::Dynamic, 6, Eigen::RowMajor> triangles; ///< (m,6) their nodes
  Membrane points; ///< a triangle per point, three per six-node triangle
  /// (m) corners of a triangle's three points from its nodes, three rows per point
  std::vector<Eigen::Matrix<double, 9, 6>> corners;
};

/// @param stiffness [N/m]
/// @throws BadInput as membrane() does
SixNodeMembrane six_node_membrane(const SixNodeMesh &mesh, const Eigen::Matrix3d &stiffness);

/// Corners of the triangles of `points`.
/// @param positions of the nodes (n,dim) [m]
/// @return (9 m,dim), three rows per point [m]
template <int dim>
Positions<dim> corners_of_points(const SixNodeMembrane &membrane, const Positions<dim> &positions);

/// As the functions of the same names in membrane.h, positions and displacements those of the
/// nodes.
template <int dim>
double membrane_energy(const SixNodeMembrane &membrane, const Positions<dim> &positions);

template <int dim>
MembraneGradient<dim> membrane_gradient(const SixNodeMembrane &membrane,
                                        const Positions<dim> &positions);

Positions<2> linear_membrane_gradient(const SixNodeMembrane &membrane,
                                      const Positions<2> &displacement);

void add_membrane_hessian(const SixNodeMembrane &membrane, const Positions<2> &positions,
                          Hessian kind, PlaneMatrix &matrix);

/// Values of the six functions at a point of a triangle.
/// @param barycentric of the corners 0, 1, 2
Eigen::Matrix<double, 1, 6> six_node_values(const Eigen::RowVector3d &barycentric);
} // namespace homespun::shell
