// SPDX-License-Identifier: MIT
// A scene as the user describes it: which cloth of which cells, which terms act on it, what is held
// and how it moves, how time goes on. Read from a .prm file; all faults are reported at once. A
// term that is not listed does not exist in the run, and a key that belongs to it is a fault.
#pragma once

#include "shell/solver/cloth.h"
#include "shell/terms/bending.h"
#include "verification/drape/scene/held_place.h"

#include <Eigen/Core>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace homespun::verification
{
struct SceneObstacle
{
  std::string kind; ///< plane, sphere, mesh
  std::vector<double>
    numbers;        ///< plane: point and normal; sphere: centre and radius; mesh: its offset
  std::string file; ///< of a mesh
};

enum class TimeIntegration
{
  linearly_implicit,
  implicit,
  conserving,
  equilibria ///< a static equilibrium at each frame
};

struct Scene
{
  std::string name, file, story;
  std::vector<std::string> cell_files;
  std::set<std::string> terms;

  int n1 = 20, n2 = 20;                                   ///< cells of a sheet
  std::string mesh_file;                                  ///< of a garment; empty: a sheet
  double vt_unit            = 1.;                         ///< [m]
  bool standing             = true;                       ///< sheet in the x-z plane, else in x-y
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero(); ///< of the sheet [m]
  double disturbance        = 0.; ///< height of a smooth bump out of the plane at the beginning [m]

  TimeIntegration integration = TimeIntegration::linearly_implicit;
  double time_step = 0.01, duration = 1., frame_interval = 0.05; ///< [s]

  Eigen::RowVector3d gravity = {0., 0., -9.81};         ///< [m/s^2]
  double damping_rate = 0., viscosity = 0.;             ///< [1/s], [s]
  std::optional<shell::PlateStiffness> bending;         ///< [N m]; nothing: that of the cell
  Eigen::RowVector3d wind = Eigen::RowVector3d::Zero(); ///< [m/s]
  double air_density = 1.2, drag = 1., pressure = 0.;   ///< [kg/m^3], [-], [Pa]
  std::vector<HeldPlace> held;
  std::vector<SceneObstacle> obstacles;
  double friction = 0., contact_thickness = 1e-3; ///< [-], [m]

  std::map<std::string, std::string> echo; ///< every key with the value that was used

  bool has(const std::string &term) const
  {
    return terms.count(term) != 0;
  }
  bool is_sheet() const
  {
    return mesh_file.empty();
  }
};

/// The terms that a scene can have, in the order of reports, with what each is.
const std::vector<std::pair<std::string, std::string>> &all_terms();

/// @throws BadInput with one message per fault
Scene read_scene(const std::string &file);

/// The documented keys of a scene file, in deal.II's .prm syntax.
std::string scene_keys();
} // namespace homespun::verification
