// SPDX-License-Identifier: MIT
#include "verification/drape/held_forces.h"

#include <cmath>

namespace homespun::verification
{
std::vector<HeldForce> held_forces(const HeldMotion &motion, const HeldCloth &cloth)
{
  std::vector<HeldForce> forces;
  for (const std::string &name : motion.names())
    forces.push_back({name});
  for (const int v : motion.vertices(cloth.mesh))
  {
    Eigen::RowVector3d force = cloth.gradient.row(v);
    if (std::isfinite(cloth.step))
    {
      const auto at = [&](const int steps_before)
      { return motion.position(v, cloth.mesh, cloth.time - steps_before * cloth.step); };
      force += cloth.masses(v) * (at(0) - 2. * at(1) + at(2)) / (cloth.step * cloth.step);
    }
    forces[static_cast<std::size_t>(motion.place_of_vertex(v, cloth.mesh))].force += force;
  }
  return forces;
}
} // namespace homespun::verification
