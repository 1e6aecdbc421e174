// SPDX-License-Identifier: MIT
#include "verification/reference/loads.h"

#include "meshes/plain/errors.h"

#include <stdexcept>
#include <utility>

namespace homespun::verification
{
namespace
{
const LoadProperties &properties_of(const std::string &name)
{
  std::vector<std::string> known;
  for (const LoadProperties &load : load_table)
  {
    if (name == load.name)
      return load;
    known.emplace_back(load.name);
  }
  throw meshes::BadInput("unknown load `" + name + "`; expected " + meshes::one_of(known));
}
} // namespace

const std::vector<std::string> &Load::names()
{
  static const std::vector<std::string> all = []()
  {
    std::vector<std::string> names;
    for (const LoadProperties &load : load_table)
      if (load.is_in_default_study)
        names.emplace_back(load.name);
    return names;
  }();
  return all;
}

std::vector<std::string> Load::names_of(const LoadKind kind)
{
  std::vector<std::string> names;
  for (const LoadProperties &load : load_table)
    if (load.kind == kind)
      names.emplace_back(load.name);
  return names;
}

Load::Load(const std::string &name)
    : name(name)
    , properties(&properties_of(name))
{
}

bool Load::is_periodic() const
{
  return properties->kind != LoadKind::sheet;
}

bool Load::has_free_sides() const
{
  return properties->kind == LoadKind::free_sides;
}

int Load::axis() const
{
  return properties->axis;
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
  const auto &[G11, G12, G21, G22] = properties->gradient;
  return Eigen::Matrix2d::Identity() + strain * Eigen::Matrix2d{{G11, G12}, {G21, G22}};
}

Eigen::Matrix2d Load::gradient(const double strain, const Eigen::Vector2d &of_sides) const
{
  Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
  const int axis    = properties->axis;
  F(axis, axis) += strain;
  F(1 - axis, 1 - axis) += of_sides(0);
  F(axis, 1 - axis) += of_sides(1);
  return F;
}

Eigen::Vector2d Load::stress_of_sides(const Eigen::Matrix2d &P) const
{
  const int axis = properties->axis;
  return {P(1 - axis, 1 - axis), P(axis, 1 - axis)};
}

bool Load::holds(const Eigen::RowVector2d &fraction) const
{
  constexpr double close = 1e-5; // far below a mesh width, far above the tolerance of images
  const double f         = fraction(axis());
  return f < close || f > 1. - close;
}

Eigen::RowVector2d Load::displacement(const Eigen::RowVector2d &fraction,
                                      const Eigen::Matrix2d &sides, const double strain) const
{
  const int moved                = properties->moved_axis;
  const Eigen::RowVector2d apart = sides.row(axis());
  const Eigen::RowVector2d motion =
    moved == axis() ? apart : apart.norm() * sides.row(moved).normalized();
  return strain * fraction(axis()) * motion;
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
