// SPDX-License-Identifier: MIT
// Guaranteed brackets on the effective bending stiffness D^H of a thin periodic sheet (Kirchhoff's
// plate, the period much longer than the thickness), by the analogy of plates and membranes: with
//   P = [0 1 0; 1 0 0; 0 0 −1/2]
// the moments of a plate in equilibrium are M = P eps(psi) of periodic displacements psi, and the
// curvatures of a deflection w are P^-1 sigma of the stresses with Airy's function w. The sheet
// whose membrane stiffness is ct = P D^-1 P hence has
//   D^H = P (Ct^H)^-1 P,   D_lower = P Ct_upper^-1 P,   D_upper = P Ct_lower^-1 P,
// so that the bracket of a membrane brackets a plate, lower and upper exchanged. An isotropic phase
// becomes one of Poisson's ratio −nu and membrane modulus 12 (1 − nu^2)/(E t^3); a hole, which
// bends freely, becomes rigid.
#pragma once

#include "homogenization/bracket/bracket.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace homespun::homogenization
{
/// Both sides of D^H on one mesh, Voigt order 11, 22, 12 with kappa = (kappa11, kappa22, 2 kappa12)
/// [N m].
struct BendingBracket
{
  Eigen::Matrix3d lower, upper; ///< round-off added on the outside
  bool is_of_drawing = false;   ///< whose phases have curved sides
  double width       = 0.;      ///< largest v.(upper − lower).v / v.upper.v
  double round_off   = 0.;      ///< what was added, relative
  double excess      = 0.;      ///< of either energy above its minimum on this mesh, relative

  Eigen::Matrix3d stiffness;     ///< energies of the deflections, nothing added; on the upper side
  meshes::Deflection deflection; ///< at the vertices of the given mesh, zero at its anchor
  /// Of each material of the given mesh, of the curvatures under unit macro curvatures [-].
  std::vector<FieldProducts> curvature_products;
  unsigned n_triangles = 0, n_deflection_dofs = 0, n_moment_dofs = 0, iterations = 0;
};

/// The membrane ct = P D^-1 P of a plate [1/(N m)].
Eigen::Matrix3d analogous_membrane(const Eigen::Matrix3d &bending_stiffness);
std::vector<Eigen::Matrix3d>
analogous_membranes(const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material);

/// The plate whose analogous membrane has a bracket, made with Holes::rigid.
/// @param bending_stiffness_of_material [N m]
BendingBracket
bending_bracket_from(const Bracket &membrane,
                     const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material);

/// Brackets D^H on one mesh; where it has curved edges, the D^H of the drawing.
///
/// Upper side: the plate by Clough-Tocher triangles, beside order 1 by reduced ones, min 1/|Y|
/// integral (K + kappa(w)).D.(K + kappa(w)), free rims. Lower side: moments P eps(psi) by
/// displacements of the given order, whose total is a rigid motion on each rim. Holes that touch in
/// a vertex turn as one there: guaranteed, but such a bracket does not close.
/// @throws BadInput, NotConverged, std::logic_error as bracket()
BendingBracket bending_bracket(const TorusMesh &mesh,
                               const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material,
                               unsigned order);

struct AdaptiveBendingBracket
{
  BendingBracket bracket; ///< on the last mesh
  TorusMesh mesh;
  AdaptiveEnd ending;
};

/// Solves, marks and bisects until the width is reached.
/// @param options its holes are left alone
/// @param observe is called with each bracket, coarsest first
AdaptiveBendingBracket adaptive_bending_bracket(
  const TorusMesh &mesh, const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material,
  const AdaptiveOptions &options, const std::function<void(const BendingBracket &)> &observe);
} // namespace homespun::homogenization
