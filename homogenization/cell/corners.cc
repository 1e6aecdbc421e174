// SPDX-License-Identifier: MIT
#include "homogenization/cell/corners.h"

#include "meshes/plain/gauss_rule.h"
#include "meshes/plain/index.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// Angles that differ by less are the same: coordinates in files have some eight digits.
constexpr double same_angle = 1e-6;

/// Polynomials per piece of a sector, and the widest piece: exponents are met to 1e-8 in isotropic
/// phases, whose fields are trigonometric in theta, and to 1e-4 in one ten times stiffer along than
/// across.
constexpr int degree       = 8;
constexpr double widest    = M_PI / 4.;
constexpr double near_unit = 1e-6;

/// A corner of a triangle: between the edges to the next vertex and to the one before.
struct TriangleCorner
{
  using Edge = std::array<int, 3>; ///< class of its other end, and lattice vectors to it
  Edge begin, end;
  double direction, angle; ///< of the first edge, and between both [rad]
  double length;           ///< of the shorter one [m]
  int material;
};

bool is_same(const Eigen::Matrix3d &a, const Eigen::Matrix3d &b)
{
  return (a - b).cwiseAbs().maxCoeff() <= 1e-12 * b.cwiseAbs().maxCoeff();
}

/// Whether displacements stay smooth, up to kinks along one straight line.
/// @param tolerance of a straight angle
bool is_regular(const Corner &corner, const double tolerance)
{
  const auto is_half = [&](const Sector &sector)
  { return std::abs(sector.end - sector.begin - M_PI) < tolerance; };
  const std::vector<Sector> &sectors = corner.sectors;
  if (sectors.size() == 1)
    return corner.is_closed || is_half(sectors[0]);
  return corner.is_closed && sectors.size() == 2 && is_half(sectors[0]) && is_half(sectors[1]);
}

/// Neighbours of the same stiffness become one.
void merge(Corner &corner)
{
  std::vector<Sector> merged;
  for (const Sector &sector : corner.sectors)
    if (!merged.empty() && is_same(merged.back().stiffness, sector.stiffness))
      merged.back().end = sector.end;
    else
      merged.push_back(sector);
  if (corner.is_closed && merged.size() > 1 &&
      is_same(merged.front().stiffness, merged.back().stiffness))
  {
    merged.front().begin = merged.back().begin - 2. * M_PI;
    merged.pop_back();
  }
  corner.sectors = merged;
}

/// The strain (11, 22, engineering 12) of a gradient along a direction.
Eigen::Matrix<double, 3, 2> strain_along(const double x, const double y)
{
  Eigen::Matrix<double, 3, 2> B;
  B << x, 0., 0., y, y, x;
  return B;
}

/// Values and slopes of the Lagrange polynomials of Chebyshev's nodes at the points of a Gauss rule
/// on (−1, 1).
struct Polynomials
{
  static constexpr int n_points = degree + 4;
  Eigen::Matrix<double, n_points, 1> points, weights;
  Eigen::Matrix<double, n_points, degree + 1> values, slopes;

  Polynomials()
  {
    const meshes::GaussRule rule = meshes::gauss_rule(n_points);
    points                       = rule.points;
    weights                      = rule.weights;
    const auto node              = [](const int i) { return -std::cos(M_PI * i / degree); };
    for (int q = 0; q < n_points; ++q)
      for (int i = 0; i <= degree; ++i)
      {
        double value = 1., slope = 0.;
        for (int j = 0; j <= degree; ++j)
          if (j != i)
          {
            const double factor = 1. / (node(i) - node(j));
            slope               = slope * (points(q) - node(j)) * factor + value * factor;
            value *= (points(q) - node(j)) * factor;
          }
        values(q, i) = value;
        slopes(q, i) = slope;
      }
  }
};

