// SPDX-License-Identifier: MIT
#include "meshes/plain/general_lattice.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

namespace homespun::meshes
{
namespace
{
/// Vertices of the outline that are tried as starts of translations. A lattice vector starts at
/// every vertex, but at one inside a side only a single one: from eight places around, all pairs of
/// sides are met.
constexpr std::size_t n_starts = 8;

/// Translations that are tried in pairs, the shortest of all.
constexpr std::size_t most_translations = 40;

/// Of a mesh with cut holes: pairs that are tried for each of the likeliest first vectors.
constexpr std::size_t most_first_vectors = 6, most_partners = 3;

/// a1 nearest to the x axis, a1 x a2 > 0.
Lattice ordered(const Eigen::RowVector2d &one, const Eigen::RowVector2d &other)
{
  Lattice lattice;
  lattice.vectors << one, other;
  if (std::abs(lattice.vectors(1, 1)) * lattice.vectors.row(0).norm() <
      std::abs(lattice.vectors(0, 1)) * lattice.vectors.row(1).norm())
    lattice.vectors.row(0).swap(lattice.vectors.row(1));
  if (lattice.vectors.determinant() < 0.)
    lattice.vectors.row(1) *= -1.;
  lattice.vectors.array() += 0.; // prints 0, not -0
  return lattice;
}

/// Of d and −d the one that points to the right, or straight up.
Eigen::RowVector2d upwards(const Eigen::RowVector2d &d, const double tolerance)
{
  return d(0) < -tolerance || (d(0) < tolerance && d(1) < 0.) ? Eigen::RowVector2d(-d) : d;
}

struct Translation
{
  Eigen::RowVector2d vector;
  double length; ///< of the boundary that it carries onto other boundary
};

/// Translations that carry edges of the boundary onto edges that run the other way, the longest
/// boundary first, and of equals the shortest vector.
std::vector<Translation> translations_of(const TriangleMesh &mesh, const double tolerance)
{
  const std::vector<std::array<int, 2>> edges = boundary_edges(mesh);
  std::vector<Translation> found;
  std::map<std::array<long, 2>, std::size_t> index_at; // in boxes of four tolerances
  const auto box = [&](const double x) { return std::lround(x / (4. * tolerance)); };
  const auto add = [&](const Eigen::RowVector2d &d, const double length)
  {
    for (long i = -1; i <= 1; ++i)
      for (long j = -1; j <= 1; ++j)
        if (const auto place = index_at.find({box(d(0)) + i, box(d(1)) + j});
            place != index_at.end() && (found[place->second].vector - d).norm() < tolerance)
        {
          found[place->second].length += length;
          return;
        }
    index_at.emplace(std::array<long, 2>{box(d(0)), box(d(1))}, found.size());
    found.push_back({d, length});
  };
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
    {
      const Eigen::RowVector2d from = mesh.vertices.row(edges[i][0]),
                               to   = mesh.vertices.row(edges[i][1]),
                               d    = mesh.vertices.row(edges[j][1]) - from;
      if ((mesh.vertices.row(edges[j][0]) - to - d).norm() < tolerance && d.norm() > tolerance)
        add(upwards(d, tolerance), (to - from).norm());
    }
  std::stable_sort(found.begin(), found.end(),
                   [&](const Translation &a, const Translation &b)
                   {
                     return a.length != b.length && std::abs(a.length - b.length) > tolerance
                              ? a.length > b.length
                              : a.vector.norm() < b.vector.norm() - tolerance;
                   });
  return found;
}
} // namespace

std::vector<Lattice> lattices_by_length(const TriangleMesh &mesh)
{
  const double covered = signed_areas(mesh).sum();
  const std::vector<Translation> translations =
    translations_of(mesh, image_tolerance * std::sqrt(std::abs(covered)));
  std::vector<Lattice> lattices;
  for (std::size_t first = 0; first < std::min(translations.size(), most_first_vectors); ++first)
  {
    std::size_t n = 0;
    for (std::size_t second = first + 1; second < translations.size() && n < most_partners;
         ++second)
    {
      const Lattice lattice = ordered(translations[first].vector, translations[second].vector);
      if (lattice.area() < covered * (1. - 1e-9))
        continue;
      lattices.push_back(lattice);
      ++n;
    }
  }
  return lattices;
}

std::optional<Lattice> lattice_by_matching(const TriangleMesh &mesh)
{
  const std::vector<int> loop = outline(mesh);
  const std::size_t n         = loop.size();
  const auto at               = [&](const std::size_t k) -> Eigen::RowVector2d
  { return mesh.vertices.row(loop[k % n]); };
  double enclosed = 0.;
  for (std::size_t k = 0; k < n; ++k)
    enclosed += 0.5 * (at(k)(0) * at(k + 1)(1) - at(k)(1) * at(k + 1)(0));
  const double tolerance = image_tolerance * std::sqrt(std::abs(enclosed));

  // Of two sides that are images, the outline runs along one forwards and along the other
  // backwards.
  std::vector<Eigen::RowVector2d> translations;
  for (std::size_t start = 0; start < std::min(n, n_starts); ++start)
  {
    const std::size_t k = start * n / std::min(n, n_starts);
    for (std::size_t j = 0; j < n; ++j)
    {
      const Eigen::RowVector2d d = at(j) - at(k);
      const bool is_image        = (at(k + 1) + d - at(j + n - 1)).norm() < tolerance ||
                            (at(k + n - 1) + d - at(j + 1)).norm() < tolerance;
      if (j == k || !is_image)
        continue;
      const Eigen::RowVector2d up = upwards(d, tolerance);
      const bool is_known         = std::any_of(translations.begin(), translations.end(),
                                                [&](const Eigen::RowVector2d &other)
                                                { return (other - up).norm() < tolerance; });
      if (!is_known)
        translations.push_back(up);
    }
  }
  std::stable_sort(translations.begin(), translations.end(),
                   [&](const Eigen::RowVector2d &a, const Eigen::RowVector2d &b)
                   { return a.norm() < b.norm() - tolerance; });
  translations.resize(std::min(translations.size(), most_translations));

  for (std::size_t second = 1; second < translations.size(); ++second)
    for (std::size_t first = 0; first < second; ++first)
    {
      const Lattice lattice = ordered(translations[first], translations[second]);
      if (std::abs(lattice.area() - enclosed) > 1e-6 * enclosed)
        continue;
      if (periodicity_faults(mesh, lattice, "").empty())
        return lattice;
    }
  return std::nullopt;
}
} // namespace homespun::meshes
