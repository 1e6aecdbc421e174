// SPDX-License-Identifier: MIT
// What stands in a Wavefront OBJ file, line by line, before anything is made of it. What
// obj_file, polygons and cells are made of.
#pragma once

#include <array>
#include <map>
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
  std::vector<int> group_of_face;            ///< 0 of faces without
  /// From 1 on; a face is of the material (`usemtl`) above it, else of the group (`g`).
  std::map<std::string, int> number_of_group;
  std::set<std::string> passed_over; ///< keywords of ARCSim
};

/// Whether faces without vt are a fault.
enum class NeedsVt
{
  no,
  yes
};

/// Reads `v`, `vt`, `f` and groups; see obj_file.h.
/// @throws BadInput with the faults of all lines
ObjContent read_obj(const std::string &file, NeedsVt needs_vt);
} // namespace homespun::meshes
