// SPDX-License-Identifier: MIT
#include "homogenization/cell/curved_sides.h"

#include "meshes/plain/cross.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace homespun::homogenization
{
using meshes::cross;
namespace
{
/// Of one kind no more than this many are told one by one.
constexpr int most_of_a_kind = 3;

/// Whether a quadratic polynomial is positive all over a triangle, by its Bezier ordinates (corners
/// 0, 1, 2, then the sides 01, 12, 20): their least is a lower bound, which quartering the triangle
/// makes exact.
bool is_positive(const std::array<double, 6> &b, const int depth)
{
  if (std::min({b[0], b[1], b[2]}) <= 0.)
    return false;
  if (std::min({b[3], b[4], b[5]}) > 0.)
    return true;
  if (depth == 0)
    return false;
  const auto on_side = [&](const double from, const double middle, const double to)
  { return 0.25 * from + 0.5 * middle + 0.25 * to; };
  const double m01 = on_side(b[0], b[3], b[1]), m12 = on_side(b[1], b[4], b[2]),
               m20 = on_side(b[2], b[5], b[0]);
  // Ordinates of the sides that join the middles.
  const double to0 = 0.25 * (b[0] + b[3] + b[4] + b[5]), to1 = 0.25 * (b[1] + b[3] + b[4] + b[5]),
               to2 = 0.25 * (b[2] + b[3] + b[4] + b[5]);
  const auto mean  = [](const double x, const double y) { return 0.5 * (x + y); };
  return is_positive({b[0], m01, m20, mean(b[0], b[3]), to0, mean(b[0], b[5])}, depth - 1) &&
         is_positive({b[1], m12, m01, mean(b[1], b[4]), to1, mean(b[1], b[3])}, depth - 1) &&
         is_positive({b[2], m20, m12, mean(b[2], b[5]), to2, mean(b[2], b[4])}, depth - 1) &&
         is_positive({m01, m12, m20, to1, to2, to0}, depth - 1);
}

/// Whether x = sum of lambda_k x_k + 4 lambda_k lambda_(k+1) sagitta_k covers its triangle once.
bool is_invertible(const std::array<Eigen::Vector2d, 3> &corners, const MiddleNodes &sagittas)
{
  // Derivatives towards corners 1 and 2: linear, given at the corners.
  const Eigen::Vector2d u = corners[1] - corners[0], v = corners[2] - corners[0];
  const auto &[s, p, q]     = sagittas;
  const Eigen::Vector2d x[] = {u + 4. * s, u - 4. * s, u + 4. * (p - q)};
  const Eigen::Vector2d y[] = {v + 4. * q, v + 4. * (p - s), v - 4. * q};
  const auto mixed          = [&](const int i, const int j)
  { return 0.5 * (cross(x[i], y[j]) + cross(x[j], y[i])); };
  constexpr int depth = 8; // what is still open after so many quarterings touches zero
  return is_positive({mixed(0, 0), mixed(1, 1), mixed(2, 2), mixed(0, 1), mixed(1, 2), mixed(2, 0)},
                     depth);
}
} // namespace

std::vector<CurvedSide> curved_sides_of(const meshes::TriangleMesh &mesh,
                                        const std::vector<MiddleNodes> &middles,
                                        const std::string &file)
{
  std::vector<std::string> faults;
  std::array<int, 3> n_of_kind{};
  const auto fault = [&](const std::size_t kind, const std::string &text)
  {
    if (n_of_kind[kind]++ < most_of_a_kind)
      faults.push_back(file + ": " + text);
  };
  struct Side
  {
    Eigen::Vector2d sagitta;
    int triangle;
  };
  std::map<std::array<int, 2>, Side> sides;
  std::vector<CurvedSide> curved;
  for (int t = 0; t < static_cast<int>(middles.size()); ++t)
  {
    std::array<Eigen::Vector2d, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[static_cast<std::size_t>(k)] = mesh.vertices.row(mesh.triangles(t, k)).transpose();
    // What is no triangle is told by the checks of the mesh.
    if (!(cross(corners[1] - corners[0], corners[2] - corners[0]) > 0.))
      continue;
    MiddleNodes sagittas;
    bool is_curved = false, is_off = false;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const int a                 = mesh.triangles(t, static_cast<int>(k)),
                b                 = mesh.triangles(t, static_cast<int>((k + 1) % 3));
      const Eigen::Vector2d chord = corners[(k + 1) % 3] - corners[k];
      const double length         = chord.norm();
      sagittas[k]        = middles[static_cast<std::size_t>(t)][k] - corners[k] - 0.5 * chord;
      const double along = sagittas[k].dot(chord) / (length * length);
      if (!(std::abs(along) < 0.25))
      {
        is_off = true;
        std::ostringstream text;
        text
          << "triangle " << t << ": the middle node of its side from vertex " << a << " to vertex "
          << b << " lies at " << 0.5 + along
          << " of the side; expected it near the middle, between 0.25 and 0.75, or the side runs "
             "back on itself: mesh again, or write first-order triangles (Gmsh: Mesh.ElementOrder "
             "= 1)";
        fault(0, text.str());
      }
      if (std::abs(cross(chord, sagittas[k])) <= straightness * length * length)
        sagittas[k].setZero();
      is_curved = is_curved || !sagittas[k].isZero(0.);
      const auto [place, is_new] =
        sides.emplace(std::array<int, 2>{std::min(a, b), std::max(a, b)}, Side{sagittas[k], t});
      if (is_new && !sagittas[k].isZero(0.))
        curved.push_back({a, b, sagittas[k]});
      if (!is_new && (place->second.sagitta - sagittas[k]).norm() > straightness * length)
      {
        std::ostringstream text;
        text << "triangles " << place->second.triangle << " and " << t
             << " curve their common side from vertex " << a << " to vertex " << b
             << " differently, by " << (place->second.sagitta - sagittas[k]).norm()
             << " mesh units; expected one middle node for both: write the mesh again";
        fault(1, text.str());
      }
    }
    if (is_curved && !is_off && !is_invertible(corners, sagittas))
      fault(2, "triangle " + std::to_string(t) +
                 " is inverted by its curved sides; expected sides that bend by less than the "
                 "angles of the triangle: mesh finer there (Gmsh: Mesh.MeshSizeFromCurvature, or "
                 "Mesh.HighOrderOptimize = 1)");
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return curved;
}

Eigen::VectorXd drawn_areas(const meshes::TriangleMesh &mesh,
                            const std::vector<CurvedSide> &curved_sides)
{
  std::map<std::array<int, 2>, double> swept; // to the left of a side, from its chord
  for (const auto &[a, b, sagitta] : curved_sides)
  {
    const Eigen::RowVector2d chord = mesh.vertices.row(b) - mesh.vertices.row(a);
    swept[{a, b}]                  = 2. / 3. * cross(chord, sagitta);
    swept[{b, a}]                  = -swept[{a, b}];
  }
  Eigen::VectorXd areas = meshes::signed_areas(mesh);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      if (const auto its = swept.find({mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)});
          its != swept.end())
        areas(t) -= its->second;
  return areas;
}
} // namespace homespun::homogenization
