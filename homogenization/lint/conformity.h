// SPDX-License-Identifier: MIT
// Whether the triangles of a mesh share the points where they touch. A vertex on the side of
// another triangle, two vertices at one place, parts that overlap: finite elements take them for
// cracks or for cloth that lies there twice, and all that they compute is right, but of another
// cloth.
#pragma once

#include "homogenization/cell/cell_keys.h"
#include "homogenization/cell/finding.h"
#include "homogenization/cell/lattice_triangles.h"
#include "meshes/plain/triangle_mesh.h"

#include <vector>

namespace homespun::homogenization
{
/// Vertices of the boundary on or near to an edge that is not theirs, edges of the boundary that
/// cross, parts that lie on others: three messages of a kind.
///
/// Near is a hundredth of the shorter of both edges: what is that thin is no drawn gap, for its
/// triangles do not resolve it.
/// @param mesh sound, as placed_faults_of() has it [m]
/// @param name of the mesh, put before each message
/// @param slits real: gaps across the void are meant, however thin; overlaps never are
/// @param metres_per_unit of the mesh file, for places in its own unit
std::vector<meshes::MeshFault> conformity_faults(const meshes::TriangleMesh &mesh,
                                                 const std::string &name, Slits slits,
                                                 double metres_per_unit);

/// The same between a cell and its images, where its sides cut holes: vertices nearer than half of
/// an edge to an edge across a side to which they are not joined, and triangles that overlap
/// images.
/// @param glued the cell, its matched vertices one @param drawn the same triangles as they are
/// drawn
std::vector<meshes::MeshFault> conformity_faults_across(const LatticeTriangles &glued,
                                                        const meshes::TriangleMesh &drawn,
                                                        const std::string &name, Slits slits,
                                                        double metres_per_unit);

/// Holes of the size of a single triangle, which may be one that is missing.
std::vector<Finding> lint_missing_triangles(const meshes::TriangleMesh &mesh,
                                            double metres_per_unit);
} // namespace homespun::homogenization
