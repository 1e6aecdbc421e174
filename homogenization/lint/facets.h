// SPDX-License-Identifier: MIT
// Polygons that stand for arcs. Where the outline of a phase turns by small equal angles from edge
// to edge, somebody drew an arc and a mesh cut it: every bracket then converges to the C^H of the
// polygon. How far that is from the arc's can be estimated from the circles through neighbouring
// vertices.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/homogenized_cell.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace homespun::homogenization
{
/// An edge between two phases, or on the rim of a hole, that looks like the chord of an arc.
struct Facet
{
  int inside, outside;    ///< triangles: of the arc's centre and beyond the chord; −1 in a hole
  Eigen::Vector2d vector; ///< along the chord [m]
  double turn;            ///< the smaller of the angles at its ends [rad]
  /// Between chord and arc, curvature x length^3 / 12, with the mean curvature of the circles
  /// through each end and both its neighbours, 2 sin(turn) / distance of the neighbours [m^2].
  double area;
};

/// All edges at whose ends the outline turns to the same side by at most 31 degrees (a twelve-sided
/// polygon) and by angles within a factor of 1.5; nothing where there are fewer than three. Curved
/// sides are none.
std::vector<Facet> facets_of(const UnitCell &cell);

/// What arcs in the place of the facets would change, to first order in their slivers.
struct GeometryEstimate
{
  int n_facets;
  double area;            ///< of all slivers, in parts of the cell
  Eigen::Matrix3d change; ///< of C^H [N/m]
};

/// C^H changes by 1/|Y| sum of area x (psi_inside − psi_outside). Stretch e along and traction t on
/// an interface are continuous across it, and with stiffness c in its frame (along a, across b)
///   psi = e k e + 2 e q.t − t.f.t,   f = c_bb^-1, q = f c_ba, k = c_aa − c_ab f c_ba;
/// e is the mean of both sides weighted by k, for the stiff side knows it best, t that by f, from
/// displacements that are linear in each triangle. Nothing without facets.
/// @param chi at the vertices of the cell
/// Source: G. Allaire, Conception optimale de structures, 2007, chapter 6 (the shape derivative of
/// an interface).
std::optional<GeometryEstimate> geometry_estimate(const UnitCell &cell, const meshes::Chi &chi);
} // namespace homespun::homogenization
