// SPDX-License-Identifier: MIT
// Triangles in space for other programs: .ply (Blender, MeshLab, Houdini) with what makes them look
// like cloth, .vtu (ParaView, VTK) with data on the vertices, and .pvd, the collection that makes
// an animation of many .vtu. Every file appears whole or not at all, and no number in it is NaN or
// infinite.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

namespace homespun::meshes
{
/// Points in space in single precision, one per row, shape (n,3) [m]: what up-sampling returns.
using FloatPoints = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Numbers on the vertices, or on the triangles.
struct VertexData
{
  std::string name; ///< with its unit, e.g. "strain_11 [-]"
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
    values; ///< (n,1), or (n,3) for a vector
};

/// What makes a surface look like cloth in programs that draw.
struct ClothLook
{
  Eigen::VectorXi material; ///< (m) phase of each triangle, which gives it its colour
  Points texture;           ///< (k,2) the flat cloth, from 0 to 1 along its longer side
  Triangles corners;        ///< (m,3) rows of `texture`: at seams other ones than in space

  /// Texture coordinates of the corners of a cloth.
  /// @param rest (k,2) the flat cloth [m]
  static ClothLook of(const Points &rest, const Triangles &corners,
                      const Eigen::VectorXi &material);
};

/// Colour of a phase, from 0 to 1: red, green, blue. The first eight are those of Okabe and Ito,
/// which are told apart with any eyes; then they repeat.
Eigen::RowVector3f colour_of_phase(int phase);

/// Writes binary little-endian PLY with float positions and int faces.
/// @param look where it is not empty: vertices have s, t (at a seam those of one side) and the mean
///   colour of their triangles, faces `material`, colour and their own `texcoord`
/// @param normals (n,3) of the vertices, or none
/// @throws BadInput where a number is not finite, shapes do not match, or the file cannot be
///   written
void write_ply(const std::string &file, const FloatPoints &positions, const Triangles &triangles,
               const ClothLook &look = {}, const FloatPoints &normals = {});

/// What a surface carries beside its positions.
struct SurfaceData
{
  std::vector<VertexData> on_vertices, on_triangles;
  ClothLook look; ///< of programs that draw
};

/// A list of words of a file as a whole, such as what the numbers of its materials mean.
struct WordList
{
  std::string name;
  std::vector<std::string> words;
};

/// Writes a VTK XML unstructured grid of triangles, appended raw binary, float.
/// @param cell_data (m,1) or (m,3) on the triangles
/// @param words field data, which ParaView shows in its spreadsheet and annotations
/// @throws BadInput as write_ply()
void write_vtu(const std::string &file, const FloatPoints &positions, const Triangles &triangles,
               const std::vector<VertexData> &data      = {},
               const std::vector<VertexData> &cell_data = {},
               const std::vector<WordList> &words       = {});

/// A .pvd file: which .vtu shows which time. It is written whole after each frame, so that a run
/// that was killed leaves a collection of all frames before.
class FrameCollection
{
public:
  /// Nothing is written before the first frame.
  explicit FrameCollection(std::string file);

  /// @param time [s], finite
  /// @param frame .vtu file, relative to the folder of the collection
  /// @throws BadInput where the time is not finite, or the file cannot be written
  void append(double time, const std::string &frame);

private:
  std::string file;
  std::vector<std::pair<double, std::string>> frames;
};
} // namespace homespun::meshes
