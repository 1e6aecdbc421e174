// SPDX-License-Identifier: MIT
// What in a periodic cell can move without being deformed. Triangles that share an edge, directly
// or across a period, move rigidly together; parts that share only vertices are joined by hinges.
// An energy of zero means that every part moves rigidly,
//
//     u = t_p + w_p J x in part p,    u(x + n a) = u(x) + e n a across the lattice,    e symmetric,
//
// which is a small linear system, however fine the mesh: a solution beyond the two translations
// makes the cell problems, and with e other than zero C^H itself, singular.
#pragma once

#include "meshes/plain/lattice.h"
#include "meshes/plain/mesh_fault.h"

#include <vector>

namespace homespun::homogenization
{
/// Triangles that are connected through edges.
struct MeshPart
{
  int n_triangles = 0;
  double area     = 0.; ///< [m^2]
  int n_joints    = 0;  ///< vertices that it shares with other parts, or with its own images
  int n_periods =
    0; ///< independent lattice vectors across which it is connected with its own images, 0 to 2
  bool is_free = false; ///< moves against the largest part without energy
  meshes::Place place;  ///< a point inside
};

struct Mechanisms
{
  std::vector<int> part;       ///< (m) of each triangle; parts are sorted by falling area
  std::vector<MeshPart> parts; ///< parts[0] is the largest
  std::vector<int> hinges;     ///< vertices, lowest image, where triangles meet only in that vertex
  /// Macro strains that cost no energy, one per column, (3,k) in Voigt order.
  Eigen::Matrix3Xd free_strains;
  /// Whether free motions were looked for; else parts that nothing touches are known to be free,
  /// and no more.
  bool is_determined = true;
};

/// Parts up to which their motions are determined: the kernel is that of a dense matrix of three
/// columns per part.
constexpr int most_parts = 300;

/// @param mesh sound by meshes::faults_of(), and periodic: no two of its vertices coincide
Mechanisms find_mechanisms(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice);
} // namespace homespun::homogenization
