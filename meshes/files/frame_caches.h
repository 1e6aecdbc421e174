// SPDX-License-Identifier: MIT
// All frames of a moving surface in one file, for programs that draw: .pc2, the point cache that
// Blender's modifier "Mesh Cache" and 3ds Max read, and .usda, Universal Scene Description as text
// (openusd.org: UsdGeomMesh, UsdGeomSubset, UsdPreviewSurface), which Blender, Houdini, Maya and
// Omniverse read. Files grow beside their place and appear whole or not at all.
#pragma once

#include "meshes/files/surface_files.h"
#include "meshes/files/write_whole.h"

#include <string>
#include <vector>

namespace homespun::meshes
{
/// A .pc2 file: "POINTCACHE2", then int version 1, int points, float first frame 0, float frames
/// per sample 1, int samples, then x y z of each point of each sample as float, little-endian.
class PointCache
{
public:
  /// @throws BadInput where the file cannot be written
  PointCache(const std::string &file, int n_points, int n_frames);

  /// @param positions (n,3) [m]
  /// @throws BadInput where a position is not finite, or the disk is full
  void append(const FloatPoints &positions);

  /// @throws BadInput where the file cannot be written
  void finish();

private:
  const std::string name;
  const int n_points;
  WholeFile file;
};

/// Which axis of the positions points up; it is said, positions are not turned.
enum class UpAxis
{
  y,
  z
};

/// What a .usda file says of all its frames.
struct UsdStage
{
  UpAxis up;
  int n_frames;
  double frames_per_second = 24.; ///< as films have; other programs change it at will
};

/// A .usda file in metres: one mesh with positions over time, texture coordinates `st` of its
/// corners, and a subset with a material of its own for each phase. Every float is written with as
/// many digits as read it back.
class UsdAnimation
{
public:
  /// @param stage its time codes are the numbers of the frames
  /// @throws BadInput where a triangle names no vertex, or the file cannot be written
  UsdAnimation(const std::string &file, int n_points, const Triangles &triangles,
               const ClothLook &look, const UsdStage &stage);

  /// As PointCache.
  void append(const FloatPoints &positions);
  void finish();

private:
  const std::string name;
  const int n_points;
  std::string extents; ///< of each frame, as they will stand behind the positions
  int frame = 0;
  WholeFile file;
};
} // namespace homespun::meshes
