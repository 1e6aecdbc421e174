// SPDX-License-Identifier: MIT
#include "shell/membrane/membrane.h"
#include "verification/drape/drape_verdicts.h"
#include "verification/drape/draped_cell.h"

#include "verification/record/number_text.h"

#include <Eigen/Geometry>

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
                     const double seconds)
{
  constexpr int n    = 1000;
  const auto at      = [&](const int k) { return held.position(vertex, cloth, k * seconds / n); };
  const double first = (at(1) - at(0)).norm(), last = (at(n) - at(n - 1)).norm();
  double way = 0.;
  for (int k = 0; k < n; ++k)
    way += (at(k + 1) - at(k)).norm();
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
      fastest = larger(fastest, speed_at_ends(held, draped.coarse, vertex, motion.seconds));
  }
  constexpr double limit = 3e-3 * (1. + 1e-6);
  return {draped.cell.name + ": what is held starts and ends at rest, moving for " +
            short_text(seconds) + " s (speed in the first and last thousandth over the mean speed)",
          fastest <= limit ? Outcome::pass : Outcome::fail,
          fastest,
          "<= 0.003",
          "evenly accelerated, then braked: a part s of the time makes 3 s^2 - 2 s^3 of the way",
          Kind::program};
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
  constexpr double limit = 1e-9;
  return {draped.cell.name +
            ": a sheet that is turned in space is up-sampled as the one in the plane, turned "
            "(largest distance over the side of a cell)",
          largest <= limit ? Outcome::pass : Outcome::fail,
          largest,
          "<= 1e-09",
          "frame indifference: 0; round-off of 2e-16 of a sheet of up to 1e3 cells, a thousand "
          "times for the edges that strains are taken from",
          Kind::program};
}

Verdict verdict_of_energy(const DrapedCell &draped, const TurnedSheet &sheet)
{
  const shell::Membrane membrane =
    shell::membrane(draped.coarse.rest, {draped.homogenized.stiffness});
  const double in_plane  = shell::membrane_energy<2>(membrane, sheet.plane),
               in_space  = shell::membrane_energy<3>(membrane, sheet.space),
               change    = std::abs(in_space / in_plane - 1.);
  constexpr double limit = 1e-9;
  return {draped.cell.name + ": a sheet that is turned in space has the energy of the one in the "
                             "plane (relative difference)",
          change <= limit ? Outcome::pass : Outcome::fail,
          change,
          "<= 1e-09",
          "frame indifference: 0; round-off of 2e-16 over strains of ten per cent, squared, in the "
          "softest direction",
          Kind::program};
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
