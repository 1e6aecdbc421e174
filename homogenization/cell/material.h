// SPDX-License-Identifier: MIT
// The phases of a unit cell and their stiffness in plane stress, as membranes and as plates.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace homespun::homogenization
{
/// How a phase bends that is no single layer.
struct Plate
{
  double E;       ///< Young's modulus of a single layer of its thickness that bends as it does [Pa]
  double nu;      ///< and its Poisson's ratio
  double neutral; ///< height of the surface that bending does not stretch, above the lower face [m]
};

/// One material of a unit cell. An isotropic phase has E1 = E2 = E, nu12 = nu,
/// G12 = E / (2 (1 + nu)).
struct Phase
{
  std::string name;
  double E1                  = 0.; ///< Young's modulus along its first axis [Pa]
  double E2                  = 0.; ///< Young's modulus along its second axis [Pa]
  double nu12                = 0.; ///< contraction along 2 under stress along 1
  double G12                 = 0.; ///< shear modulus [Pa]
  double angle               = 0.; ///< from the x axis to its first axis [deg]
  double thickness           = 0.; ///< [m]
  double density             = 0.; ///< [kg/m^3]
  std::optional<Plate> plate = {}; ///< of several layers
};

/// An isotropic phase from Young's modulus [Pa] and Poisson's ratio.
Phase isotropic(const std::string &name, double E, double nu, double thickness, double density);

/// An isotropic layer of a phase.
struct Layer
{
  double thickness, E, nu; ///< [m], [Pa], [-]
};

/// The phase of isotropic layers that stick together. Its A = sum t Q, B = sum t z Q and D = sum
/// (t z² + t³/12) Q, z the height of a layer's middle, are isotropic, and so is what bends without
/// a force in its plane, D − B A^-1 B; in terms of a11 + a12 and a11 − a12 all products are those
/// of numbers.
/// @param layers from the lower face up
/// Source: J. N. Reddy, Mechanics of Laminated Composite Plates and Shells, 2004, section 3.3.
Phase layered(const std::string &name, const std::vector<Layer> &layers, double density);

/// |B|/sqrt(A D) of the entries 11 of a phase about the neutral surface of another one, where the
/// lower faces of both lie in one plane: 0 where the plane and bending are apart, at most 1.
double coupling(const Phase &phase, const Phase &other);

/// Thickness times the plane-stress stiffness, c = t Q(angle).
///
/// In its own axes Q11 = E1/(1 − nu12 nu21), Q22 = E2/(1 − nu12 nu21), Q12 = nu12 Q22, Q66 = G12,
/// with nu21 = nu12 E2/E1; turned by the angle as c_ab = T_ap Q_pq T_bq.
/// @return (3,3) [N/m], Voigt order 11, 22, 12 with engineering shear
Eigen::Matrix3d plane_stress_stiffness(const Phase &phase);

/// Stiffness of the phase as a thin plate about its own neutral surface, of a single layer t^2/12
/// c: t^3/12 Q(angle).
/// @return (3,3) [N m], moments 11, 22, 12 of the curvatures kappa11, kappa22, 2 kappa12
Eigen::Matrix3d bending_stiffness(const Phase &phase);

/// The matrix T that turns a stiffness in Voigt order by an angle: C' = T C T^T.
/// @param angle from the old to the new first axis of the material [rad]
Eigen::Matrix3d stiffness_rotation(double angle);

/// What makes a phase impossible, each as a sentence that names the phase; empty where it is sound:
/// moduli, thickness and density that are not positive, |nu| >= 1, an orthotropic law whose energy
/// is not positive (nu12^2 >= E1/E2).
std::vector<std::string> faults_of(const Phase &phase);
} // namespace homespun::homogenization
