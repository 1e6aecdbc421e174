// SPDX-License-Identifier: MIT
#include "shell/contact/obstacles.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/index.h"
#include "shell/terms/external_term.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace homespun::shell
{
namespace
{
// Stiffness in m/h²: a vertex that lands has 1/1000 of its overshoot left.
constexpr double default_stiffness = 1000.;
constexpr double infinite          = std::numeric_limits<double>::infinity();

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

/// {x: n·x >= offset} that a way which begins outside and beyond the thickness runs into.
struct Ahead
{
  Eigen::Vector3d normal;
  double offset = 0.;
};

std::optional<Ahead> contact_ahead(const Shape &shape, const Eigen::Vector3d &from,
                                   const Eigen::Vector3d &to, const double thickness)
{
  if (const auto entry = shape.first_entry(from, to))
    return Ahead{entry->normal, entry->normal.dot(entry->point) + thickness};
  if (const auto near = shape.nearest(to, thickness))
    return Ahead{near->normal, near->normal.dot(to) - near->distance + thickness};
  return std::nullopt;
}

/// f(s)/s of the friction law.
double secant(const double speed, const double slip_speed)
{
  return speed < slip_speed ? (2. - speed / slip_speed) / slip_speed : 1. / speed;
}

class Contact final : public ExternalTerm
{
public:
  Contact(const Obstacle &obstacle, const Eigen::VectorXd &masses,
          const ContactParameters &parameters)
      : obstacle(obstacle)
      , masses(masses)
      , parameters(parameters)
  {
    std::vector<std::string> faults;
    const auto expect = [&](const bool holds, const std::string &what, const double found,
                            const std::string &expected)
    {
      std::ostringstream text;
      text << "obstacle " << obstacle.name << ": " << what << " is " << found << "; expected "
           << expected;
      if (!holds)
        faults.push_back(text.str());
    };
    if (!obstacle.shape)
      faults.push_back("obstacle " + obstacle.name + ": has no shape");
    expect(obstacle.friction >= 0. && std::isfinite(obstacle.friction), "friction",
           obstacle.friction, "a number not below 0");
    expect(parameters.thickness > 0. && std::isfinite(parameters.thickness), "thickness",
           parameters.thickness, "a positive length in m");
    expect(parameters.stiffness >= 0. && std::isfinite(parameters.stiffness), "stiffness",
           parameters.stiffness, "N/m, or 0 for a multiple of m/h^2");
    expect(parameters.slip_speed > 0. && std::isfinite(parameters.slip_speed), "slip speed",
           parameters.slip_speed, "a positive speed in m/s");
    expect(parameters.recovery_speed > 0., "recovery speed", parameters.recovery_speed,
           "a positive speed in m/s");
    expect(parameters.gravity.allFinite(), "gravity", parameters.gravity.norm(), "finite numbers");
    if (masses.size() > 0)
      expect(masses.allFinite() && masses.minCoeff() > 0., "the smallest vertex mass",
             masses.minCoeff(), "a positive mass in kg: vertices without triangles have none");
    if (!faults.empty())
      throw meshes::BadInput(faults);
  }

  std::string name() const override
  {
    return "contact with " + obstacle.name;
  }

  void begin_step(const StepStart &start) override;

  double energy(const Vectors &x) const override
  {
    double sum = 0.;
    for (const HalfSpace &contact : contacts)
    {
      const Eigen::Vector3d at = x.row(contact.vertex).transpose();
      if (const double depth = contact.offset - contact.normal.dot(at);
          depth > 0. || !contact.one_sided)
        sum += 0.5 * contact.stiffness * depth * depth;
      if (contact.drag > 0.)
        sum += 0.5 * contact.drag * contact.tangential(at - contact.carried).squaredNorm();
    }
    return sum;
  }

  void add_gradient(const Vectors &x, Vectors &gradient) const override
  {
    for (const HalfSpace &contact : contacts)
    {
      const Eigen::Vector3d at = x.row(contact.vertex).transpose();
      if (const double depth = contact.offset - contact.normal.dot(at);
          depth > 0. || !contact.one_sided)
        gradient.row(contact.vertex) -= contact.stiffness * depth * contact.normal.transpose();
      if (contact.drag > 0.)
        gradient.row(contact.vertex) +=
          contact.drag * contact.tangential(at - contact.carried).transpose();
    }
  }

  void add_derivatives(const Vectors &x, Hessian, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    add_gradient(x, gradient);
    for (const HalfSpace &contact : contacts)
    {
      const Eigen::Vector3d &n = contact.normal;
      Eigen::Matrix3d block    = contact.drag * (Eigen::Matrix3d::Identity() - n * n.transpose());
      if (!contact.one_sided || contact.offset > n.dot(x.row(contact.vertex).transpose()))
        block += contact.stiffness * n * n.transpose();
      matrix.add(places[index(contact.vertex)], block);
    }
  }

  std::size_t bytes() const override
  {
    return obstacle.shape->bytes() + contacts.capacity() * sizeof(HalfSpace) +
           places.size() * sizeof(BlockMatrix::Slot) +
           static_cast<std::size_t>(masses.size()) * sizeof(double);
  }

private:
  struct HalfSpace
  {
    int vertex;
    bool one_sided;
    double stiffness;        ///< k [N/m]
    Eigen::Vector3d normal;  ///< n
    double offset;           ///< b [m]
    double drag;             ///< c [N/m]
    Eigen::Vector3d carried; ///< x_n moved along with the body [m]

    Eigen::Vector3d tangential(const Eigen::Vector3d &way) const
    {
      return way - normal.dot(way) * normal;
    }
  };

  Obstacle obstacle;
  Eigen::VectorXd masses;
  ContactParameters parameters;
  std::vector<HalfSpace> contacts;
};

void Contact::begin_step(const StepStart &start)
{
  const double h    = start.step;
  const bool moving = std::isfinite(h);
  if (!moving && parameters.stiffness == 0.)
    throw meshes::BadInput(
      "obstacle " + obstacle.name +
      ": stiffness is 0, a multiple of m/h^2; an equilibrium has no time step h: give a stiffness "
      "in N/m");
  const auto displaced = [this](const double time) -> Eigen::Vector3d
  { return obstacle.displacement ? obstacle.displacement(time) : Eigen::Vector3d::Zero(); };
  const Eigen::Vector3d before = displaced(start.time),
                        after  = moving ? displaced(start.time + h) : before;
  const double t               = parameters.thickness;
  contacts.clear();
  for (int v = 0; v < static_cast<int>(start.positions.rows()); ++v)
  {
    // All in the frame of the body.
    const Eigen::Vector3d here = start.positions.row(v).transpose() - before;
    Eigen::Vector3d way = Eigen::Vector3d::Zero(), fall = way;
    if (moving)
    {
      way  = h * start.velocities.row(v).transpose() - (after - before);
      fall = h * h * parameters.gravity;
    }
    const double reach = moving ? t + way.norm() + fall.norm() : infinite;
    const auto near    = obstacle.shape->nearest(here, reach);
    if (!near)
      continue;
    HalfSpace contact;
    contact.vertex       = v;
    contact.carried      = here + after;
    const double inertia = moving ? masses(v) / (h * h) : 0.;
    const double hard =
      parameters.stiffness > 0. ? parameters.stiffness : default_stiffness * inertia;
    // n·x = offset is said in the frame of the body.
    const auto add = [&](const Eigen::Vector3d &normal, const double offset, const double stiffness,
                         const bool one_sided, const double drag)
    {
      contact.normal    = normal;
      contact.offset    = offset + normal.dot(after);
      contact.stiffness = stiffness;
      contact.one_sided = one_sided;
      contact.drag      = drag;
      contacts.push_back(contact);
    };
    if (!moving)
    {
      add(near->normal, near->normal.dot(here) - near->distance + t, hard, true, 0.);
      continue;
    }

    if (near->distance < t) // it touches
    {
      const Eigen::Vector3d &n = near->normal;
      const double goal        = std::min(t, near->distance + h * parameters.recovery_speed),
                   offset      = n.dot(here) - near->distance + goal,
                   below       = offset - n.dot(here + way + fall);
      if (!(below > 0.))
        continue; // it leaves
      const double force = hard * (goal - near->distance),
                   speed = (way - n.dot(way) * n).norm() / h;
      add(n, offset, hard, false,
          obstacle.friction * force * secant(speed, parameters.slip_speed) / h);
      const Eigen::Vector3d slid = here + way + fall + below * n;
      if (near->distance >= 0.)
        if (const auto entry = obstacle.shape->first_entry(here, slid))
          add(entry->normal, entry->normal.dot(entry->point) + t, hard, false, 0.);
      continue;
    }
    if (const auto there = contact_ahead(*obstacle.shape, here, here + way, t))
      add(there->normal, there->offset, hard, false, 0.);
    else if (const auto fallen = contact_ahead(*obstacle.shape, here, here + way + fall, t);
             fallen && fallen->normal.dot(way) <= 0.)
    {
      // A spring of the vertex' own inertia, so placed that it would fall just onto the half-space.
      const double gap = fallen->offset - fallen->normal.dot(here);
      add(fallen->normal, fallen->normal.dot(here) + 2. * gap - fallen->normal.dot(way + fall),
          inertia, false, 0.);
    }
    else
      add(near->normal, near->normal.dot(here) - near->distance + t, hard, true, 0.);
  }
}
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

std::unique_ptr<Term> obstacle_term(const Obstacle &obstacle, const Eigen::VectorXd &masses,
                                    const ContactParameters &parameters)
{
  return std::make_unique<Contact>(obstacle, masses, parameters);
}
} // namespace homespun::shell