/// The triangles around each vertex of the torus.
std::map<int, std::vector<TriangleCorner>> triangles_around(const meshes::TriangleMesh &mesh,
                                                            const meshes::Lattice &lattice)
{
  const meshes::ImageClasses classes = meshes::match_images(mesh.vertices, lattice);
  std::map<int, std::vector<TriangleCorner>> around;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int v        = mesh.triangles(t, k),
                ends[2]  = {mesh.triangles(t, (k + 1) % 3), mesh.triangles(t, (k + 2) % 3)};
      const auto edge_to = [&](const int w) -> TriangleCorner::Edge
      {
        const Eigen::RowVector2i offset = classes.offset.row(w) - classes.offset.row(v);
        return {classes.representative[at(w)], offset(0), offset(1)};
      };
      const Eigen::RowVector2d a = mesh.vertices.row(ends[0]) - mesh.vertices.row(v);
      const Eigen::RowVector2d b = mesh.vertices.row(ends[1]) - mesh.vertices.row(v);
      around[classes.representative[at(v)]].push_back(
        {edge_to(ends[0]), edge_to(ends[1]), std::atan2(a(1), a(0)),
         std::atan2(a(0) * b(1) - a(1) * b(0), a.dot(b)), std::min(a.norm(), b.norm()),
         mesh.material(t)});
    }
  return around;
}

/// Goes around a vertex from one of its triangles on, over edges that two have in common.
/// @return the corner with its sectors, and the shortest edge [m]
std::pair<Corner, double> walk_around(const std::vector<TriangleCorner> &its, std::size_t i,
                                      const std::map<TriangleCorner::Edge, std::size_t> &by_begin,
                                      const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                                      std::vector<char> &is_used)
{
  Corner corner;
  double shortest = std::numeric_limits<double>::infinity();
  for (double angle = its[i].direction; !is_used[i];)
  {
    is_used[i] = 1;
    shortest   = std::min(shortest, its[i].length);
    corner.sectors.push_back(
      {angle, angle + its[i].angle, stiffness_of_material[at(its[i].material)]});
    angle           = corner.sectors.back().end;
    const auto next = by_begin.find(its[i].end);
    if (next != by_begin.end())
      i = next->second;
  }
  return {corner, shortest};
}
} // namespace

std::vector<Corner> corners_of(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice,
                               const std::vector<Eigen::Matrix3d> &stiffness_of_material)
{
  std::vector<Corner> corners;
  for (const auto &corners_at_vertex : triangles_around(mesh, lattice))
  {
    const std::vector<TriangleCorner> &its = corners_at_vertex.second;
    std::map<TriangleCorner::Edge, std::size_t> by_begin;
    std::map<TriangleCorner::Edge, bool> is_end;
    for (std::size_t i = 0; i < its.size(); ++i)
    {
      by_begin[its[i].begin] = i;
      is_end[its[i].end]     = true;
    }
    std::vector<char> is_used(its.size(), 0);
    const auto walk = [&](const std::size_t i, const bool is_closed)
    {
      auto [corner, shortest] = walk_around(its, i, by_begin, stiffness_of_material, is_used);
      corner.is_closed        = is_closed;
      merge(corner);
      // A line may bend by what images may be off.
      if (!is_regular(corner, std::max(same_angle, 4. * meshes::image_tolerance *
                                                     std::sqrt(lattice.area()) / shortest)))
        corners.push_back(corner);
    };
    // Holes that touch leave several fans between them; each begins at an edge that ends none.
    for (std::size_t i = 0; i < its.size(); ++i)
      if (is_end.count(its[i].begin) == 0)
        walk(i, false);
    for (std::size_t i = 0; i < its.size(); ++i)
      if (!is_used[i])
        walk(i, true);
  }
  return corners;
}

