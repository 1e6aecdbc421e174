// SPDX-License-Identifier: MIT
// What stands in a Wavefront OBJ file, line by line, before anything is made of it. Private to
// obj_file and polygons.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

namespace homespun::meshes
{
/// A corner of a face, from 0; −1: no vt.
struct ObjCorner
{
  int v, vt;
};

struct ObjContent
{
  std::vector<std::array<double, 3>> v;
  std::vector<std::array<double, 2>> vt;
  std::vector<std::vector<ObjCorner>> faces; ///< three or four corners
  std::set<std::string> passed_over;         ///< keywords of ARCSim
};

/// Whether faces without vt are a fault.
enum class NeedsVt
{
  no,
  yes
};

/// Reads `v`, `vt` and `f`; see obj_file.h.
/// @throws BadInput with the faults of all lines
ObjContent read_obj(const std::string &file, NeedsVt needs_vt);
} // namespace homespun::meshes
