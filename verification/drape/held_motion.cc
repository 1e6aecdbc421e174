// SPDX-License-Identifier: MIT
#include "verification/drape/held_motion.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/lattice.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
namespace
{
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
    : placement(placement)
    , on_edge(2. * meshes::image_tolerance / scene.n1, 2. * meshes::image_tolerance / scene.n2)
{
  for (const HeldPlace &held : scene.held)
  {
    HeldPart place{held, Eigen::RowVector3d::Zero(), {}, {}};
    for (const int v : held.vertices)
    {
      const int i = v % (scene.n1 + 1), j = v / (scene.n1 + 1);
      place.fractions.emplace_back(static_cast<double>(i) / scene.n1,
                                   static_cast<double>(j) / scene.n2);
      place.centre += placement.start(origin + place.fractions.back() * sides) /
                      static_cast<double>(held.vertices.size());
    }
    if (held.vertices.empty())
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
      place.centre = placement.start(origin + f * sides);
    }
    places.push_back(place);
  }
}

HeldMotion::HeldMotion(const Scene &scene, const meshes::ClothMesh &coarse,
                       const std::vector<int> &fine_of_coarse)
{
  const double high = coarse.positions.col(2).maxCoeff(), low = coarse.positions.col(2).minCoeff();
  waist = high - 1e-3 * (high - low);
  std::vector<std::string> faults;
  for (const HeldPlace &held : scene.held)
  {
    HeldPart place{held, Eigen::RowVector3d::Zero(), held.vertices, {}};
    int n = 0;
    for (int v = 0; v < coarse.n_vertices(); ++v)
      if (holds(place, v, coarse))
      {
        place.centre += coarse.positions.row(v);
        ++n;
      }
    place.centre /= std::max(n, 1);
    if (!fine_of_coarse.empty())
      for (int &v : place.vertices)
      {
        const int fine = fine_of_coarse.at(static_cast<std::size_t>(v));
        if (fine < 0)
          faults.push_back(scene.file + ": held vertex " + std::to_string(v) +
                           " of the coarse cloth is no vertex of the full-resolution one; expected "
                           "one on an outline or a lattice point, `waist`, or no reference");
        v = fine;
      }
    places.push_back(place);
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);
}

bool HeldMotion::holds(const HeldPart &place, const Eigen::RowVector2d &f) const
{
  if (place.held.place == "vertices")
    return std::any_of(place.fractions.begin(), place.fractions.end(),
                       [&](const Eigen::RowVector2d &of_vertex)
                       { return ((f - of_vertex).cwiseAbs().array() < on_edge).all(); });
  const std::string &name = place.held.place;
  const auto says         = [&](const char *word) { return name.find(word) != std::string::npos; };
  return (!says("left") || std::abs(f(0)) < on_edge(0)) &&
         (!says("right") || std::abs(f(0) - 1.) < on_edge(0)) &&
         (!says("bottom") || std::abs(f(1)) < on_edge(1)) &&
         (!says("top") || std::abs(f(1) - 1.) < on_edge(1));
}

bool HeldMotion::holds(const HeldPart &place, const int vertex,
                       const meshes::ClothMesh &garment) const
{
  if (place.held.place == "waist")
    return garment.positions(vertex, 2) >= waist;
  return std::count(place.vertices.begin(), place.vertices.end(), vertex) > 0;
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
    const HeldPart &place = places[static_cast<std::size_t>(p)];
    if (placement ? holds(place, placement->fraction(cloth.rest.vertices.row(vertex)))
                  : holds(place, vertex, cloth))
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
  const HeldPart &place = places[static_cast<std::size_t>(p)];
  return moved(place.held.motion, cloth.positions.row(vertex), place.centre, time);
}

std::vector<std::string> HeldMotion::names() const
{
  std::vector<std::string> all;
  for (const HeldPart &part : places)
  {
    all.push_back(part.held.place);
    for (const int v : part.held.vertices)
      all.back() += " " + std::to_string(v);
  }
  return all;
}

bool HeldMotion::moves_after(const double time) const
{
  return std::any_of(places.begin(), places.end(),
                     [&](const HeldPart &place) {
                       return place.held.motion.kind != Motion::Kind::rest &&
                              time < place.held.motion.seconds;
                     });
}

std::vector<std::string> HeldMotion::idle_places(const meshes::ClothMesh &cloth) const
{
  std::vector<bool> is_idle(places.size(), true);
  for (int v = 0; v < cloth.n_vertices(); ++v)
    if (const int p = place_of_vertex(v, cloth); p >= 0)
      is_idle[static_cast<std::size_t>(p)] = false;
  std::vector<std::string> names;
  for (std::size_t p = 0; p < places.size(); ++p)
    if (is_idle[p])
      names.push_back(places[p].held.place);
  return names;
}
} // namespace homespun::verification
