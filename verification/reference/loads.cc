// SPDX-License-Identifier: MIT
#include "verification/reference/loads.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace homespun::verification
{
const std::vector<std::string> &Load::names()
{
  static const std::vector<std::string> all = {"periodic-11", "periodic-22", "periodic-12",
                                               "strip-1",     "strip-2",     "shear-frame"};
  return all;
}

Load::Load(const std::string &name)
    : name(name)
{
  if (!has_free_sides() && name != "periodic-all" &&
      std::find(names().begin(), names().end(), name) == names().end())
    throw meshes::BadInput("unknown load `" + name +
                           "`; expected periodic-11, periodic-22, periodic-12, periodic-all, "
                           "uniaxial-1, uniaxial-2, strip-1, strip-2 or shear-frame");
}

bool Load::is_periodic() const
{
  return name.rfind("periodic", 0) == 0 || has_free_sides();
}

bool Load::has_free_sides() const
{
  return name == "uniaxial-1" || name == "uniaxial-2";
}

Load Load::with_free_strains(FreeStrains strains) const
{
  Load load         = *this;
  load.free_strains = std::move(strains);
  return load;
}

Eigen::Matrix2d Load::gradient(const double strain) const
{
  if (has_free_sides())
  {
    if (!free_strains)
      throw std::logic_error(name + ": the strains of free sides are not known");
    return gradient(strain, free_strains(strain));
  }
  Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
  if (name == "periodic-11")
    F(0, 0) += strain;
  else if (name == "periodic-22")
    F(1, 1) += strain;
  else if (name == "periodic-12")
    F(0, 1) += strain;
  else
    F += strain * Eigen::Matrix2d{{1., 1.}, {0., 0.5}};
  return F;
}

Eigen::Matrix2d Load::gradient(const double strain, const Eigen::Vector2d &of_sides) const
{
  Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
  const int axis    = name == "uniaxial-1" ? 0 : 1;
  F(axis, axis) += strain;
  F(1 - axis, 1 - axis) += of_sides(0);
  F(axis, 1 - axis) += of_sides(1);
  return F;
}

Eigen::Vector2d Load::stress_of_sides(const Eigen::Matrix2d &P) const
{
  const int axis = name == "uniaxial-1" ? 0 : 1;
  return {P(1 - axis, 1 - axis), P(axis, 1 - axis)};
}

int Load::clamped_axis() const
{
  return name == "strip-1" ? 0 : 1;
}

bool Load::holds(const Eigen::RowVector2d &fraction) const
{
  constexpr double close = 1e-5; // far below a mesh width, far above the tolerance of images
  const double f         = fraction(clamped_axis());
  return f < close || f > 1. - close;
}

Eigen::RowVector2d Load::displacement(const Eigen::RowVector2d &fraction,
                                      const Eigen::Matrix2d &sides, const double strain) const
{
  const Eigen::RowVector2d far_edge = name == "shear-frame"
                                        ? sides.row(1).norm() * sides.row(0).normalized()
                                        : Eigen::RowVector2d(sides.row(clamped_axis()));
  return strain * fraction(clamped_axis()) * far_edge;
}

std::vector<int> held_vertices(const Load &load, const meshes::Sheet &sheet,
                               const meshes::Points &rest)
{
  std::vector<int> held;
  if (!load.is_periodic())
    for (int v = 0; v < static_cast<int>(rest.rows()); ++v)
      if (load.holds(sheet.fraction(rest.row(v))))
        held.push_back(v);
  return held;
}

meshes::Points moved_affinely(const Load &load, const meshes::Sheet &sheet,
                              const meshes::Points &rest, const double strain)
{
  meshes::Points moved = rest;
  if (load.is_periodic())
  {
    const Eigen::Matrix2d F = load.gradient(strain);
    for (Eigen::Index v = 0; v < rest.rows(); ++v)
      moved.row(v) = sheet.origin + (rest.row(v) - sheet.origin) * F.transpose();
    return moved;
  }
  const Eigen::Matrix2d sides = sheet.sides();
  for (Eigen::Index v = 0; v < rest.rows(); ++v)
    moved.row(v) += load.displacement(sheet.fraction(rest.row(v)), sides, strain);
  return moved;
}
} // namespace homespun::verification
