// SPDX-License-Identifier: MIT
// Cells as people draw them: random full cells, nets, and sound ones with a fault planted; written
// as files with as many digits as a program may leave, and read like any other.
#pragma once

#include "homogenization/lint/cell_reading.h"
#include "tests/homogenization/cell/cells.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <sstream>
#include <string>

namespace homespun::tests
{
using Random = std::mt19937;

inline double uniform(Random &random, const double low, const double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline int whole(Random &random, const int low, const int high)
{
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// Triangles from points that are told by keys, each once.
class MeshBuilder
{
public:
  /// @param key of the place; equal keys are one vertex
  int vertex(const std::array<int, 2> &key, const Eigen::RowVector2d &x)
  {
    const auto [place, is_new] = number.emplace(key, static_cast<int>(points.size()));
    if (is_new)
      points.push_back(x);
    return place->second;
  }
  void triangle(const int a, const int b, const int c, const int material = 0)
  {
    triangles.push_back({a, b, c});
    materials.push_back(material);
  }
  meshes::TriangleMesh mesh() const
  {
    meshes::TriangleMesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 2);
    for (std::size_t p = 0; p < points.size(); ++p)
      mesh.vertices.row(static_cast<Eigen::Index>(p)) = points[p];
    mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    mesh.material.resize(static_cast<Eigen::Index>(triangles.size()));
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      mesh.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1],
        triangles[t][2];
      mesh.material(static_cast<Eigen::Index>(t)) = materials[t];
    }
    return mesh;
  }

private:
  std::map<std::array<int, 2>, int> number;
  std::vector<Eigen::RowVector2d> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> materials;
};

/// The hexagon with the sides s0, s1, s2, -s0, -s1, -s2 as six fans of n^2 triangles.
inline meshes::TriangleMesh hexagon(const std::array<Eigen::RowVector2d, 3> &s, const int n)
{
  // Corners around the centre; sector k lies between corners k and k + 1.
  std::array<Eigen::RowVector2d, 6> corner;
  corner[0] = -0.5 * (s[0] + s[1] + s[2]);
  for (std::size_t k = 1; k < 6; ++k)
    corner[k] = corner[k - 1] + (k <= 3 ? 1. : -1.) * s[(k - 1) % 3];
  MeshBuilder builder;
  const auto vertex = [&](const std::size_t k, const int i, const int j)
  {
    // i along corner k, j along corner k + 1: those on a spoke belong to two sectors.
    const std::size_t next = (k + 1) % 6;
    std::array<int, 2> key = {static_cast<int>(k), i * 1000 + j};
    if (i == 0 && j == 0)
      key = {-1, 0};
    else if (j == 0)
      key = {static_cast<int>(100 + k), i};
    else if (i == 0)
      key = {static_cast<int>(100 + next), j};
    return builder.vertex(key, (i * corner[k] + j * corner[next]) / n);
  };
  for (std::size_t k = 0; k < 6; ++k)
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j)
      {
        builder.triangle(vertex(k, i, j), vertex(k, i + 1, j), vertex(k, i, j + 1));
        if (i + j + 1 < n)
          builder.triangle(vertex(k, i + 1, j), vertex(k, i + 1, j + 1), vertex(k, i, j + 1));
      }
  return builder.mesh();
}

/// Squares of a periodic pattern of n x n, each of 2 x 2 x 2 triangles, cut out from (i0, j0) on,
/// `periods` times along either axis; a lattice of side 1.
inline meshes::TriangleMesh pixels(const int n, const std::function<bool(int, int)> &is_solid,
                                   const int i0 = 0, const int j0 = 0, const int periods = 1)
{
  MeshBuilder builder;
  const auto vertex = [&](const int i, const int j) {
    return builder.vertex({i, j}, Eigen::RowVector2d(i, j) / (2. * n));
  };
  for (int j = 0; j < 2 * n * periods; ++j)
    for (int i = 0; i < 2 * n * periods; ++i)
      if (is_solid((i0 + i / 2) % n, (j0 + j / 2) % n))
      {
        builder.triangle(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
        builder.triangle(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
      }
  return builder.mesh();
}

/// A number as a file has it.
struct Digits
{
  int n         = 17;
  bool is_fixed = false; ///< n decimals, else n significant digits

  std::string text(const double x) const
  {
    std::array<char, 64> buffer;
    std::snprintf(buffer.data(), buffer.size(), is_fixed ? "%.*f" : "%.*g", n, x);
    return buffer.data();
  }
};

/// A folder with one cell file, whose phases are 1: soft, 2: ten times as stiff.
class DrawnCell
{
public:
  DrawnCell()
      : folder(std::filesystem::temp_directory_path() /
               ("homespun-drawn-" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(folder);
  }
  ~DrawnCell()
  {
    std::filesystem::remove_all(folder);
  }

  /// @param more lines of the cell file
  homogenization::CellReading read(const meshes::TriangleMesh &mesh, const Digits &digits,
                                   const std::string &more = "") const
  {
    std::ofstream msh(folder / "cell.msh");
    msh << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << mesh.n_vertices() << "\n";
    for (int v = 0; v < mesh.n_vertices(); ++v)
      msh << v + 1 << " " << digits.text(mesh.vertices(v, 0)) << " "
          << digits.text(mesh.vertices(v, 1)) << " 0\n";
    msh << "$EndNodes\n$Elements\n" << mesh.n_triangles() << "\n";
    for (int t = 0; t < mesh.n_triangles(); ++t)
      msh << t + 1 << " 2 2 " << mesh.material(t) + 1 << " 1 " << mesh.triangles.row(t).array() + 1
          << "\n";
    msh << "$EndElements\n";
    msh.close();
    std::ofstream prm(folder / "cell.prm");
    prm << "set Mesh = cell.msh\nset Length unit = 0.01\n";
    const bool has_two = mesh.material.maxCoeff() > 0;
    for (const auto &[key, values] :
         {std::pair("Young's modulus", "1: 1e6, 2: 1e7"),
          std::pair("Poisson's ratio", "1: 0.3, 2: 0.3"),
          std::pair("Thickness", "1: 5e-4, 2: 5e-4"), std::pair("Density", "1: 400, 2: 400")})
      prm << "set " << key << " = "
          << (has_two ? std::string(values)
                      : std::string(values).substr(0, std::string(values).find(',')))
          << "\n";
    prm << more;
    prm.close();
    return homogenization::read_unit_cell_with_findings((folder / "cell.prm").string(),
                                                        MPI_COMM_NULL);
  }

  const std::filesystem::path folder;
};

inline std::string texts_of(const homogenization::CellReading &reading)
{
  std::string all;
  for (const homogenization::Finding &finding : reading.findings)
    all += text_of(finding) + "\n";
  return all;
}

/// C^H with P1 on the mesh as read [N/m].
inline Eigen::Matrix3d stiffness_of(const homogenization::CellReading &reading)
{
  homogenization::HomogenizationOptions options;
  options.order     = 1;
  options.tolerance = 1e-13;
  options.solver    = homogenization::CellSolver::direct;
  return homogenization::homogenize(reading.cell, options, MPI_COMM_SELF).stiffness;
}
} // namespace homespun::tests
