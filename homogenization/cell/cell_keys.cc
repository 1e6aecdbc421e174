// SPDX-License-Identifier: MIT
#include "homogenization/cell/cell_keys.h"

#include "meshes/plain/errors.h"

#include <Eigen/LU>

namespace homespun::homogenization
{
void CellKeys::declare(ParameterKeys &keys)
{
  keys.add(
    "Mesh", mesh,
    "Mesh of one periodic cell, a file in the folder of this one or below, with triangles or "
    "quadrilaterals: .msh, .vtk, .vtu, .ucd, .inp, .unv, .med, .obj (whose groups are those of "
    "`usemtl`, else of `g`) or any other that meshio reads.");
  keys.add("Length unit", length_unit,
           "Metres per mesh unit [m], positive; 0.01 for a mesh in centimetres.");
  keys.add("Young's modulus", young,
           "[Pa] One value per group of the mesh, `group: value, ...`; a group is a physical name "
           "or number. A value without a name, which comes first, is that of all other groups; so "
           "it is in all keys of groups.");
  keys.add("Poisson's ratio", poisson, "[-] One value per group, strictly between -1 and 1.");
  keys.add("Thickness", thickness, "[m] One value per group.");
  keys.add("Density", density, "[kg/m^3] One value per group.");
  keys.add(
    "Orthotropic", orthotropic,
    "`group: E1 E2 nu12 G12 angle, ...` in [Pa], [Pa], [-], [Pa] and [deg] from the x axis to "
    "the first axis of the material; replaces Young's modulus and Poisson's ratio for that "
    "group. Cell data `angle` [deg] of the mesh, one value per triangle, is added.");
  keys.add("Layers", layers,
           "`group: t E nu, t E nu, ...` in [m], [Pa] and [-], from the lower face up: isotropic "
           "layers that stick together, as of a film on a fabric, with one lower face in all "
           "groups; replaces Young's modulus, Poisson's ratio and Thickness for that group.");
  keys.add(
    "Lattice vectors", lattice,
    "`auto` takes the parallelogram or hexagon around the drawing, else its bounding box; or "
    "`x1 y1; x2 y2` in mesh units, as wavy outlines need it.");
  keys.add("Matching tolerance", tolerance,
           "Points of opposite sides nearer than this are one, in units of the shorter lattice "
           "vector, 1e-12 to 1e-3. `auto`: 1e-7, or where coordinates are rounded to 11 digits or "
           "fewer four units of their last digit, at most 1e-4.");
  keys.add("Slits", slits,
           "`refused`: gaps much thinner than the triangles around them are faults of the mesh; "
           "`real`: they are meant, and wider than the matching tolerance.");
}

std::optional<meshes::Lattice> lattice_from(const std::string &file, const CellKeys &keys,
                                            const double length_unit, Faults &faults)
{
  meshes::Lattice lattice;
  if (trimmed(keys.lattice) == "auto")
    return std::nullopt;
  const std::vector<std::string> rows = split(keys.lattice, ';');
  bool good                           = rows.size() == 2;
  for (std::size_t r = 0; good && r < 2; ++r)
  {
    const auto row = numbers(rows[r]);
    good           = row && row->size() == 2;
    if (good)
      lattice.vectors.row(static_cast<Eigen::Index>(r)) << (*row)[0], (*row)[1];
  }
  if (!good)
    faults.push_back(file + ": key `Lattice vectors`: found `" + keys.lattice +
                     "`; expected `auto` or two vectors in mesh units like `1 0; 0.5 0.866`");
  lattice.vectors *= length_unit;
  if (!good)
    return std::nullopt;
  if (lattice.vectors.determinant() < 0.)
  {
    faults.push_back(
      file + ": key `Lattice vectors`: found `" + keys.lattice +
      "`, with the second vector to the right of the first; expected it to the left: exchange the "
      "two");
    return std::nullopt;
  }
  return lattice;
}

SideRules side_rules(const std::string &file, const CellKeys &keys, const double length_unit,
                     const double rounding, Faults &faults)
{
  SideRules rules;
  rules.rounding        = rounding * length_unit;
  rules.metres_per_unit = length_unit;
  if (trimmed(keys.tolerance) != "auto")
  {
    const auto given = numbers(keys.tolerance);
    if (given && given->size() == 1 && (*given)[0] >= 1e-12 && (*given)[0] <= 1e-3)
      rules.tolerance = (*given)[0];
    else
      faults.push_back(file + ": key `Matching tolerance`: found `" + keys.tolerance +
                       "`; expected `auto` or a number from 1e-12 to 1e-3, in units of the shorter "
                       "lattice vector" +
                       number_hint(keys.tolerance));
  }
  const std::string slits = trimmed(keys.slits);
  rules.slits             = slits == "real" ? Slits::real : Slits::refused;
  if (slits != "real" && slits != "refused")
    faults.push_back(file + ": key `Slits`: found `" + keys.slits +
                     "`; expected `refused` or `real`" + did_you_mean(slits, {"refused", "real"}));
  return rules;
}

std::string unit_cell_keys()
{
  CellKeys keys;
  ParameterKeys documented;
  keys.declare(documented);
  return documented.documented();
}
} // namespace homespun::homogenization
