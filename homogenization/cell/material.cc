// SPDX-License-Identifier: MIT
#include "homogenization/cell/material.h"

#include <cmath>
#include <sstream>

namespace homespun::homogenization
{
Phase isotropic(const std::string &name, const double E, const double nu, const double thickness,
                const double density)
{
  return {name, E, E, nu, E / (2. * (1. + nu)), 0., thickness, density};
}

Phase layered(const std::string &name, const std::vector<Layer> &layers, const double density)
{
  double thickness = 0.;
  Eigen::Array2d A = Eigen::Array2d::Zero(), B = A, D = A; // of a11 + a12, a11 − a12
  for (const Layer &layer : layers)
  {
    const Eigen::Array2d Q = layer.E / Eigen::Array2d(1. - layer.nu, 1. + layer.nu);
    const double t = layer.thickness, z = thickness + 0.5 * t;
    A += t * Q;
    B += t * z * Q;
    D += (t * z * z + t * t * t / 12.) * Q;
    thickness += t;
  }
  D -= B * B / A;
  // q+ = E/(1 − nu), q- = E/(1 + nu).
  const auto poisson = [](const Eigen::Array2d &q) { return (q(0) - q(1)) / q.sum(); };
  const auto young   = [](const Eigen::Array2d &q) { return 2. * q.prod() / q.sum(); };
  Phase phase        = isotropic(name, young(A) / thickness, poisson(A), thickness, density);
  phase.plate =
    Plate{12. / (thickness * thickness * thickness) * young(D), poisson(D), B.sum() / A.sum()};
  return phase;
}

double coupling(const Phase &phase, const Phase &other)
{
  const auto neutral = [](const Phase &of)
  { return of.plate ? of.plate->neutral : 0.5 * of.thickness; };
  const double h = neutral(phase) - neutral(other);
  return std::abs(h) /
         std::sqrt(h * h + bending_stiffness(phase)(0, 0) / plane_stress_stiffness(phase)(0, 0));
}

Eigen::Matrix3d stiffness_rotation(const double angle)
{
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d turn;
  turn << c * c, s * s, -2. * c * s, //
    s * s, c * c, 2. * c * s,        //
    c * s, -c * s, c * c - s * s;
  return turn;
}

Eigen::Matrix3d plane_stress_stiffness(const Phase &phase)
{
  const double nu21    = phase.nu12 * phase.E2 / phase.E1;
  const double regular = 1. - phase.nu12 * nu21;
  Eigen::Matrix3d own_axes;
  own_axes << phase.E1 / regular, phase.nu12 * phase.E2 / regular, 0., //
    phase.nu12 * phase.E2 / regular, phase.E2 / regular, 0.,           //
    0., 0., phase.G12;
  if (phase.angle == 0.)
    return phase.thickness * own_axes;
  const Eigen::Matrix3d turn = stiffness_rotation(phase.angle * M_PI / 180.);
  return phase.thickness * (turn * own_axes * turn.transpose());
}

Eigen::Matrix3d bending_stiffness(const Phase &phase)
{
  const Phase bent = phase.plate ? isotropic(phase.name, phase.plate->E, phase.plate->nu,
                                             phase.thickness, phase.density)
                                 : phase;
  return phase.thickness * phase.thickness / 12. * plane_stress_stiffness(bent);
}

std::vector<std::string> faults_of(const Phase &phase)
{
  std::vector<std::string> faults;
  const auto require_positive = [&](const double value, const char *quantity, const char *unit)
  {
    if (value > 0. && std::isfinite(value))
      return true;
    std::ostringstream text;
    text << "phase `" << phase.name << "` has " << quantity << " " << value << " " << unit
         << "; expected a positive number";
    faults.push_back(text.str());
    return false;
  };
  bool moduli = require_positive(phase.E1, "Young's modulus", "Pa");
  if (phase.E2 != phase.E1)
    moduli &= require_positive(phase.E2, "second Young's modulus", "Pa");
  require_positive(phase.thickness, "thickness", "m");
  require_positive(phase.density, "density", "kg/m^3");
  if (moduli && !(phase.nu12 * phase.nu12 < phase.E1 / phase.E2))
  {
    std::ostringstream text;
    text << "phase `" << phase.name << "` has Poisson's ratio " << phase.nu12
         << "; expected a number strictly between " << -std::sqrt(phase.E1 / phase.E2) << " and "
         << std::sqrt(phase.E1 / phase.E2)
         << ", outside of which plane stress stores negative energy"
         << (phase.E1 / phase.E2 > 0.25
               ? " (0.5 is fine)"
               : ": E1 is small beside E2, and nu12 = nu21 E1/E2 with it; was nu21 given?");
    faults.push_back(text.str());
  }
  else if (phase.E1 != phase.E2 || faults.empty())
    require_positive(phase.G12, "shear modulus", "Pa");
  if (!std::isfinite(phase.angle))
    faults.push_back("phase `" + phase.name +
                     "` has an angle that is not finite; expected degrees");
  return faults;
}
} // namespace homespun::homogenization
