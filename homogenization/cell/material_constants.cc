// SPDX-License-Identifier: MIT
#include "homogenization/cell/material_constants.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace homespun::homogenization
{
namespace
{
constexpr double radians_per_degree = M_PI / 180.;

/// dS by a constant of the material's own axes.
Eigen::Matrix3d compliance_derivative(const Phase &phase, const MaterialConstant constant)
{
  Eigen::Matrix3d dS = Eigen::Matrix3d::Zero();
  const double E = phase.E1, nu = phase.nu12;
  switch (constant)
  {
  case MaterialConstant::E:
    dS << -1., nu, 0., nu, -1., 0., 0., 0., -2. * (1. + nu);
    return dS / (E * E);
  case MaterialConstant::nu:
    dS(0, 1) = dS(1, 0) = -1. / E;
    dS(2, 2)            = 2. / E;
    return dS;
  case MaterialConstant::E1:
    dS(0, 0) = -1. / (E * E);
    dS(0, 1) = dS(1, 0) = nu / (E * E);
    return dS;
  case MaterialConstant::E2:
    dS(1, 1) = -1. / (phase.E2 * phase.E2);
    return dS;
  case MaterialConstant::nu12:
    dS(0, 1) = dS(1, 0) = -1. / E;
    return dS;
  case MaterialConstant::G12:
    dS(2, 2) = -1. / (phase.G12 * phase.G12);
    return dS;
  case MaterialConstant::thickness:
  case MaterialConstant::angle:
    break;
  }
  throw std::logic_error(name_of(constant) + " is no constant of a compliance");
}

/// d/d angle of stiffness_rotation().
Eigen::Matrix3d rotation_derivative(const double angle)
{
  const double c2 = std::cos(2. * angle), s2 = std::sin(2. * angle);
  Eigen::Matrix3d d;
  d << -s2, s2, -2. * c2, //
    s2, -s2, 2. * c2,     //
    c2, -c2, -2. * s2;
  return d;
}
} // namespace

std::string name_of(const MaterialConstant constant)
{
  switch (constant)
  {
  case MaterialConstant::E:
    return "E";
  case MaterialConstant::nu:
    return "nu";
  case MaterialConstant::E1:
    return "E1";
  case MaterialConstant::E2:
    return "E2";
  case MaterialConstant::nu12:
    return "nu12";
  case MaterialConstant::G12:
    return "G12";
  case MaterialConstant::thickness:
    return "thickness";
  case MaterialConstant::angle:
    return "angle";
  }
  return "";
}

std::string unit_of(const MaterialConstant constant)
{
  switch (constant)
  {
  case MaterialConstant::nu:
  case MaterialConstant::nu12:
    return "1";
  case MaterialConstant::thickness:
    return "m";
  case MaterialConstant::angle:
    return "deg";
  default:
    return "Pa";
  }
}

bool is_isotropic(const Phase &phase)
{
  const double G = phase.E1 / (2. * (1. + phase.nu12));
  return phase.E1 == phase.E2 &&
         std::abs(phase.G12 - G) <= 4. * std::numeric_limits<double>::epsilon() * G;
}

std::vector<MaterialConstant> constants_of(const Phase &phase)
{
  using Constant = MaterialConstant;
  if (phase.plate)
    return {};
  if (is_isotropic(phase))
    return {Constant::E, Constant::nu, Constant::thickness};
  return {Constant::E1,  Constant::E2,        Constant::nu12,
          Constant::G12, Constant::thickness, Constant::angle};
}

double value_of(const Phase &phase, const MaterialConstant constant)
{
  switch (constant)
  {
  case MaterialConstant::E:
  case MaterialConstant::E1:
    return phase.E1;
  case MaterialConstant::E2:
    return phase.E2;
  case MaterialConstant::nu:
  case MaterialConstant::nu12:
    return phase.nu12;
  case MaterialConstant::G12:
    return phase.G12;
  case MaterialConstant::thickness:
    return phase.thickness;
  case MaterialConstant::angle:
    return phase.angle;
  }
  return 0.;
}

Phase changed(const Phase &phase, const MaterialConstant constant, const double value)
{
  Phase result = phase;
  switch (constant)
  {
  case MaterialConstant::E:
    result.E1 = result.E2 = value;
    result.G12            = value / (2. * (1. + phase.nu12));
    break;
  case MaterialConstant::nu:
    result.nu12 = value;
    result.G12  = phase.E1 / (2. * (1. + value));
    break;
  case MaterialConstant::E1:
    result.E1 = value;
    break;
  case MaterialConstant::E2:
    result.E2 = value;
    break;
  case MaterialConstant::nu12:
    result.nu12 = value;
    break;
  case MaterialConstant::G12:
    result.G12 = value;
    break;
  case MaterialConstant::thickness:
    result.thickness = value;
    break;
  case MaterialConstant::angle:
    result.angle = value;
    break;
  }
  return result;
}

Eigen::Matrix3d plane_stress_derivative(const Phase &phase, const MaterialConstant constant)
{
  if (constant == MaterialConstant::thickness)
    return plane_stress_stiffness(phase) / phase.thickness;
  Phase upright           = phase;
  upright.angle           = 0.;
  const Eigen::Matrix3d c = plane_stress_stiffness(upright);
  const double angle      = phase.angle * radians_per_degree;
  const Eigen::Matrix3d T = stiffness_rotation(angle);
  if (constant == MaterialConstant::angle)
  {
    const Eigen::Matrix3d half = rotation_derivative(angle) * c * T.transpose();
    return radians_per_degree * (half + half.transpose());
  }
  // c = t Q.
  return T * (-c * compliance_derivative(phase, constant) * c / phase.thickness) * T.transpose();
}

Eigen::Matrix3d bending_derivative(const Phase &phase, const MaterialConstant constant)
{
  if (constant == MaterialConstant::thickness)
    return 3. / phase.thickness * bending_stiffness(phase);
  return phase.thickness * phase.thickness / 12. * plane_stress_derivative(phase, constant);
}
} // namespace homespun::homogenization
