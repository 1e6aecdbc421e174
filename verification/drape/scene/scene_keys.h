// SPDX-License-Identifier: MIT
// The keys of a scene file with their defaults and documentation; scene.h says what is made of
// them.
#pragma once

#include "homogenization/cell/parameter_keys.h"

#include <map>
#include <string>

namespace homespun::verification
{
/// The keys of a scene file; every key is said here once.
struct SceneKeys
{
  std::string story, cells, terms = "membrane, gravity, pins";
  std::string sheet_cells = "20 20", mesh, vt_unit = "1", placement = "standing", centre = "0 0 0",
              disturbance = "0";
  std::string integrator = "linearly implicit", time_step = "0.01", duration = "1",
              frame_interval = "0.05";
  std::string gravity = "0 0 -9.81", damping = "0", viscosity = "0", bending = "cell",
              wind = "0 0 0", air_density = "1.2", drag = "1", pressure = "0", pins, handles,
              obstacles, friction = "0", thickness = "0.001";

  /// Declares all keys.
  /// @param term_of receives the term that a key belongs to
  void declare(homogenization::ParameterKeys &keys, std::map<std::string, std::string> &term_of);
};
} // namespace homespun::verification
