// SPDX-License-Identifier: MIT
#include "shell/solver/rigid_motion.h"

#include "meshes/plain/symmetric_eigen.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace homespun::shell
{
Eigen::RowVector3d centre_of_mass(const Eigen::VectorXd &masses, const Vectors &positions)
{
  return masses.transpose() * positions / masses.sum();
}

Eigen::RowVector3d angular_momentum(const Eigen::VectorXd &masses, const Vectors &positions,
                                    const Vectors &velocities)
{
  const Eigen::RowVector3d centre = centre_of_mass(masses, positions);
  Eigen::RowVector3d sum          = Eigen::RowVector3d::Zero();
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    sum += masses(i) * (positions.row(i) - centre).cross(velocities.row(i));
  return sum;
}

Eigen::RowVector3d spin_of(const Eigen::VectorXd &masses, const Vectors &positions,
                           const Eigen::RowVector3d &angular_momentum)
{
  const Eigen::RowVector3d centre = centre_of_mass(masses, positions);
  Eigen::Matrix3d inertia         = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
  {
    const Eigen::RowVector3d arm = positions.row(i) - centre;
    inertia +=
      masses(i) * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm.transpose() * arm);
  }
  const auto eigen     = meshes::symmetric_eigen<3>(inertia);
  Eigen::Vector3d spin = eigen.vectors.transpose() * angular_momentum.transpose();
  // Below round-off of the largest moment of inertia the body is a line, which cannot spin about
  // itself.
  const double smallest = 16. * std::numeric_limits<double>::epsilon() * eigen.values(2);
  for (int k = 0; k < 3; ++k)
    spin(k) = eigen.values(k) > smallest ? spin(k) / eigen.values(k) : 0.;
  return (eigen.vectors * spin).transpose();
}

Vectors moved_rigidly(const Eigen::VectorXd &masses, const Vectors &positions,
                      const Vectors &velocities, const double h, const RigidStep kind)
{
  const Eigen::RowVector3d centre = centre_of_mass(masses, positions),
                           spin   = spin_of(masses, positions,
                                            angular_momentum(masses, positions, velocities)),
                           moved  = centre + h * (masses.transpose() * velocities) / masses.sum();
  if (spin.norm() == 0.)
    return positions.rowwise() + (moved - centre);
  const double angle = kind == RigidStep::midpoint ? 2. * std::atan(0.5 * h * spin.norm())
                                                   : std::atan(h * spin.norm());
  const Eigen::AngleAxisd turn(angle, spin.transpose().normalized());
  return ((positions.rowwise() - centre) * turn.toRotationMatrix().transpose()).rowwise() + moved;
}
} // namespace homespun::shell
