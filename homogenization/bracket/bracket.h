// SPDX-License-Identifier: MIT
// Guaranteed brackets on the effective stiffness, C_lower <= C^H <= C_upper as quadratic forms: an
// admissible displacement bounds the energy from above, an admissible stress bounds it from below,
// on any mesh and however well either problem is solved. Where the two differ the mesh is refined.
#pragma once

#include "homogenization/bracket/field_products.h"
#include "homogenization/bracket/holes.h"
#include "homogenization/cell/torus_mesh.h"
#include "meshes/plain/homogenized_cell.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace homespun::homogenization
{
/// Both sides of C^H on one mesh. Voigt order 11, 22, 12 with engineering shear, [N/m].
struct Bracket
{
  Eigen::Matrix3d lower, upper; ///< round-off of the evaluation added on the outside
  bool is_of_drawing = false;   ///< whose phases have curved sides; else of the mesh as it is
  /// Largest v.(upper − lower).v / v.upper.v: by how much any energy can be wrong, relative.
  double width     = 0.;
  double round_off = 0.; ///< what was added, relative: the width is never below it
  double excess    = 0.; ///< how far the two energies lie above their minima on this mesh, relative

  Eigen::Matrix3d compliance;        ///< energies of the stresses, nothing added [m/N]
  Eigen::Matrix3d stiffness;         ///< energies of the displacements, nothing added [N/m]
  Eigen::Matrix3d stiffness_by_flux; ///< their mean stresses [N/m]
  meshes::Chi chi;                   ///< at the vertices of the given mesh [m]
  /// phi under unit mean stresses at the vertices of the given mesh, shape (n,3).
  Eigen::Matrix<double, Eigen::Dynamic, 3> stress_function;
  /// Of each material of the given mesh, of the strains under unit macro strains [-] and of the
  /// stresses under unit mean stresses [-]. What curves leave uncertain counts with the triangle
  /// that it was carved from.
  std::vector<FieldProducts> strain_products, stress_products;
  unsigned n_triangles = 0, n_displacement_dofs = 0, n_stress_dofs = 0, iterations = 0;

  /// Per triangle, 1/|Y| integral of c^-1 : (sigma − c : eps)^2 over it, summed over three macro
  /// strains that are orthonormal in the upper stiffness (Prager and Synge); where c is uncertain
  /// with the upper c, and sigma : (lower c^-1 − upper c^-1) : sigma more. All are positive; their
  /// sum is trace(upper^-1 (upper − lower)) but for round-off, hence between one and three widths.
  Eigen::VectorXd gaps;

  /// Per triangle, what the mesh should be refined by: the jumps of the tractions of the
  /// displacements and of the strains along edges of the stresses. The gaps certify, but they do
  /// not tell where an error comes from: at the corners of a stiff checkerboard both fields are
  /// wrong by a factor far away from the corner that causes it, and gaps then refine everywhere.
  /// What curves leave uncertain is added as it stands in the gaps, in parts of the rest of these.
  Eigen::VectorXd indicators;
};

/// Brackets C^H on one mesh; where it has curved edges, the C^H of the drawing (drawn_mesh.h).
/// @param order of the displacement elements, 1 or 2; beside 1 stresses are of reduced
/// Clough-Tocher
///   triangles, but for drawings
/// @param holes empty, or rigid: then a drawing's holes are inscribed for the lower side and
///   circumscribed for the upper one
/// @throws BadInput, NotConverged as EquilibratedStress and CompatibleStrain; std::logic_error
///   where the lower side lies above the upper one
Bracket bracket(const TorusMesh &given, const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                unsigned order, Holes holes = Holes::empty);

/// Marks the fewest triangles that hold the given part of the sum of all values.
/// Source: W. Doerfler, A convergent adaptive algorithm for Poisson's equation, 1996.
std::vector<char> largest(const Eigen::VectorXd &values, double part);

struct AdaptiveOptions
{
  unsigned order     = 2;       ///< of the displacement elements
  double tolerance   = 1e-3;    ///< stop at this relative width
  unsigned max_dofs  = 1000000; ///< of the larger of the two problems: no finer mesh is solved
  double marked_part = 0.6;     ///< of the indicators, refined in each step
  Holes holes        = Holes::empty;
};

/// Why an adaptive bracket ended.
enum class AdaptiveEnd
{
  tolerance,  ///< the width is reached
  max_dofs,   ///< the next mesh would be too large
  round_off,  ///< the width is that of round-off
  resolution, ///< the shortest edge comes near the smallest numbers
};

struct AdaptiveBracket
{
  Bracket bracket; ///< on the last mesh
  TorusMesh mesh;
  AdaptiveEnd ending;
};

/// Solves, marks and bisects until the width is reached.
/// @param observe is called with each bracket, coarsest first
AdaptiveBracket adaptive_bracket(const TorusMesh &mesh,
                                 const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                                 const AdaptiveOptions &options,
                                 const std::function<void(const Bracket &)> &observe);

/// The same on a mesh that is its own drawing.
inline AdaptiveBracket adaptive_bracket(const meshes::TriangleMesh &mesh,
                                        const meshes::Lattice &lattice,
                                        const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                                        const AdaptiveOptions &options,
                                        const std::function<void(const Bracket &)> &observe)
{
  return adaptive_bracket(glued(mesh, lattice), stiffness_of_material, options, observe);
}
} // namespace homespun::homogenization
