// SPDX-License-Identifier: MIT
// Sheets bent to cylinders, cells that deflect when they are bent, and curved up-sampling of them.
#pragma once

#include "localization/upsampler.h"
#include "tests/localization/garment_cases.h"

#include <functional>

namespace homespun::localization
{
/// Where a point of the flat sheet lies on a bent one, and the unit normal there.
struct BentPoint
{
  Eigen::RowVector3d position, normal;
};
using Shape = std::function<BentPoint(const Eigen::RowVector2d &)>;

inline constexpr double radius = 0.05;

/// Rolled along a direction, which is isometric: K = t t^T / radius.
inline Shape cylinder(const double angle, const double radius)
{
  return [=](const Eigen::RowVector2d &point)
  {
    const double c = std::cos(angle), s = std::sin(angle), along = c * point(0) + s * point(1),
                 across = c * point(1) - s * point(0), a = along / radius;
    const Eigen::RowVector3d t(c, s, 0.), ruling(-s, c, 0.), up(0., 0., 1.);
    return BentPoint{radius * std::sin(a) * t + across * ruling + radius * (1. - std::cos(a)) * up,
                     std::cos(a) * up - std::sin(a) * t};
  };
}

inline Positions<3> moved(const meshes::Points &rest, const Shape &shape)
{
  Positions<3> current(rest.rows(), 3);
  for (Eigen::Index v = 0; v < rest.rows(); ++v)
    current.row(v) = shape(rest.row(v)).position;
  return current;
}

inline UpsamplerOptions with(const Surface surface, const bool microscopic,
                             const Path path = Path::automatic)
{
  UpsamplerOptions options;
  options.surface     = surface;
  options.microscopic = microscopic;
  options.path        = path;
  return options;
}

struct FineSurface
{
  Positions<3> positions, normals;
};

inline FineSurface curved(const tests::Cloth &cloth, const Positions<3> &current,
                          const UpsamplerOptions &options)
{
  const Upsampler<3, double> upsampler(cloth.cell, cloth.coarse, cloth.sheet, options);
  FineSurface fine;
  upsampler.upsample(current, fine.positions, fine.normals);
  return fine;
}

/// Lets a cell deflect by smooth periodic functions when it is bent, zero at its corners.
inline void let_deflect(meshes::HomogenizedCell &cell)
{
  const meshes::Lattice &lattice = cell.lattice;
  cell.bending.emplace();
  cell.bending->stiffness.setIdentity();
  cell.bending->deflection.resize(cell.mesh.n_vertices(), 3);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = 2. * M_PI * lattice.fractional(cell.mesh.vertices.row(v));
    cell.bending->deflection.row(v) << std::sin(f(0)) - std::sin(f(1)), 1. - std::cos(f(0) + f(1)),
      std::sin(f(0) - f(1)) + 0.5 * std::sin(f(1));
  }
  cell.bending->deflection *= 0.02 * lattice.area();
}

/// A cell without chi that deflects.
inline meshes::HomogenizedCell deflecting_cell(const meshes::Lattice &lattice, const int n)
{
  meshes::HomogenizedCell cell = tests::plain_cell(lattice, n, n);
  let_deflect(cell);
  return cell;
}
} // namespace homespun::localization
