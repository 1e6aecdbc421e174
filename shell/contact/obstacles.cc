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

/// {x: n·x >= offset}, in the frame of the body.
struct ContactPlane
{
  Eigen::Vector3d normal;
  double offset = 0.;
};

/// What a way that begins outside and beyond the thickness runs into.
std::optional<ContactPlane> contact_ahead(const Shape &shape, const Eigen::Vector3d &from,
                                          const Eigen::Vector3d &to, const double thickness)
{
  if (const auto entry = shape.first_entry(from, to))
    return ContactPlane{entry->normal, entry->normal.dot(entry->point) + thickness};
  if (const auto near = shape.nearest(to, thickness))
    return ContactPlane{near->normal, near->normal.dot(to) - near->distance + thickness};
  return std::nullopt;
}

/// f(s)/s of the friction law.
double secant(const double speed, const double slip_speed)
{
  return speed < slip_speed ? (2. - speed / slip_speed) / slip_speed : 1. / speed;
}

/// Whether a half-space holds a vertex that leaves it, too.
enum class Sides
{
  one,
  both
};

/// A vertex and where a step would bring it, in the frame of the body.
struct Approach
{
  int index = 0;
  Eigen::Vector3d after; ///< displacement of the body at the end of the step [m]
  Eigen::Vector3d here;
  Eigen::Vector3d way  = Eigen::Vector3d::Zero(); ///< by its velocity [m]
  Eigen::Vector3d fall = Eigen::Vector3d::Zero(); ///< by gravity [m]
  double step          = 0.;                      ///< h [s]
  double inertia       = 0.;                      ///< m/h^2 [N/m]
  double hard          = 0.;                      ///< stiffness of a contact [N/m]
};

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

  void attach(const BlockMatrix &matrix) override
  {
    ExternalTerm::attach(matrix);
    is_held.clear();
    for (int v = 0; v < matrix.n_vertices(); ++v)
      is_held.push_back(matrix.is_free(v) ? 0 : 1);
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

  void add(const Approach &vertex, const ContactPlane &plane, double stiffness, Sides sides,
           double drag = 0.);
  /// In an equilibrium, and of a vertex that is nearby and goes elsewhere.
  void keep_out(const Approach &vertex, const SurfacePoint &near);
  /// A vertex within the thickness.
  void touch(const Approach &vertex, const SurfacePoint &near);
  /// A vertex that may come within the thickness.
  void look_ahead(const Approach &vertex, const SurfacePoint &near);

  Obstacle obstacle;
  Eigen::VectorXd masses;
  ContactParameters parameters;
  std::vector<char> is_held; ///< of vertices; none: all are free
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
  contacts.clear();
  for (int v = 0; v < static_cast<int>(start.positions.rows()); ++v)
  {
    if (index(v) < is_held.size() && is_held[index(v)] != 0)
      continue; // no force moves it, and whoever holds it would be said to bear a penalty
    Approach vertex;
    vertex.index = v;
    vertex.after = after;
    vertex.here  = start.positions.row(v).transpose() - before;
    if (moving)
    {
      vertex.step    = h;
      vertex.way     = h * start.velocities.row(v).transpose() - (after - before);
      vertex.fall    = h * h * parameters.gravity;
      vertex.inertia = masses(v) / (h * h);
    }
    vertex.hard =
      parameters.stiffness > 0. ? parameters.stiffness : default_stiffness * vertex.inertia;
    const double reach =
      moving ? parameters.thickness + vertex.way.norm() + vertex.fall.norm() : infinite;
    const auto near = obstacle.shape->nearest(vertex.here, reach);
    if (!near)
      continue;
    if (!moving)
      keep_out(vertex, *near);
    else if (near->distance < parameters.thickness)
      touch(vertex, *near);
    else
      look_ahead(vertex, *near);
  }
}

void Contact::add(const Approach &vertex, const ContactPlane &plane, const double stiffness,
                  const Sides sides, const double drag)
{
  contacts.push_back({vertex.index, sides == Sides::one, stiffness, plane.normal,
                      plane.offset + plane.normal.dot(vertex.after), drag,
                      vertex.here + vertex.after});
}

void Contact::keep_out(const Approach &vertex, const SurfacePoint &near)
{
  add(vertex, {near.normal, near.normal.dot(vertex.here) - near.distance + parameters.thickness},
      vertex.hard, Sides::one);
}

void Contact::touch(const Approach &vertex, const SurfacePoint &near)
{
  const double h = vertex.step, t = parameters.thickness;
  const Eigen::Vector3d &n = near.normal;
  // No faster than a fall through the same way: on a floor its weight stops it where contact ends,
  // and it is not thrown.
  const double weight = vertex.fall.norm() / (h * h), gap = t - near.distance,
               rise   = weight > 0.
                          ? std::min(parameters.recovery_speed, std::sqrt(2. * weight * gap))
                          : parameters.recovery_speed;
  const double goal   = std::min(t, near.distance + h * rise),
               offset = n.dot(vertex.here) - near.distance + goal,
               below  = offset - n.dot(vertex.here + vertex.way + vertex.fall);
  if (!(below > 0.))
    return; // it leaves
  const double force = vertex.hard * (goal - near.distance),
               speed = (vertex.way - n.dot(vertex.way) * n).norm() / h;
  add(vertex, {n, offset}, vertex.hard, Sides::both,
      obstacle.friction * force * secant(speed, parameters.slip_speed) / h);
  const Eigen::Vector3d slid = vertex.here + vertex.way + vertex.fall + below * n;
  if (near.distance >= 0.)
    if (const auto entry = obstacle.shape->first_entry(vertex.here, slid))
      add(vertex, {entry->normal, entry->normal.dot(entry->point) + t}, vertex.hard, Sides::both);
}

void Contact::look_ahead(const Approach &vertex, const SurfacePoint &near)
{
  const Eigen::Vector3d &here = vertex.here, &way = vertex.way, &fall = vertex.fall;
  const double t = parameters.thickness;
  if (const auto there = contact_ahead(*obstacle.shape, here, here + way, t))
    add(vertex, *there, vertex.hard, Sides::both);
  else if (const auto fallen = contact_ahead(*obstacle.shape, here, here + way + fall, t);
           fallen && fallen->normal.dot(way) <= 0.)
  {
    // A spring of the vertex' own inertia, so placed that it would fall just onto the half-space.
    const double gap = fallen->offset - fallen->normal.dot(here);
    add(vertex,
        {fallen->normal, fallen->normal.dot(here) + 2. * gap - fallen->normal.dot(way + fall)},
        vertex.inertia, Sides::both);
  }
  else
    keep_out(vertex, near);
}
} // namespace

std::unique_ptr<Term> obstacle_term(const Obstacle &obstacle, const Eigen::VectorXd &masses,
                                    const ContactParameters &parameters)
{
  return std::make_unique<Contact>(obstacle, masses, parameters);
}
} // namespace homespun::shell
