// SPDX-License-Identifier: MIT
// The frames of another program's simulation, as files: which, by what name, and whether each is a
// frame of the rest mesh.
#pragma once

#include "meshes/files/polygons.h"

#include <set>
#include <string>
#include <vector>

namespace homespun::verification
{
struct FrameFile
{
  std::string file; ///< .obj or .ply
  std::string name; ///< without folder and ending: that of what is made of it
};

/// Whether one name comes before another, numbers in them by their value: frame_2 before frame_10.
bool comes_before(const std::string &one, const std::string &other);

/// Files, and patterns such as `sim/frame_*.obj`, whose files come in the order of
/// comes_before().
/// @throws BadInput where a pattern fits no file, or two files have one name
std::vector<FrameFile> frames_of(const std::vector<std::string> &files_and_patterns);

/// Why a mesh is no frame of another; empty where it is.
///
/// It must have as many vertices, and the same faces with the same corners in the same order.
/// @param name, rest_name files, for the message
std::string fault_of_frame(const meshes::Polygons &frame, const std::string &name,
                           const meshes::Polygons &rest, const std::string &rest_name);

/// A note where single precision, in which positions are up-sampled, is a ten-thousandth of a
/// cell's side or more; else empty.
/// @param farthest coordinate [m]
std::string note_on_place(double farthest, double side);

/// A note on lines of frames that were not read; empty where there are none.
std::string note_on_keywords(const std::set<std::string> &passed_over);
} // namespace homespun::verification
