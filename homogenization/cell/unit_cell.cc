// SPDX-License-Identifier: MIT
#include "homogenization/cell/unit_cell.h"

#include <map>

namespace homespun::homogenization
{
std::vector<Eigen::Matrix3d> UnitCell::stiffness_of_phase() const
{
  std::vector<Eigen::Matrix3d> stiffness;
  for (const Phase &phase : phases)
    stiffness.push_back(plane_stress_stiffness(phase));
  return stiffness;
}

std::vector<Eigen::Matrix3d> UnitCell::bending_stiffness_of_phase() const
{
  std::vector<Eigen::Matrix3d> stiffness;
  for (const Phase &phase : phases)
    stiffness.push_back(bending_stiffness(phase));
  return stiffness;
}

std::vector<int> UnitCell::group_of_phase() const
{
  std::map<std::string, int> group_of_name;
  std::vector<int> group;
  for (const Phase &phase : phases)
    group.push_back(
      group_of_name.emplace(phase.name, static_cast<int>(group_of_name.size())).first->second);
  return group;
}

std::vector<int> UnitCell::phase_of_group() const
{
  const std::vector<int> group = group_of_phase();
  std::vector<int> first;
  for (std::size_t p = 0; p < group.size(); ++p)
    if (group[p] == static_cast<int>(first.size()))
      first.push_back(static_cast<int>(p));
  return first;
}

double UnitCell::areal_density() const
{
  return areal_density(meshes::signed_areas(mesh));
}

double UnitCell::areal_density(const Eigen::VectorXd &areas) const
{
  double mass = 0.;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const Phase &phase = phases[static_cast<std::size_t>(mesh.material(t))];
    mass += areas(t) * phase.thickness * phase.density;
  }
  return mass / lattice.area();
}
} // namespace homespun::homogenization
