// SPDX-License-Identifier: MIT
// What homogenization hands to the runtime: the cell, its characteristic displacements, its
// effective stiffness and its mass. Plain data; cell_file.h stores it.
#pragma once

#include "meshes/plain/cell_edges.h"
#include "meshes/plain/cubic_form.h"
#include "meshes/plain/fitted_modes.h"
#include "meshes/plain/lattice.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <optional>
#include <string>

namespace homespun::meshes
{
/// Characteristic displacements, one vertex per row. Column 2 a + c holds component c of chi_a,
/// a = 0, 1, 2 for the unit macro strains 11, 22, 12 (engineering shear). Shape (n,6) [m].
using Chi = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Deflections of a sheet that is bent, one vertex per row: under the macro curvatures K the cell
/// lies at w3 = ½ y.K.y + K11 w_1 + K22 w_2 + 2 K12 w_3, with kappa = +grad grad w3. Shape (n,3)
/// [m^2].
using Deflection = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The pairs of macro strains that the quadratic modes belong to, in their order; 0, 1, 2 stand for
/// 11, 22, 12.
constexpr std::array<std::array<int, 2>, 6> strain_pairs = {
  {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

/// What the quadratic modes are multiplied by: ½ E_a² of equal strains, E_a E_b of others, in the
/// order of strain_pairs.
inline Eigen::Matrix<double, 6, 1> quadratic_factors(const Eigen::Vector3d &strain)
{
  Eigen::Matrix<double, 6, 1> factors;
  for (std::size_t k = 0; k < strain_pairs.size(); ++k)
    factors(static_cast<Eigen::Index>(k)) = (strain_pairs[k][0] == strain_pairs[k][1] ? 0.5 : 1.) *
                                            strain(strain_pairs[k][0]) * strain(strain_pairs[k][1]);
  return factors;
}

/// Quadratic modes, one vertex per row. Column 2 k + c holds component c of chi_ab, ab being pair k
/// of strain_pairs: minus the second derivative of the fluctuation by E_a and E_b at rest. Shape
/// (n,12) [m].
using QuadraticChi = Eigen::Matrix<double, Eigen::Dynamic, 12, Eigen::RowMajor>;

/// What a homogenized cell does at second order in the macro strain E = U − I (Biot, engineering
/// shear), whatever the law of its phases:
///   w(E)   = −sum_a E_a chi_a − ½ sum_a E_a² chi_aa − sum_{a<b} E_a E_b chi_ab + O(E³),
///   W^H(E) = ½ E.C^H.E + energy(E) + O(E⁴).
struct SecondOrder
{
  CubicForm energy; ///< W3 [N/m]
  QuadraticChi chi; ///< (n,12) [m], zero at the anchor
};

/// How a homogenized cell bends. Voigt order 11, 22, 12 with kappa = (kappa11, kappa22, 2 kappa12).
struct CellBendingModes
{
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero(); ///< D^H [N m]
  Deflection deflection;                               ///< (n,3) [m^2], zero at the anchor
};

/// A homogenized periodic unit cell. Voigt order 11, 22, 12 with engineering shear.
///
/// Sign of chi: the total displacement under the macro strain E is E·y + w with
/// w = −(E11 chi_11 + E22 chi_22 + gamma12 chi_12) (paper Eq. 9). chi is anchored: zero at the
/// vertex `anchor` and its images, the lattice points.
struct HomogenizedCell
{
  TriangleMesh mesh;
  Lattice lattice;
  Chi chi;                                             ///< (n,6) [m]
  int anchor                = 0;                       ///< vertex where chi = 0
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero(); ///< C^H [N/m]
  double areal_density      = 0.;                      ///< [kg/m^2]
  std::string provenance;                              ///< how it was made, one line
  std::optional<CellBendingModes> bending;             ///< nothing where it was not computed
  std::string place_of_cut; ///< in words, where the cell is not cut from the cloth as it is drawn
  /// By the law of its phases, `biot` or `green`; those that were not computed are absent.
  std::map<std::string, SecondOrder> second_order;
  std::optional<CellEdges> edges; ///< what it does at edges on lattice lines; nothing: not known
  /// By a law of yarns, which has no second order: modes that `homespun strain` fitted.
  std::map<std::string, FittedModes> fitted;
};
} // namespace homespun::meshes
