// SPDX-License-Identifier: MIT
#include "shell/rigid_motion.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

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
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(inertia);
  Eigen::Vector3d spin = eigen.eigenvectors().transpose() * angular_momentum.transpose();
  // Below round-off of the largest moment of inertia the body is a line, which cannot spin about itself.
  const double smallest = 16. * std::numeric_limits<double>::epsilon() * eigen.eigenvalues()(2);
  for (int k = 0; k < 3; ++k)
    spin(k) = eigen.eigenvalues()(k) > smallest ? spin(k) / eigen.eigenvalues()(k) : 0.;
  return (eigen.eigenvectors() * spin).transpose();
}

void add_spin(const Eigen::VectorXd &masses, const Vectors &positions,
              const Eigen::RowVector3d &spin, Vectors &velocities)
{
  const Eigen::RowVector3d centre = centre_of_mass(masses, positions);
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    velocities.row(i) += spin.cross(positions.row(i) - centre);
}

Vectors moved_rigidly(const Eigen::VectorXd &masses, const Vectors &positions,
                      const Vectors &velocities, const double h)
{
  const Eigen::RowVector3d centre = centre_of_mass(masses, positions),
                           L      = angular_momentum(masses, positions, velocities),
                           moved  = centre + h * (masses.transpose() * velocities) / masses.sum();
  const auto turned               = [&](const Eigen::RowVector3d &rotation) -> Vectors
  {
    const double angle = rotation.norm();
    if (angle == 0.)
      return positions;
    const Eigen::AngleAxisd turn(angle, rotation.transpose() / angle);
    return ((positions.rowwise() - centre) * turn.toRotationMatrix().transpose()).rowwise() +
           centre;
  };
  Eigen::RowVector3d spin = spin_of(masses, positions, L);
  for (int k = 0; k < 3; ++k)
    spin = spin_of(masses, turned(0.5 * h * spin), L);
  return turned(h * spin).rowwise() + (moved - centre);
}
} // namespace homespun::shell