std::vector<double> exponents_of(const Corner &corner)
{
  static const Polynomials polynomials;
  std::vector<Sector> pieces;
  double size = 0.;
  for (const Sector &sector : corner.sectors)
  {
    const int n = std::max(1, static_cast<int>(std::ceil((sector.end - sector.begin) / widest)));
    const double width = (sector.end - sector.begin) / n;
    for (int i = 0; i < n; ++i)
      pieces.push_back(
        {sector.begin + i * width, sector.begin + (i + 1) * width, sector.stiffness});
    size = std::max(size, sector.stiffness.cwiseAbs().maxCoeff());
  }
  const int n_nodes = static_cast<int>(pieces.size()) * degree + (corner.is_closed ? 0 : 1);
  int n             = 2 * n_nodes;
  // lambda² M U = (K + lambda (G − G^T)) U
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n), G = M, K = M;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece)
  {
    const Sector &sector    = pieces[piece];
    const double half       = 0.5 * (sector.end - sector.begin);
    const Eigen::Matrix3d c = sector.stiffness / size;
    for (int q = 0; q < Polynomials::n_points; ++q)
    {
      const double theta = sector.begin + half * (1. + polynomials.points(q));
      const double x = std::cos(theta), y = std::sin(theta);
      const auto B_r = strain_along(x, y), B_t = strain_along(-y, x);
      const Eigen::Matrix2d rr = B_r.transpose() * c * B_r, tr = B_t.transpose() * c * B_r,
                            tt = B_t.transpose() * c * B_t;
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; j <= degree; ++j)
        {
          const int row       = 2 * ((static_cast<int>(piece) * degree + i) % n_nodes);
          const int column    = 2 * ((static_cast<int>(piece) * degree + j) % n_nodes);
          const double weight = polynomials.weights(q);
          M.block<2, 2>(row, column) +=
            weight * half * polynomials.values(q, i) * polynomials.values(q, j) * rr;
          G.block<2, 2>(row, column) +=
            weight * polynomials.slopes(q, i) * polynomials.values(q, j) * tr;
          K.block<2, 2>(row, column) +=
            weight / half * polynomials.slopes(q, i) * polynomials.slopes(q, j) * tt;
        }
    }
  }
  const bool is_clamped = !corner.is_closed && corner.clamped != ClampedRay::none;
  if (is_clamped)
  {
    const int first = corner.clamped == ClampedRay::first ? 2 : 0;
    n -= 2;
    for (Eigen::MatrixXd *const matrix : {&M, &G, &K})
      *matrix = matrix->block(first, first, n, n).eval();
  }
  const Eigen::LLT<Eigen::MatrixXd> inverse(M);
  Eigen::MatrixXd linear                  = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  linear.topRightCorner(n, n)             = Eigen::MatrixXd::Identity(n, n);
  linear.bottomLeftCorner(n, n)           = inverse.solve(K);
  linear.bottomRightCorner(n, n)          = inverse.solve(G - G.transpose());
  const Eigen::VectorXcd all              = linear.eigenvalues();
  std::vector<std::complex<double>> found = {all.begin(), all.end()};
  std::sort(found.begin(), found.end(),
            [](const auto &a, const auto &b) { return std::abs(a) < std::abs(b); });
  // The first four are the two translations and the two point forces, lambda = 0 with Jordan
  // blocks; a clamped ray leaves neither.
  std::vector<double> exponents;
  for (std::size_t k = is_clamped ? 0 : 4; k < found.size(); ++k)
    if (found[k].real() > 0. && found[k].real() < 2. - near_unit &&
        (is_clamped || std::abs(found[k] - 1.) > near_unit))
      exponents.push_back(found[k].real());
  std::sort(exponents.begin(), exponents.end());
  return exponents;
}

Singularity singularity_of(const std::vector<Corner> &corners)
{
  static std::mutex one_at_a_time;
  static std::map<std::vector<long>, std::vector<double>> known;
  const std::lock_guard guard(one_at_a_time);
  Singularity result;
  for (const Corner &corner : corners)
  {
    std::vector<long> key = {corner.is_closed, static_cast<long>(corner.clamped)};
    for (const Sector &sector : corner.sectors)
    {
      for (const double angle : {sector.begin, sector.end})
        key.push_back(std::lround(angle / same_angle));
      for (const double entry : sector.stiffness.reshaped())
        key.push_back(std::lround(1e9 * entry / corner.sectors[0].stiffness.cwiseAbs().maxCoeff()));
    }
    if (known.count(key) == 0)
      known[key] = exponents_of(corner);
    for (const double exponent : known[key])
      if (exponent < 1.)
      {
        result.exists    = true;
        result.weakest   = std::max(result.weakest, exponent);
        result.strongest = std::min(result.strongest, exponent);
      }
      else
        result.next = std::min(result.next, exponent);
  }
  return result;
}
} // namespace homespun::homogenization
