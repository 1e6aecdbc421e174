// SPDX-License-Identifier: MIT
#include "verification/drape/scene/scene_keys.h"

#include "verification/drape/scene/fabrics.h"

namespace homespun::verification
{
void SceneKeys::declare(homogenization::ParameterKeys &keys,
                        std::map<std::string, std::string> &term_of)
{
  const auto add =
    [&](const char *key, std::string &value, const std::string &text, const char *term = "")
  {
    keys.add(key, value, text);
    if (*term)
      term_of[key] = term;
  };
  add("Story", story, "What the scene shows, one line.");
  add("Cells", cells, "Cell files, comma-separated, relative to this file.");
  add("Terms", terms,
      "What acts on the cloth, comma-separated: membrane, gravity, bending, damping, wind, pins, "
      "handles, obstacles, friction. What is not listed is left out and costs nothing.");
  add("Sheet cells", sheet_cells,
      "Unit cells along the first and second side of a sheet; two coarse triangles per cell.");
  add("Mesh", mesh, "A garment in place of a sheet: an OBJ file with `vt`, relative to this file.");
  add("Rest coordinate unit", vt_unit, "Metres per unit of `vt` [m].");
  add("Placement", placement, "`standing` (rest x, y to x, z) or `lying` (to x, y).");
  add("Centre", centre, "Of the sheet at the beginning: x y z [m].");
  add("Disturbance", disturbance,
      "Height of a smooth bump out of the plane of the sheet at the beginning [m].");
  add("Integrator", integrator,
      "`linearly implicit` or `implicit` (Euler: of first order, a spin is damped), `conserving` "
      "(of second order; keeps momenta and energy; no wind, no obstacles), or `static` (an "
      "equilibrium at each frame).");
  add("Time step", time_step, "[s], positive.");
  add("Duration", duration, "[s], positive.");
  add("Frame interval", frame_interval, "Time between frames [s], a multiple of the time step.");
  add("Gravity", gravity, "Acceleration x y z [m/s^2].", "gravity");
  add("Damping rate", damping, "Force per momentum: -alpha m v [1/s].", "damping");
  add("Viscosity", viscosity,
      "Stress per rate of strain, in units of the stiffness [s]. References of deal.II do not have "
      "it.",
      "damping");
  add(
    "Bending stiffness", bending,
    "`cell`: D^H of the cell, all six entries; or of the plate [N m]: one number (isotropic, nu = "
    "0), D11 D22 D12 D66, or D11 D22 D12 D66 D16 D26; or a measured fabric (D12 = 0): " +
      names_of_fabrics() + ".",
    "bending");
  add("Wind velocity", wind, "x y z [m/s].", "wind");
  add("Air density", air_density, "[kg/m^3].", "wind");
  add("Drag coefficient", drag, "Of the normal component [-].", "wind");
  add("Pressure", pressure, "On the side that the normal leaves, follower load [Pa].", "wind");
  add(
    "Pins", pins,
    "Places that stay, separated by `;`: left, right, bottom, top (edges of a sheet), top left "
    "and so on (corners), waist (the highest vertices of a garment), vertices 0 1 2 (of the coarse "
    "cloth).",
    "pins");
  add("Handles", handles,
      "Places that move, `place: translate dx dy dz during s` or `place: rotate degrees about ax "
      "ay az during s` (about the centre of the place), separated by `;`.",
      "handles");
  add("Obstacles", obstacles,
      "`plane px py pz nx ny nz`, `sphere cx cy cz radius`, `mesh file.obj dx dy dz`, separated "
      "by `;`.",
      "obstacles");
  add("Friction coefficient", friction, "Of Coulomb friction on all obstacles [-].", "friction");
  add("Contact thickness", thickness, "Distance at which an obstacle begins to push [m].",
      "obstacles");
}
} // namespace homespun::verification
