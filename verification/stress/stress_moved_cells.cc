// SPDX-License-Identifier: MIT
#include "verification/stress/stress_moved_cells.h"

#include "homogenization/cell/material.h"
#include "meshes/plain/sheet.h"
#include "verification/cell/energy_order.h"
#include "verification/record/number_text.h"

#include <Eigen/Geometry>

#include <cmath>

namespace homespun::verification
{
namespace
{
// A length of 1 m is 1000 mm; 1 Pa is 1e-9 GPa.
constexpr Units all_units[] = {{"mm and Pa", 1e3, 1e3, 1.},
                               {"cm and Pa", 1e2, 1e2, 1.},
                               {"m and GPa", 1., 1., 1e-9},
                               {"mm and GPa", 1e3, 1e3, 1e-9},
                               {"mm in the plane alone", 1e3, 1., 1.},
                               {"km and Pa", 1e-3, 1e-3, 1.},
                               {"nm and nPa", 1e9, 1e9, 1e9}};

Eigen::Matrix2d turn(const double degrees)
{
  return Eigen::Rotation2Dd(degrees * M_PI / 180.).toRotationMatrix();
}
} // namespace

UnitCell repeated(const UnitCell &cell, const int n1, const int n2)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n1, n2);
  UnitCell larger           = cell;
  larger.mesh               = sheet.mesh;
  larger.lattice.vectors    = sheet.sides();
  return larger;
}

UnitCell mapped(const UnitCell &cell, const Eigen::Matrix2d &A)
{
  UnitCell other        = cell;
  other.mesh.vertices   = cell.mesh.vertices * A.transpose();
  other.lattice.vectors = cell.lattice.vectors * A.transpose();
  if (A.determinant() < 0.)
  {
    other.mesh.triangles.col(1).swap(other.mesh.triangles.col(2));
    other.lattice.vectors.row(0).swap(other.lattice.vectors.row(1)); // a1 x a2 > 0 again
  }
  for (Phase &phase : other.phases)
  {
    const Eigen::Vector2d axis = A * turn(phase.angle).col(0);
    phase.angle                = std::atan2(axis(1), axis(0)) * 180. / M_PI;
  }
  return other;
}

UnitCell in_units(const UnitCell &cell, const Units &units)
{
  UnitCell other = mapped(cell, units.length * Eigen::Matrix2d::Identity());
  for (Phase &phase : other.phases)
  {
    phase.thickness *= units.thickness;
    for (double *value : {&phase.E1, &phase.E2, &phase.G12})
      *value *= units.modulus;
  }
  return other;
}

std::vector<StressCase> moved_cell_cases(const UnitCell &cell)
{
  std::vector<StressCase> cases;
  Limit limit = limit_of(cell, "largest relative energy difference to the moved C^H of the "
                               "cell as it was [-]");
  // T turns or mirrors a stiffness, C' = T C T^T.
  const auto add = [&](const char *group, const std::string &what, const Eigen::Matrix3d &T,
                       const std::function<UnitCell()> &moved, const double factor)
  {
    cases.emplace_back(
      group, what + "; " + cell.name, "finite; the same cloth", limit, Repeats::twice,
      [=](unsigned int) -> StressAnswer
      {
        const Eigen::Matrix3d found = solved(moved()).stiffness, before = solved(cell).stiffness;
        return {energy_difference(found / factor, T * before * T.transpose()), found};
      });
  };
  const auto is_symmetric =
    [&](const std::string &what, const Eigen::Matrix3d &T, const std::function<UnitCell()> &moved)
  { add("cell symmetry", what, T, moved, 1.); };

  const Eigen::Matrix3d as_it_was = Eigen::Matrix3d::Identity();
  for (const auto &[n1, n2] : {std::pair{2, 1}, {2, 2}, {3, 3}, {4, 4}})
    is_symmetric("repeated " + std::to_string(n1) + " x " + std::to_string(n2), as_it_was,
                 [=, n1 = n1, n2 = n2]() { return repeated(cell, n1, n2); });
  for (const double angle : {15., 45., 90., 180.})
    is_symmetric("turned by " + short_text(angle) + " degrees",
                 homogenization::stiffness_rotation(angle * M_PI / 180.),
                 [=]() { return mapped(cell, turn(angle)); });
  is_symmetric("mirrored", Eigen::Vector3d(1., 1., -1.).asDiagonal(),
               [=]() { return mapped(cell, Eigen::Vector2d(-1., 1.).asDiagonal()); });
  for (const Units &units : all_units)
    add(
      "cell units", units.name, as_it_was, [=]() { return in_units(cell, units); },
      units.thickness * units.modulus);
  // Coordinates lose so many digits, edges as many more as they are shorter than the cell.
  const Limit near = limit;
  limit.derivation += "; and ten roundings of an energy for the digits that the coordinates of an "
                      "edge lose so far away";
  for (const double far : {1e2, 1e4})
  {
    limit.value   = near.value + 10. * far * std::sqrt(cell.mesh.n_triangles()) * 1e-15;
    UnitCell away = cell;
    away.mesh.vertices.rowwise() +=
      far * Eigen::RowVector2d(1., 0.7) * std::sqrt(cell.lattice.area());
    is_symmetric("moved by " + short_text(far) + " cells", as_it_was, [=]() { return away; });
  }
  return cases;
}
} // namespace homespun::verification
