// SPDX-License-Identifier: MIT
#include "shell/terms/selvedge.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/index.h"
#include "shell/algebra/vertex_matrix.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace homespun::shell
{
namespace
{
/// A segment as it lies.
struct Stretched
{
  Eigen::Vector3d direction; ///< zero where it has no length
  double length, strain;
};

class SelvedgeTerm final : public Term
{
public:
  explicit SelvedgeTerm(std::vector<SelvedgeSegment> &&given)
      : segments(std::move(given))
  {
  }

  std::string name() const override
  {
    return "selvedge";
  }

  void couple(std::vector<std::array<int, 2>> &pairs) const override
  {
    for (const SelvedgeSegment &segment : segments)
      pairs.push_back(segment.vertices);
  }

  void attach(const BlockMatrix &matrix) override
  {
    places.clear();
    for (const SelvedgeSegment &segment : segments)
    {
      const auto &[a, b] = segment.vertices;
      places.push_back({matrix.slot(a, a), matrix.slot(a, b), matrix.slot(b, b)});
    }
  }

  double energy(const Vectors &positions) const override
  {
    double sum = 0.;
    for (const SelvedgeSegment &segment : segments)
    {
      const double strain = stretched(segment, positions).strain;
      sum += 0.5 * segment.stiffness * segment.length * strain * strain;
    }
    return sum;
  }

  void add_gradient(const Vectors &positions, Vectors &gradient) const override
  {
    for (const SelvedgeSegment &segment : segments)
    {
      const Stretched now = stretched(segment, positions);
      add_pull(segment, segment.stiffness * now.strain * now.direction, gradient);
    }
  }

  void add_derivatives(const Vectors &positions, const Hessian kind, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    for (std::size_t s = 0; s < segments.size(); ++s)
    {
      const SelvedgeSegment &segment = segments[s];
      const Stretched now            = stretched(segment, positions);
      add_pull(segment, segment.stiffness * now.strain * now.direction, gradient);
      double along  = segment.stiffness / segment.length,
             across = now.length > 0. ? segment.stiffness * now.strain / now.length : 0.;
      if (kind != Hessian::exact)
      {
        along  = std::max(along, 0.);
        across = std::max(across, 0.);
      }
      const Eigen::Matrix3d axis  = now.direction * now.direction.transpose(),
                            block = along * axis + across * (Eigen::Matrix3d::Identity() - axis);
      matrix.add(places[s][0], block);
      matrix.add(places[s][1], -block);
      matrix.add(places[s][2], block);
    }
  }

  bool has_discrete_gradient() const override
  {
    return true;
  }

  /// With d the vector of a segment, l1 − l0 = 2 d̄·(d1 − d0)/(l0 + l1), exactly, so that
  /// kappa/L (1 − 2 L/(l0 + l1)) d̄ does the work E1 − E0; along d̄ it has no torque.
  void add_discrete_gradient(const Vectors &old, const Vectors &positions, Vectors &gradient,
                             VertexMatrix &jacobian) const override
  {
    for (const SelvedgeSegment &segment : segments)
    {
      const Stretched now = stretched(segment, positions);
      const double both   = stretched(segment, old).length + now.length;
      if (!(both > 0.))
        continue;
      const auto &[a, b] = segment.vertices;
      const Eigen::Vector3d mean =
        0.5 * (positions.row(b) - positions.row(a) + old.row(b) - old.row(a)).transpose();
      const double factor = segment.stiffness / segment.length;
      const double share  = 1. - 2. * segment.length / both;
      add_pull(segment, factor * share * mean, gradient);
      const Eigen::Matrix3d block =
        factor * (0.5 * share * Eigen::Matrix3d::Identity() +
                  2. * segment.length / (both * both) * mean * now.direction.transpose());
      jacobian.add(a, a, block);
      jacobian.add(a, b, -block);
      jacobian.add(b, a, -block);
      jacobian.add(b, b, block);
    }
  }

  std::size_t bytes() const override
  {
    return segments.size() * (sizeof(SelvedgeSegment) + sizeof(places[0]));
  }

private:
  static Stretched stretched(const SelvedgeSegment &segment, const Vectors &positions)
  {
    const Eigen::Vector3d d =
      (positions.row(segment.vertices[1]) - positions.row(segment.vertices[0])).transpose();
    const double length = d.norm();
    return {length > 0. ? Eigen::Vector3d(d / length) : Eigen::Vector3d::Zero(), length,
            length / segment.length - 1.};
  }

  static void add_pull(const SelvedgeSegment &segment, const Eigen::Vector3d &pull,
                       Vectors &gradient)
  {
    gradient.row(segment.vertices[0]) -= pull.transpose();
    gradient.row(segment.vertices[1]) += pull.transpose();
  }

  const std::vector<SelvedgeSegment> segments;
  std::vector<std::array<BlockMatrix::Slot, 3>> places; ///< of each: first, mixed, second
};

/// Of a strain in Voigt form along a unit vector.
Eigen::RowVector3d strain_along(const Eigen::Vector2d &t)
{
  return {t(0) * t(0), t(1) * t(1), t(0) * t(1)};
}
} // namespace

double selvedge_stiffness(const Eigen::Vector3d &tension, const Eigen::Matrix3d &stiffness,
                          const Eigen::Vector2d &along)
{
  const Eigen::Vector2d t = along.normalized();
  // The stress of an edge without traction is one along it, t t^T.
  const Eigen::Vector3d strain =
    stiffness.ldlt().solve(Eigen::Vector3d(t(0) * t(0), t(1) * t(1), t(0) * t(1)));
  return tension.dot(strain) / strain_along(t).dot(strain);
}

double largest_push(const Eigen::Matrix3d &stiffness, const Eigen::Vector2d &along,
                    const double height)
{
  const Eigen::Vector2d t = along.normalized();
  const Eigen::Vector3d strain =
    stiffness.ldlt().solve(Eigen::Vector3d(t(0) * t(0), t(1) * t(1), t(0) * t(1)));
  return 0.5 * height / strain_along(t).dot(strain);
}

std::unique_ptr<Term> selvedge_term(std::vector<SelvedgeSegment> segments)
{
  for (std::size_t s = 0; s < segments.size(); ++s)
    if (!(segments[s].length > 0.) || !std::isfinite(segments[s].length) ||
        !std::isfinite(segments[s].stiffness))
      throw meshes::BadInput("selvedge: segment " + std::to_string(s) + " has length " +
                             std::to_string(segments[s].length) + " m and stiffness " +
                             std::to_string(segments[s].stiffness) +
                             " N; expected a positive length and finite numbers");
  return std::make_unique<SelvedgeTerm>(std::move(segments));
}
} // namespace homespun::shell
