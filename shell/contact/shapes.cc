// SPDX-License-Identifier: MIT
#include "shell/contact/shapes.h"

#include "meshes/plain/errors.h"

#include <cmath>
#include <sstream>
#include <utility>

namespace homespun::shell
{
namespace
{
class Plane final : public Shape
{
public:
  Plane(const Eigen::Vector3d &point, const Eigen::Vector3d &normal)
      : normal(normal.normalized())
      , height(this->normal.dot(point))
  {
  }
  std::optional<SurfacePoint> nearest(const Eigen::Vector3d &point,
                                      const double within) const override
  {
    const double distance = normal.dot(point) - height;
    if (distance > within)
      return std::nullopt;
    return SurfacePoint{distance, normal};
  }
  std::optional<SurfaceEntry> first_entry(const Eigen::Vector3d &from,
                                          const Eigen::Vector3d &to) const override
  {
    const double begin = normal.dot(from) - height, end = normal.dot(to) - height;
    if (!(begin >= 0. && end < 0.))
      return std::nullopt;
    const double part = begin / (begin - end);
    return SurfaceEntry{from + part * (to - from), normal, part};
  }
  std::size_t bytes() const override
  {
    return sizeof(*this);
  }

private:
  Eigen::Vector3d normal;
  double height;
};

class Sphere final : public Shape
{
public:
  Sphere(const Eigen::Vector3d &centre, const double radius)
      : centre(centre)
      , radius(radius)
  {
  }
  std::optional<SurfacePoint> nearest(const Eigen::Vector3d &point,
                                      const double within) const override
  {
    const Eigen::Vector3d away = point - centre;
    const double length        = away.norm();
    if (length - radius > within)
      return std::nullopt;
    // At the centre all ways out are equally long; upwards is one of them.
    if (length <= 1e-14 * radius)
      return SurfacePoint{length - radius, Eigen::Vector3d::UnitZ()};
    return SurfacePoint{length - radius, away / length};
  }
  std::optional<SurfaceEntry> first_entry(const Eigen::Vector3d &from,
                                          const Eigen::Vector3d &to) const override
  {
    // |a + s w|² = r²: w² s² + 2 a·w s + (a² − r²) = 0, the smaller root in a form without
    // cancellation.
    const Eigen::Vector3d a = from - centre, w = to - from;
    const double ww = w.squaredNorm(), aw = a.dot(w), c = a.squaredNorm() - radius * radius,
                 discriminant = aw * aw - ww * c;
    if (!(c >= 0. && aw < 0. && discriminant > 0.))
      return std::nullopt;
    const double part = c / (-aw + std::sqrt(discriminant));
    if (part > 1.)
      return std::nullopt;
    const Eigen::Vector3d out = a + part * w;
    return SurfaceEntry{centre + out, out.normalized(), part};
  }
  std::size_t bytes() const override
  {
    return sizeof(*this);
  }

private:
  Eigen::Vector3d centre;
  double radius;
};

class ClosedMesh final : public Shape
{
public:
  explicit ClosedMesh(ClosedSurface surface)
      : surface(std::move(surface))
  {
  }
  std::optional<SurfacePoint> nearest(const Eigen::Vector3d &point,
                                      const double within) const override
  {
    return surface.nearest(point, within);
  }
  std::optional<SurfaceEntry> first_entry(const Eigen::Vector3d &from,
                                          const Eigen::Vector3d &to) const override
  {
    return surface.first_entry(from, to);
  }
  std::size_t bytes() const override
  {
    return surface.bytes();
  }

private:
  ClosedSurface surface;
};
} // namespace

std::shared_ptr<const Shape> plane(const Eigen::Vector3d &point, const Eigen::Vector3d &normal)
{
  if (!point.allFinite() || !normal.allFinite() || !(normal.norm() > 0.))
  {
    std::ostringstream text;
    text << "plane: point (" << point.transpose() << ") m, normal (" << normal.transpose()
         << "); expected finite numbers and a normal that is not zero";
    throw meshes::BadInput(text.str());
  }
  return std::make_shared<Plane>(point, normal);
}

std::shared_ptr<const Shape> sphere(const Eigen::Vector3d &centre, const double radius)
{
  if (!centre.allFinite() || !std::isfinite(radius) || !(radius > 0.))
  {
    std::ostringstream text;
    text << "sphere: centre (" << centre.transpose() << ") m, radius " << radius
         << " m; expected finite numbers and a positive radius";
    throw meshes::BadInput(text.str());
  }
  return std::make_shared<Sphere>(centre, radius);
}

std::shared_ptr<const Shape> closed_mesh(ClosedSurface surface)
{
  return std::make_shared<ClosedMesh>(std::move(surface));
}
} // namespace homespun::shell
