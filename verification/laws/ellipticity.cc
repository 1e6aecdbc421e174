// SPDX-License-Identifier: MIT
#include "verification/laws/ellipticity.h"

#include "meshes/plain/triangle_kinematics.h"
#include "verification/yarns/tension_field.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace homespun::verification
{
namespace
{
constexpr double pi      = 3.14159265358979323846;
constexpr int directions = 36; // of half a turn

/// Q(n) of n = (c, s), as Q11, Q22, Q12.
struct Acoustic
{
  double Q11, Q22, Q12;

  Acoustic(const Eigen::Matrix4d &A, const double c, const double s)
      : Q11(A(0, 0) * c * c + 2. * A(0, 1) * c * s + A(1, 1) * s * s)
      , Q22(A(2, 2) * c * c + 2. * A(2, 3) * c * s + A(3, 3) * s * s)
      , Q12(A(0, 2) * c * c + (A(0, 3) + A(1, 2)) * c * s + A(1, 3) * s * s)
  {
  }

  /// The least eigenvalue, as determinant over the other where that keeps its digits.
  double least() const
  {
    const double mean = 0.5 * (Q11 + Q22), half = std::hypot(0.5 * (Q11 - Q22), Q12);
    return mean > 0. ? (Q11 * Q22 - Q12 * Q12) / (mean + half) : mean - half;
  }

  /// Its unit vector.
  Eigen::Vector2d motion() const
  {
    const double value = least();
    const Eigen::Vector2d across(Q11 - value, Q12), other(Q12, Q22 - value);
    const Eigen::Vector2d &row = across.squaredNorm() >= other.squaredNorm() ? across : other;
    return row.squaredNorm() > 0. ? Eigen::Vector2d(-row(1), row(0)).normalized()
                                  : Eigen::Vector2d::UnitX();
  }
};

/// The angle of a minimum between two others, by the golden section.
double refined(const Eigen::Matrix4d &A, double from, double to)
{
  constexpr double golden = 0.61803398874989485;
  const auto value        = [&](const double angle)
  { return Acoustic(A, std::cos(angle), std::sin(angle)).least(); };
  double low = to - golden * (to - from), high = from + golden * (to - from);
  double at_low = value(low), at_high = value(high);
  while (to - from > 1e-9)
    if (at_low <= at_high)
    {
      to      = high;
      high    = low;
      at_high = at_low;
      low     = to - golden * (to - from);
      at_low  = value(low);
    }
    else
    {
      from    = low;
      low     = high;
      at_low  = at_high;
      high    = from + golden * (to - from);
      at_high = value(high);
    }
  return 0.5 * (from + to);
}
} // namespace

LeastWave least_wave(const Eigen::Matrix4d &tangent)
{
  static const auto units = []()
  {
    std::array<Eigen::Vector2d, directions> all;
    for (int k = 0; k < directions; ++k)
      all[static_cast<std::size_t>(k)] << std::cos(pi * k / directions),
        std::sin(pi * k / directions);
    return all;
  }();
  std::array<double, directions> values;
  for (std::size_t k = 0; k < directions; ++k)
    values[k] = Acoustic(tangent, units[k](0), units[k](1)).least();
  LeastWave best;
  best.stiffness = std::numeric_limits<double>::infinity();
  best.normal = best.motion = Eigen::Vector2d::UnitX();
  for (std::size_t k = 0; k < directions; ++k)
    if (values[k] <= values[(k + 1) % directions] &&
        values[k] <= values[(k + directions - 1) % directions])
    {
      const double middle = pi * static_cast<double>(k) / directions, step = pi / directions;
      const double angle = refined(tangent, middle - step, middle + step);
      // An axis of the cloth is often the minimum itself: then the sample has all digits.
      Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
      if (Acoustic(tangent, normal(0), normal(1)).least() > values[k])
        normal = units[k];
      const Acoustic acoustic(tangent, normal(0), normal(1));
      if (acoustic.least() < best.stiffness)
        best = {acoustic.least(), normal, acoustic.motion()};
    }
  return best;
}

EllipticityOfLaw::EllipticityOfLaw(const Law law, const Eigen::Matrix3d &C)
    : law(law)
    , C(C)
    , at_rest(least_wave(response(law, C, Eigen::Matrix2d::Identity()).tangent).stiffness)
{
}

double EllipticityOfLaw::at(const Eigen::Matrix2d &F) const
{
  const Response here = response(law, C, F);
  return std::isfinite(here.energy) ? least_wave(here.tangent).stiffness / at_rest : here.energy;
}

bool EllipticityOfLaw::is_lost(const double least) const
{
  constexpr double round_off = 1e-9;
  return law == Law::yarn_tension ? least < -round_off : !(least > 0.);
}

std::vector<PhaseEllipticity>
ellipticity_of_phases(const meshes::TriangleMesh &rest,
                      const std::vector<Eigen::Matrix3d> &stiffness_of_phase, const Law law,
                      const meshes::Points &positions)
{
  std::vector<EllipticityOfLaw> laws;
  for (const Eigen::Matrix3d &C : stiffness_of_phase)
    laws.emplace_back(law, C);
  std::vector<PhaseEllipticity> found(laws.size());
  for (int t = 0; t < rest.n_triangles(); ++t)
  {
    const auto phase        = static_cast<std::size_t>(rest.material(t));
    PhaseEllipticity &p     = found[phase];
    const Eigen::Matrix2d F = meshes::deformation_gradient<2>(rest, t, positions);
    const double ratio      = laws[phase].at(F);
    ++p.n_triangles;
    p.n_lost += laws[phase].is_lost(ratio) ? 1 : 0;
    p.least = std::min(p.least, ratio);
    if (law != Law::yarn_tension)
      continue;
    const ClothState state = cloth_state(stiffness_of_phase[phase], F);
    p.n_wrinkled += state == ClothState::wrinkled ? 1 : 0;
    p.n_slack += state == ClothState::slack ? 1 : 0;
  }
  return found;
}
} // namespace homespun::verification
