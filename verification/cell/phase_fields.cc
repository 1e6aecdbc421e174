// SPDX-License-Identifier: MIT
#include "verification/cell/phase_fields.h"

#include "meshes/plain/symmetric_eigen.h"


#include <array>
#include <cmath>
#include <string>

namespace homespun::verification
{
using homogenization::UnitStrains;

namespace
{
/// One field of one macro strain with its principal vectors.
void append(const std::string &name, const std::string &components, const std::string &unit,
            const Eigen::MatrixX3d &field, const double part_of_12,
            std::vector<meshes::VertexData> &data)
{
  std::array<meshes::FloatPoints, 2> principal;
  principal.fill(meshes::FloatPoints::Zero(field.rows(), 3));
  for (Eigen::Index t = 0; t < field.rows(); ++t)
  {
    const Eigen::Matrix2d both =
      principal_vectors({field(t, 0), field(t, 1), part_of_12 * field(t, 2)});
    for (int k = 0; k < 2; ++k)
      principal[static_cast<std::size_t>(k)].row(t).head<2>() = both.row(k).cast<float>();
  }
  data.push_back({name + " (" + components + ") " + unit, field.cast<float>()});
  data.push_back({name + " principal 1 " + unit, principal[0]});
  data.push_back({name + " principal 2 " + unit, principal[1]});
}
} // namespace

UnitStrains phase_stresses(const homogenization::UnitCell &cell, const UnitStrains &strains)
{
  const std::vector<Eigen::Matrix3d> c = cell.stiffness_of_phase();
  UnitStrains stresses(strains.rows(), 9);
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    for (int a = 0; a < 3; ++a)
      stresses.row(t).segment<3>(3 * a) = c[static_cast<std::size_t>(cell.mesh.material(t))] *
                                          strains.row(t).segment<3>(3 * a).transpose();
  return stresses;
}

Eigen::Matrix2d principal_vectors(const Eigen::Vector3d &components)
{
  Eigen::Matrix2d tensor;
  tensor << components(0), components(2), components(2), components(1);
  const auto principal = meshes::symmetric_eigen<2>(tensor);
  Eigen::Matrix2d vectors;
  for (int k = 0; k < 2; ++k)
  {
    const Eigen::Vector2d along = principal.vectors.col(1 - k);
    // Which way a vertical one points must not hang on the round-off of its first component.
    constexpr double vertical = 1e-6;
    const bool is_turned =
      along(0) < -vertical || (std::abs(along(0)) <= vertical && along(1) < 0.);
    vectors.row(k) = (is_turned ? -1. : 1.) * principal.values(1 - k) * along.transpose();
  }
  return vectors;
}

std::vector<meshes::VertexData> phase_field_data(const homogenization::UnitCell &cell,
                                                 const UnitStrains &strains)
{
  const UnitStrains stresses                 = phase_stresses(cell, strains);
  const std::array<const char *, 3> of_loads = {"11", "22", "12"};
  std::vector<meshes::VertexData> data;
  for (int a = 0; a < 3; ++a)
  {
    const std::string load = of_loads[static_cast<std::size_t>(a)];
    append("strain_" + load, "11, 22, 2x12", "[-]", strains.middleCols<3>(3 * a), 0.5, data);
    append("stress_" + load, "11, 22, 12", "[N/m]", stresses.middleCols<3>(3 * a), 1., data);
  }
  return data;
}
} // namespace homespun::verification
