// SPDX-License-Identifier: MIT
// Stress cases of a cell that is another description of the same cloth: cut elsewhere, moved,
// repeated, turned, mirrored, in other units.
#include "verification/extremes/stress_cell_group.h"
#include "verification/record/number_text.h"

#include <cmath>

namespace homespun::verification
{
namespace
{
/// The same cloth from another place of the sheet. A hole must lie inside of the cell: what cuts
/// one is refused.
void cut_elsewhere(CellGroup &group, const std::string &what, const UnitCell &moved,
                   const Eigen::RowVector2d &origin, const UnitCell &original,
                   const Eigen::Matrix2d &Q)
{
  const std::string of = "; " + original.name;
  if (cuts_a_hole(moved, origin))
    group.refused(what + "; through a hole" + of, "no periodic image", shifted(moved, origin));
  else
    group.finite(what + of, "the same cloth", limit_of(original), to_original,
                 [=]() { return against(shifted(moved, origin), original, Q); });
}
} // namespace

std::vector<StressCase> symmetry_cases(const std::vector<UnitCell> &cells)
{
  std::vector<StressCase> cases;
  CellGroup group("cell symmetry", cases);
  const Eigen::Matrix2d as_it_was = Eigen::Matrix2d::Identity();
  for (const UnitCell &cell : cells)
  {
    const std::string of = "; " + cell.name;
    const Limit limit    = limit_of(cell);
    for (const auto &[f1, f2] : {std::pair{0.5, 0.}, {0.25, 0.5}, {0.3125, 0.6875}})
    {
      cut_elsewhere(group, "cut elsewhere; by " + short_text(f1) + " and " + short_text(f2), cell,
                    {f1, f2}, cell, as_it_was);
    }
    for (const double far : {1e2, 1e4})
    {
      UnitCell away = cell;
      away.mesh.vertices.rowwise() +=
        far * Eigen::RowVector2d(1., 0.7) * std::sqrt(cell.lattice.area());
      // Coordinates lose so many digits, edges as many more as they are shorter than the cell.
      const double lost = far * std::sqrt(cell.mesh.n_triangles()) * 1e-15;
      group.finite("moved by " + short_text(far) + " cells" + of, "the same cloth",
                   {limit.value + 10. * lost,
                    limit.derivation +
                      "; and ten roundings of an energy for the digits that the coordinates of an "
                      "edge lose so far away"},
                   to_original, [=]() { return against(away, cell, as_it_was); });
    }
    for (const auto &[n1, n2] : {std::pair{1, 1}, {2, 1}, {2, 2}, {3, 3}, {4, 4}})
      group.finite("repeated " + std::to_string(n1) + " x " + std::to_string(n2) + of,
                   "the same cloth", limit, to_original,
                   [=, n1 = n1, n2 = n2]()
                   { return against(repeated(cell, n1, n2), cell, as_it_was); });
    for (const double angle : {15., 45., 90., 180.})
      group.finite("turned by " + short_text(angle) + " degrees" + of, "C^H turns with the cell",
                   limit, to_original,
                   [=]() { return against(turned(cell, angle), cell, turn(angle)); });
    const Eigen::Matrix2d mirror = Eigen::Vector2d(-1., 1.).asDiagonal();
    group.finite("mirrored" + of, "C^H is mirrored", limit, to_original,
                 [=]() { return against(mirrored(cell), cell, mirror); });
    cut_elsewhere(group, "mirrored; turned by 30 degrees; cut elsewhere",
                  turned(mirrored(cell), 30.), {0.4375, 0.3125}, cell, turn(30.) * mirror);
    UnitCell inside_out = cell;
    inside_out.mesh.vertices.col(0) *= -1.;
    inside_out.lattice.vectors.col(0) *= -1.;
    group.refused("mirrored; triangles left clockwise" + of, "inverted", inside_out);
  }
  return cases;
}

std::vector<StressCase> unit_cases(const std::vector<UnitCell> &cells)
{
  std::vector<StressCase> cases;
  struct Units
  {
    const char *name;
    double length, thickness, modulus;
  };
  // A length of 1 m is 1000 mm; 1 Pa is 1e-9 GPa.
  constexpr Units units[] = {{"mm and Pa", 1e3, 1e3, 1.},
                             {"cm and Pa", 1e2, 1e2, 1.},
                             {"m and GPa", 1., 1., 1e-9},
                             {"mm and GPa", 1e3, 1e3, 1e-9},
                             {"mm in the plane alone", 1e3, 1., 1.},
                             {"km and Pa", 1e-3, 1e-3, 1.},
                             {"nm and nPa", 1e9, 1e9, 1e9}};
  CellGroup group("cell units", cases);
  for (const UnitCell &cell : cells)
    for (const Units &unit : units)
      group.finite(std::string(unit.name) + "; " + cell.name, "the same cloth", limit_of(cell),
                   "largest relative energy difference to that in m and Pa [-]",
                   [=]()
                   {
                     return against(in_units(cell, unit.length, unit.thickness, unit.modulus), cell,
                                    Eigen::Matrix2d::Identity(), unit.thickness * unit.modulus);
                   });
  return cases;
}
} // namespace homespun::verification
