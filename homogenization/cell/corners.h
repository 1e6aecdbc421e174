// SPDX-License-Identifier: MIT
// Where the fields of a cell problem are singular, and how strongly. At a vertex where phases meet
// in a corner, or the edge of a hole bends, the displacement is a sum of r^lambda U(theta) with
// exponents lambda that angles and stiffnesses decide; strains grow like r^(lambda − 1), and on
// uniformly refined meshes the energy converges with order 2 lambda of the smallest one, whatever
// the order of the elements (Strang and Fix 1973).
#pragma once

#include "meshes/plain/lattice.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
/// A part of the neighbourhood of a vertex that is filled by one stiffness, counter-clockwise.
struct Sector
{
  double begin, end;         ///< angles [rad], begin < end
  Eigen::Matrix3d stiffness; ///< [N/m]
};

/// An outer ray of an open corner that is held; the others are free. For the sheets of a study: the
/// rims of a cell's holes are free.
enum class ClampedRay
{
  none,
  first, ///< where the first sector begins
  last   ///< where the last one ends
};

/// The sectors around a vertex, each beginning where the one before ends; no two neighbours have
/// the same stiffness.
struct Corner
{
  std::vector<Sector> sectors;
  bool is_closed =
    true; ///< the last one ends where the first begins; otherwise it has two outer rays
  ClampedRay clamped = ClampedRay::none; ///< of an open corner
};

/// The corners of a periodic mesh, periodic images once: vertices around which phases of different
/// stiffness meet otherwise than along one straight line, or where the edge of a hole is not
/// straight. None: the cell is homogeneous, or a laminate.
/// @param stiffness_of_material [N/m]
std::vector<Corner> corners_of(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice,
                               const std::vector<Eigen::Matrix3d> &stiffness_of_material);

/// The real parts of all exponents with 0 < Re lambda < 2, ascending, without lambda = 1, which
/// every corner without a clamped ray has (the rotation). Found from
///   integral (B_t V')·c (lambda B_r U + B_t U') − lambda (B_r V)·c (lambda B_r U + B_t U') dtheta
///     = 0 for all V,
/// B_d the strain of a gradient along d, e_r for B_r and e_theta for B_t, with polynomials of high
/// degree in theta. Source: the weak form of equilibrium for u = r^lambda U(theta); D. Leguillon
/// and E. Sanchez-Palencia, Computation of Singular Solutions in Elliptic Problems and Elasticity,
/// 1987, chapter 2.
std::vector<double> exponents_of(const Corner &corner);

/// The smallest and the largest exponent below 1 of all corners of a cell, and the smallest above
/// 1.
struct Singularity
{
  bool exists      = false;
  double strongest = 1., weakest = 0.; ///< meaningless where there is none
  double next = 2.;                    ///< 2 where there is none below
};

/// Corners that are alike are solved once in a program: of a cell with many they take seconds.
Singularity singularity_of(const std::vector<Corner> &corners);
} // namespace homespun::homogenization
