// SPDX-License-Identifier: MIT
#include "verification/ellipticity/ellipticity.h"

#include "meshes/plain/triangle_kinematics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace homespun::verification
{
namespace
{
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
    const double mean = 0.5 * (Q11 + Q22),
                 half = std::sqrt(0.25 * (Q11 - Q22) * (Q11 - Q22) + Q12 * Q12);
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

/// A term of Q by twice the angle of n: mean + cosine cos + sine sin, with its derivatives.
struct Harmonic
{
  double mean, cosine, sine;

  /// Of x c² + y c s + z s².
  Harmonic(const double x, const double y, const double z)
      : mean(0.5 * (x + z))
      , cosine(0.5 * (x - z))
      , sine(0.5 * y)
  {
  }

  double size() const
  {
    return std::abs(mean) + std::abs(cosine) + std::abs(sine);
  }

  double change(const double c, const double s) const
  {
    return sine * c - cosine * s;
  }

  double bend(const double c, const double s) const
  {
    return -cosine * c - sine * s;
  }

  double at(const double c, const double s) const
  {
    return mean - bend(c, s);
  }
};

/// The least eigenvalue of Q by twice the angle of n, half of the trace less a root.
class LeastEigenvalue
{
public:
  explicit LeastEigenvalue(const Eigen::Matrix4d &A)
      : Q11(A(0, 0), 2. * A(0, 1), A(1, 1))
      , Q22(A(2, 2), 2. * A(2, 3), A(3, 3))
      , Q12(A(0, 2), A(0, 3) + A(1, 2), A(1, 3))
  {
  }

  struct Derivatives
  {
    double first, second;
  };

  Derivatives at(const double twice) const
  {
    const double c = std::cos(twice), s = std::sin(twice);
    const double half = 0.5 * (Q11.at(c, s) - Q22.at(c, s)), off = Q12.at(c, s);
    const double by_half = 0.5 * (Q11.change(c, s) - Q22.change(c, s)), by_off = Q12.change(c, s);
    const double root  = std::sqrt(half * half + off * off);
    const double root1 = (half * by_half + off * by_off) / root;
    const double root2 =
      (by_half * by_half + by_off * by_off + half * 0.5 * (Q11.bend(c, s) - Q22.bend(c, s)) +
       off * Q12.bend(c, s) - root1 * root1) /
      root;
    return {0.5 * (Q11.change(c, s) + Q22.change(c, s)) - root1,
            0.5 * (Q11.bend(c, s) + Q22.bend(c, s)) - root2};
  }

private:
  Harmonic Q11, Q22, Q12;
};

/// The angle of a minimum between two others, where the derivative has its zero: Newton's method,
/// and halves where it leaves them. The value is flat there, so that 1e-8 of an angle is its
/// round-off.
double refined(const Eigen::Matrix4d &A, const double from, const double middle, const double to)
{
  const LeastEigenvalue least(A);
  double low = 2. * from, high = 2. * to, angle = 2. * middle;
  for (int k = 0; k < 60 && high - low > 1e-8; ++k)
  {
    const LeastEigenvalue::Derivatives here = least.at(angle);
    (here.first > 0. ? high : low)          = angle;
    double next                             = angle - here.first / here.second;
    if (!(here.second > 0.) || !(next > low) || !(next < high))
      next = 0.5 * (low + high);
    const double moved = std::abs(next - angle);
    angle              = next;
    if (moved <= 1e-8)
      break;
  }
  return 0.5 * angle;
}
} // namespace

bool every_wave_is_above(const Eigen::Matrix4d &A, const double bound)
{
  using Samples = Eigen::Array<double, directions, 1>;
  static const Samples twice =
    Samples::LinSpaced(directions, 0., 2. * M_PI * (directions - 1) / directions);
  static const Samples c1 = twice.cos(), s1 = twice.sin(), c2 = (2. * twice).cos(),
                       s2 = (2. * twice).sin();
  const Harmonic Q11(A(0, 0) - bound, 2. * A(0, 1), A(1, 1) - bound);
  const Harmonic Q22(A(2, 2) - bound, 2. * A(2, 3), A(3, 3) - bound);
  const Harmonic Q12(A(0, 2), A(0, 3) + A(1, 2), A(1, 3));
  // Coefficients of det Q: products of harmonics.
  double mean = 0., cos1 = 0., sin1 = 0., cos2 = 0., sin2 = 0., size = 0.;
  const auto add = [&](const double times, const Harmonic &one, const Harmonic &other)
  {
    mean +=
      times * (one.mean * other.mean + 0.5 * (one.cosine * other.cosine + one.sine * other.sine));
    cos1 += times * (one.mean * other.cosine + one.cosine * other.mean);
    sin1 += times * (one.mean * other.sine + one.sine * other.mean);
    cos2 += times * 0.5 * (one.cosine * other.cosine - one.sine * other.sine);
    sin2 += times * 0.5 * (one.cosine * other.sine + one.sine * other.cosine);
    size += one.size() * other.size();
  };
  add(1., Q11, Q22);
  add(-1., Q12, Q12);
  // Between values no further apart than a step the least one is missed by half the bend times the
  // square of half a step.
  const double bend      = std::hypot(cos1, sin1) + 4. * std::hypot(cos2, sin2);
  const double missed    = 0.5 * bend * std::pow(M_PI / directions, 2);
  constexpr double exact = 1e-14;
  const double least     = (mean + cos1 * c1 + sin1 * s1 + cos2 * c2 + sin2 * s2).minCoeff();
  return least > missed + exact * size && Q11.mean + Q22.mean > 0.;
}

LeastWave least_wave(const Eigen::Matrix4d &tangent)
{
  static const auto units = []()
  {
    std::array<Eigen::Vector2d, directions> all;
    for (int k = 0; k < directions; ++k)
      all[static_cast<std::size_t>(k)] << std::cos(M_PI * k / directions),
        std::sin(M_PI * k / directions);
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
      const double middle = M_PI * static_cast<double>(k) / directions, step = M_PI / directions;
      const double angle = refined(tangent, middle - step, middle, middle + step);
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
    , phase(law, C)
    , at_rest(least_wave(phase.response(Eigen::Matrix2d::Identity()).tangent).stiffness)
{
}

double EllipticityOfLaw::at(const Eigen::Matrix2d &F) const
{
  const Response here = phase.response(F);
  return std::isfinite(here.energy) ? least_wave(here.tangent).stiffness / at_rest : here.energy;
}

std::optional<double> EllipticityOfLaw::at_unless_above(const Eigen::Matrix2d &F,
                                                        const double bound) const
{
  const Response here = phase.response(F);
  if (!std::isfinite(here.energy))
    return here.energy;
  if (every_wave_is_above(here.tangent, bound * at_rest))
    return {};
  return least_wave(here.tangent).stiffness / at_rest;
}

PhaseEllipticity together(const std::vector<PhaseEllipticity> &phases)
{
  PhaseEllipticity all;
  for (const PhaseEllipticity &phase : phases)
  {
    all.n_triangles += phase.n_triangles;
    all.n_lost += phase.n_lost;
    all.least = std::min(all.least, phase.least);
  }
  return all;
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
    ++p.n_triangles;
    // What lies above changes nothing.
    if (const auto ratio = laws[phase].at_unless_above(F, std::max(0., p.least)))
    {
      p.n_lost += *ratio > 0. ? 0 : 1;
      p.least = std::min(p.least, *ratio);
    }
  }
  return found;
}
} // namespace homespun::verification
