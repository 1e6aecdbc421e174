// SPDX-License-Identifier: MIT
#include "verification/held_motion.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
namespace
{
constexpr double on_edge = 1e-9; ///< of a fraction

Eigen::RowVector3d moved(const Motion &motion, const Eigen::RowVector3d &start,
                         const Eigen::RowVector3d &centre, const double time)
{
  if (motion.kind == Motion::Kind::rest)
    return start;
  // Evenly accelerated from rest and braked to rest: 3 s² − 2 s³.
  const double s = std::clamp(time / motion.seconds, 0., 1.), part = s * s * (3. - 2. * s);
  if (motion.kind == Motion::Kind::translate)
    return start + part * motion.along;
  const Eigen::AngleAxisd turn(part * motion.angle, motion.along.transpose());
  return centre + (turn * (start - centre).transpose()).transpose();
}
} // namespace

SheetPlacement placement_of(const Scene &scene, const Eigen::RowVector2d &origin,
                            const Eigen::Matrix2d &sides)
{
  SheetPlacement placement;
  const Eigen::Matrix2d inverse = sides.inverse();
  placement.fraction            = [origin, inverse](const Eigen::RowVector2d &point)
  { return Eigen::RowVector2d((point - origin) * inverse); };
  const Eigen::RowVector2d middle = origin + 0.5 * (sides.row(0) + sides.row(1));
  const auto fraction             = placement.fraction;
  placement.start = [fraction, middle, standing = scene.standing, centre = scene.centre,
                     height = scene.disturbance](const Eigen::RowVector2d &point)
  {
    const Eigen::RowVector2d arm = point - middle, f = fraction(point);
    // Zero on the outline, and without a symmetry that a buckling cloth could keep by accident.
    const double bump =
      height * 16. * f(0) * (1. - f(0)) * f(1) * (1. - f(1)) * (1. + 0.3 * f(0) - 0.2 * f(1));
    return Eigen::RowVector3d(centre + (standing ? Eigen::RowVector3d(arm(0), bump, arm(1))
                                                 : Eigen::RowVector3d(arm(0), arm(1), bump)));
  };
  return placement;
}

HeldMotion::HeldMotion(const Scene &scene, const SheetPlacement &placement,
                       const Eigen::RowVector2d &origin, const Eigen::Matrix2d &sides)
    : scene(scene)
    , placement(placement)
{
  for (const HeldPlace &held : scene.held)
  {
    Eigen::RowVector2d f(0.5, 0.5);
    if (held.place.find("left") != std::string::npos)
      f(0) = 0.;
    if (held.place.find("right") != std::string::npos)
      f(0) = 1.;
    if (held.place.find("bottom") != std::string::npos)
      f(1) = 0.;
    if (held.place.find("top") != std::string::npos)
      f(1) = 1.;
    places.push_back({held, placement.start(origin + f * sides)});
  }
}

HeldMotion::HeldMotion(const Scene &scene, const meshes::ClothMesh &cloth)
    : scene(scene)
{
  const double high = cloth.positions.col(2).maxCoeff(), low = cloth.positions.col(2).minCoeff();
  waist = high - 1e-3 * (high - low);
  for (const HeldPlace &held : scene.held)
  {
    Place place{held, Eigen::RowVector3d::Zero()};
    int n = 0;
    for (int v = 0; v < cloth.n_vertices(); ++v)
      if (held.place == "waist" ? cloth.positions(v, 2) >= waist
                                : std::count(held.vertices.begin(), held.vertices.end(), v) > 0)
      {
        place.centre += cloth.positions.row(v);
        ++n;
      }
    place.centre /= std::max(n, 1);
    places.push_back(place);
  }
}

bool HeldMotion::holds(const Place &place, const Eigen::RowVector2d &f) const
{
  const std::string &name = place.held.place;
  if (name == "vertices" || name == "waist")
    return false;
  const auto says = [&](const char *word) { return name.find(word) != std::string::npos; };
  return (!says("left") || std::abs(f(0)) < on_edge) &&
         (!says("right") || std::abs(f(0) - 1.) < on_edge) &&
         (!says("bottom") || std::abs(f(1)) < on_edge) &&
         (!says("top") || std::abs(f(1) - 1.) < on_edge);
}

std::optional<Eigen::RowVector3d> HeldMotion::at(const Eigen::RowVector2d &rest_point,
                                                 const double time) const
{
  const Eigen::RowVector2d f = placement->fraction(rest_point);
  for (auto place = places.rbegin(); place != places.rend(); ++place)
    if (holds(*place, f))
      return moved(place->held.motion, placement->start(rest_point), place->centre, time);
  return std::nullopt;
}

int HeldMotion::place_of_vertex(const int vertex, const meshes::ClothMesh &cloth) const
{
  for (int p = static_cast<int>(places.size()) - 1; p >= 0; --p)
  {
    const Place &place        = places[static_cast<std::size_t>(p)];
    const std::vector<int> &v = place.held.vertices;
    if (place.held.place == "vertices" ? std::count(v.begin(), v.end(), vertex) > 0
        : placement ? holds(place, placement->fraction(cloth.rest.vertices.row(vertex)))
                    : place.held.place == "waist" && cloth.positions(vertex, 2) >= waist)
      return p;
  }
  return -1;
}

std::vector<int> HeldMotion::vertices(const meshes::ClothMesh &cloth) const
{
  std::vector<int> held;
  for (int v = 0; v < cloth.n_vertices(); ++v)
    if (place_of_vertex(v, cloth) >= 0)
      held.push_back(v);
  return held;
}

Eigen::RowVector3d HeldMotion::position(const int vertex, const meshes::ClothMesh &cloth,
                                        const double time) const
{
  const int p = place_of_vertex(vertex, cloth);
  if (p < 0)
    return cloth.positions.row(vertex);
  const Place &place = places[static_cast<std::size_t>(p)];
  return moved(place.held.motion, cloth.positions.row(vertex), place.centre, time);
}

bool HeldMotion::moves_after(const double time) const
{
  return std::any_of(places.begin(), places.end(),
                     [&](const Place &place) {
                       return place.held.motion.kind != Motion::Kind::rest &&
                              time < place.held.motion.seconds;
                     });
}
} // namespace homespun::verification
