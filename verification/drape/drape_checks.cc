// SPDX-License-Identifier: MIT
#include "shell/membrane/membrane.h"
#include "verification/drape/drape_verdicts.h"
#include "verification/drape/draped_cell.h"

#include "verification/record/claim.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
namespace
{
/// The longest motion of a scene [s]; zero where nothing moves.
double seconds_of_motion(const Scene &scene)
{
  double seconds = 0.;
  for (const HeldPlace &place : scene.held)
    if (place.motion.kind != Motion::Kind::rest)
      seconds = std::max(seconds, place.motion.seconds);
  return seconds;
}

/// Speed in the first and the last thousandth of a held vertex's motion, over its mean speed; the
/// larger of both.
double speed_at_ends(const HeldMotion &held, const meshes::ClothMesh &cloth, const int vertex,
                     const Motion &motion)
{
  constexpr int n = 1000;
  // Chords stand for arcs: a thousand a turn, which no step resolves beyond the most turns here.
  const int chords = motion.kind == Motion::Kind::rotate
                       ? 1 + static_cast<int>(std::min(std::abs(motion.angle) / (2. * M_PI), 1e5))
                       : 1;
  const auto at    = [&](const int k)
  { return held.position(vertex, cloth, k * motion.seconds / (n * chords)); };
  double first = 0., last = 0., way = 0.;
  for (int k = 0; k < n * chords; ++k)
  {
    const double chord = (at(k + 1) - at(k)).norm();
    way += chord;
    if (k < chords)
      first += chord;
    if (k >= (n - 1) * chords)
      last += chord;
  }
  return way > 0. ? n * std::max(first, last) / way : 0.;
}

Verdict verdict_of_motion(const DrapedCell &draped, const double seconds)
{
  const HeldMotion held = draped.coarse_motion();
  double fastest        = 0.;
  for (const int vertex : held.vertices(draped.coarse))
  {
    const int place      = held.place_of_vertex(vertex, draped.coarse);
    const Motion &motion = draped.scene.held[static_cast<std::size_t>(place)].motion;
    if (motion.kind != Motion::Kind::rest)
      fastest = larger(fastest, speed_at_ends(held, draped.coarse, vertex, motion));
  }
  constexpr double limit = 3e-3 * (1. + 1e-6);
  return at_most("held-motion", {{"cell", draped.cell.name}, {"seconds", seconds}}, fastest, limit);
}

/// The coarse sheet with strains of some ten per cent that change over it and no reflection, in the
/// plane and turned in space.
struct TurnedSheet
{
  explicit TurnedSheet(const DrapedCell &draped)
      : turn(
          Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.6, -0.5, 0.7).normalized()).toRotationMatrix())
      , shift(Eigen::RowVector3d(0.3, -0.2, 0.1) * draped.side)
  {
    const meshes::Points &rest   = draped.coarse.rest.vertices;
    const Eigen::RowVector2d low = rest.colwise().minCoeff();
    const double size            = (rest.colwise().maxCoeff() - low).maxCoeff();
    plane.resize(rest.rows(), 2);
    space.resize(rest.rows(), 3);
    for (Eigen::Index v = 0; v < rest.rows(); ++v)
    {
      const double x = (rest(v, 0) - low(0)) / size, y = (rest(v, 1) - low(1)) / size;
      plane.row(v) << size * (1.1 * x + 0.1 * y + 0.05 * x * y), size * (0.95 * y + 0.07 * x * x);
      space.row(v) = turned(plane.row(v));
    }
  }

  Eigen::RowVector3d turned(const Eigen::RowVector2d &point) const
  {
    return point * turn.leftCols<2>().transpose() + shift;
  }

  const Eigen::Matrix3d turn;
  const Eigen::RowVector3d shift;
  shell::Positions<2> plane;
  shell::Positions<3> space;
};

Verdict verdict_of_upsampling(const DrapedCell &draped, const TurnedSheet &sheet)
{
  const Method method("localized");
  localization::Upsampler<2, double>::Fine in_plane;
  localization::Upsampler<2, double>(draped.homogenized, draped.coarse.rest, *draped.sheet,
                                     method.options(draped.law))
    .upsample(sheet.plane, in_plane);
  localization::Upsampler<3, double>::Fine in_space;
  draped.upsampler<double>(method).upsample(sheet.space, in_space);
  double largest = 0.;
  for (Eigen::Index v = 0; v < in_plane.rows(); ++v)
    largest = larger(largest, (sheet.turned(in_plane.row(v)) - in_space.row(v)).norm());
  largest /= draped.side;
  return at_most("turned-upsampling", {{"cell", draped.cell.name}}, largest, 1e-9);
}

Verdict verdict_of_energy(const DrapedCell &draped, const TurnedSheet &sheet)
{
  const shell::Membrane membrane =
    shell::membrane(draped.coarse.rest, {draped.homogenized.stiffness});
  const double in_plane = shell::membrane_energy<2>(membrane, sheet.plane),
               in_space = shell::membrane_energy<3>(membrane, sheet.space),
               change   = std::abs(in_space / in_plane - 1.);
  return at_most("turned-energy", {{"cell", draped.cell.name}}, change, 1e-9);
}
} // namespace

std::vector<Verdict> checks_of_scene(const DrapedCell &draped)
{
  std::vector<Verdict> checks;
  if (const double seconds = seconds_of_motion(draped.scene); seconds > 0.)
    checks.push_back(verdict_of_motion(draped, seconds));
  if (draped.sheet)
  {
    const TurnedSheet sheet(draped);
    checks.push_back(verdict_of_upsampling(draped, sheet));
    checks.push_back(verdict_of_energy(draped, sheet));
  }
  return checks;
}
} // namespace homespun::verification
