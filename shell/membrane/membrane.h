// SPDX-License-Identifier: MIT
// The membrane term of a cloth: the corotational energy of corotational_energy.h, or that of
// yarn_energy.h, summed over a triangle mesh with a stiffness per phase. Value, gradient and
// Hessian take the same arguments and keep no state, so that a solver adds further terms beside it
// or leaves this one out.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "meshes/plain/triangle_mesh.h"
#include "meshes/plain/yarn_axes.h"
#include "shell/algebra/plane_matrix.h"
#include "shell/membrane/corotational_energy.h"
#include "shell/membrane/guarded_cubic.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::shell
{
/// Positions of vertices, one per row, shape (n,dim) [m].
template <int dim>
using Positions = Eigen::Matrix<double, Eigen::Dynamic, dim, Eigen::RowMajor>;

/// A membrane at rest.
struct Membrane
{
  meshes::Points vertices;                  ///< (n,2) rest positions [m]; empty of a sewn cloth
  meshes::Triangles triangles;              ///< (m,3)
  std::vector<RestTriangle> rest;           ///< (m)
  std::vector<int> phase;                   ///< (m) index into stiffness
  std::vector<MembraneStiffness> stiffness; ///< Voigt 11, 22, 12, engineering shear [N/m]
  /// One per phase, of the strain of the phase's law; empty: the energy is quadratic.
  std::vector<GuardedCubic> cubic;
  std::vector<meshes::YarnAxes> yarns; ///< one per phase; empty: all are corotational
};

/// Prepares the rest state of a membrane, mesh.material being the phase of each triangle.
/// @param stiffness one symmetric positive definite matrix per phase [N/m]
/// @throws BadInput with all faults: indices, coordinates or stiffness that are not finite,
///   triangles without positive area, phases out of range, a stiffness that is not symmetric
///   positive definite
Membrane membrane(const meshes::TriangleMesh &mesh, const std::vector<Eigen::Matrix3d> &stiffness);

/// The same of a cloth sewn from panels: triangles connect vertices in space, vertices are left
/// empty.
Membrane membrane(const meshes::ClothMesh &cloth, const std::vector<Eigen::Matrix3d> &stiffness);

/// Adds a cubic energy to that of each phase, guarded where it cannot be trusted
/// (guarded_cubic.h).
/// @param energies W3, one per phase [N/m]; none: the membrane is left as it is
/// @throws BadInput where their number is wrong, or one is not finite
void add_cubic_energy(Membrane &membrane, const std::vector<meshes::CubicForm> &energies);

/// Gives the phases whose stiffness has axes the law of yarns (yarn_energy.h). One that is alike in
/// all directions stays corotational; where every phase is so, nothing changes.
/// @throws BadInput where the membrane has a cubic energy, which is one of the Biot strain
void take_yarn_law(Membrane &membrane);

/// Total energy, sum of area times W [J].
/// @param positions (n,dim) [m]
template <int dim>
double membrane_energy(const Membrane &membrane, const Positions<dim> &positions);

/// Gradient of the energy, with the scales that make its smallness a question without units.
template <int dim>
struct MembraneGradient
{
  Positions<dim> gradient;   ///< (n,dim) [N]; the elastic forces are its negative
  Eigen::VectorXd magnitude; ///< (n) sum of |element forces| at each vertex [N]
  Eigen::VectorXd round_off; ///< (n) change of the forces when positions move by one rounding [N]
  double energy_round_off = 0.; ///< change of the energy when positions move by one rounding [J]
};

/// Gradient of membrane_energy(); every triangle's contributions sum to zero.
template <int dim>
MembraneGradient<dim> membrane_gradient(const Membrane &membrane, const Positions<dim> &positions);

/// K u, the gradient of the small-strain energy ½ u·K u with K the Hessian at rest.
/// @param displacement u (n,2) [m]
/// @return (n,2) [N]
Positions<2> linear_membrane_gradient(const Membrane &membrane, const Positions<2> &displacement);

/// Gradient and Hessian of the energy of one triangle, its cubic part left out, in one pass.
/// @param corners (3,dim) [m]
template <int dim>
TriangleDerivatives<dim> membrane_triangle_derivatives(const Membrane &membrane, int triangle,
                                                       const Eigen::Matrix<double, 3, dim> &corners,
                                                       Hessian kind);

/// The Hessian of the energy of one triangle; component i of corner k is unknown k dim + i.
/// @return (3 dim, 3 dim) [N/m]
template <int dim>
Eigen::Matrix<double, 3 * dim, 3 * dim> membrane_hessian(const Membrane &membrane, int triangle,
                                                         const Positions<dim> &positions,
                                                         Hessian kind);

/// Adds the Hessian of membrane_energy() to a matrix over the free vertices.
/// @param matrix whose elements are the membrane's triangles
void add_membrane_hessian(const Membrane &membrane, const Positions<2> &positions, Hessian kind,
                          PlaneMatrix &matrix);

/// Index of the first vertex with a component that is not finite, −1 where there is none.
template <int dim>
int first_not_finite(const Positions<dim> &positions);
} // namespace homespun::shell
