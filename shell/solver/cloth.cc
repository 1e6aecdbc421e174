// SPDX-License-Identifier: MIT
#include "shell/solver/cloth.h"

#include "meshes/plain/errors.h"
#include "shell/membrane/membrane.h"
#include "shell/solver/rigid_motion.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace homespun::shell
{
namespace
{
/// Round-off of energies that are large and cancel.
constexpr double energy_slack = 1e-12;

/// The held vertices in ascending order, each once.
/// @throws BadInput with one message per fault
std::vector<int> checked(const Vectors &positions, const Eigen::VectorXd &masses,
                         std::vector<int> held)
{
  if (masses.size() != positions.rows())
    throw meshes::BadInput("cloth: " + std::to_string(masses.size()) + " masses for " +
                           std::to_string(positions.rows()) + " vertices; expected one each");
  std::vector<std::string> faults;
  if (const int vertex = first_not_finite<3>(positions); vertex >= 0)
    faults.push_back("vertex " + std::to_string(vertex) + ": its position is not finite");
  for (Eigen::Index i = 0; i < masses.size() && faults.size() < 4; ++i)
    if (!(masses(i) > 0.) || !std::isfinite(masses(i)))
      faults.push_back("vertex " + std::to_string(i) + ": has a mass of " +
                       std::to_string(masses(i)) + " kg; expected a positive one");
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
  for (const int vertex : held)
    if (vertex < 0 || vertex >= static_cast<int>(positions.rows()))
      faults.push_back("held vertex " + std::to_string(vertex) +
                       ": does not exist; expected 0 ... " + std::to_string(positions.rows() - 1));
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return held;
}

std::vector<bool> flags(const std::vector<int> &held, const Eigen::Index n)
{
  std::vector<bool> is_held(static_cast<std::size_t>(n), false);
  for (const int vertex : held)
    is_held[static_cast<std::size_t>(vertex)] = true;
  return is_held;
}
} // namespace

Cloth::Cloth(const Vectors &positions, const Eigen::VectorXd &masses,
             const std::vector<int> &held_vertices, const ClothOptions &options)
    : x(positions)
    , v(Vectors::Zero(positions.rows(), 3))
    , target(positions)
    , m(masses)
    , held(checked(positions, masses, held_vertices))
    , options(options)
    , potential(masses, flags(held, masses.size()), options)
{
}

void Cloth::add(std::unique_ptr<Term> term)
{
  if (options.integrator == Integrator::conserving && !term->has_discrete_gradient())
    throw meshes::BadInput(
      "the conserving integrator cannot take the term `" + term->name() +
      "`: what it does to energy and momenta over a step has no discrete gradient; expected "
      "membrane, viscosity, bending, gravity and damping alone: take the linearly implicit or the "
      "implicit one");
  potential.add(std::move(term));
  conserving.reset();
  stored.reset();
}

void Cloth::prescribe(const int vertex, const Eigen::RowVector3d &position)
{
  if (vertex < 0 || vertex >= static_cast<int>(x.rows()) ||
      !std::binary_search(held.begin(), held.end(), vertex) || !position.allFinite())
    throw meshes::BadInput("vertex " + std::to_string(vertex) +
                           ": only a held vertex can be moved, and to a finite position");
  target.row(vertex) = position;
}

void Cloth::set_state(const Vectors &positions, const Vectors &velocities, const double time)
{
  if (positions.rows() != x.rows() || velocities.rows() != x.rows())
    throw meshes::BadInput("cloth: a state of " + std::to_string(positions.rows()) +
                           " positions and " + std::to_string(velocities.rows()) +
                           " velocities; expected " + std::to_string(x.rows()) + " of each");
  for (const auto &[what, values] :
       {std::pair("position", &positions), std::pair("velocity", &velocities)})
    if (const int vertex = first_not_finite<3>(*values); vertex >= 0)
      throw meshes::BadInput("cloth: a state whose vertex " + std::to_string(vertex) + " has a " +
                             what + " that is not finite");
  if (!std::isfinite(time))
    throw meshes::BadInput("cloth: a state at a time that is not finite");
  x      = positions;
  v      = velocities;
  now    = time;
  target = x;
  stored.reset();
}

void Cloth::check_finite(const Vectors &positions, const double h) const
{
  const int vertex = first_not_finite<3>(positions);
  if (vertex < 0)
    return;
  std::ostringstream text;
  text << "step " << n_step + 1 << " of " << h << " s: vertex " << vertex << " is not finite";
  throw meshes::NotConverged(text.str(), {});
}

/// What makes the energy of some positions infinite, where derivatives say nothing; else empty.
std::string Cloth::why_infinite(const Vectors &positions) const
{
  for (const auto &term : terms())
    if (const std::string why = term->why_infinite(positions); !why.empty())
      return why + ", whose energy is infinite";
  return {};
}

/// Refuses a start of infinite energy that no force leads out of, and one of a conserving step,
/// whose forces are quotients of energies.
void Cloth::check_start() const
{
  Vectors start = x;
  if (options.integrator == Integrator::implicit)
    set_held(start);
  const std::string why = why_infinite(start);
  if (why.empty())
    return;
  Vectors forces = Vectors::Zero(x.rows(), 3);
  for (const auto &term : terms())
    if (!term->why_infinite(start).empty())
      term->add_gradient(start, forces);
  if (options.integrator == Integrator::conserving || forces.isZero(0.))
    throw meshes::BadInput("cloth: a step begins with " + why +
                           "; expected a finite one, or a yarn that is pulled");
}

void Cloth::set_held(Vectors &positions) const
{
  for (const int vertex : held)
    positions.row(vertex) = target.row(vertex);
}

/// The velocity of the frame in which a step may not raise the energy: no term does work, and no
/// handle moves there. It moves with the handles where all go the same way and nothing but they
/// acts from outside; else there may be none.
std::optional<Eigen::RowVector3d> Cloth::closed_frame(const double h) const
{
  const auto is_all = [&](const auto &property)
  { return std::all_of(terms().begin(), terms().end(), property); };
  if (!is_all([](const auto &term) { return term->has_energy() && !term->does_work(); }))
    return std::nullopt;
  if (held.empty() || is_moved_by(Eigen::RowVector3d::Zero()))
    return Eigen::RowVector3d::Zero();
  const Eigen::RowVector3d way = target.row(held[0]) - x.row(held[0]);
  if (is_moved_by(way) && is_all([](const auto &term) { return term->is_internal(); }))
    return way / h;
  return std::nullopt;
}

/// Whether all handles go the same way, but for round-off.
bool Cloth::is_moved_by(const Eigen::RowVector3d &way) const
{
  const double round_off = way.isZero(0.) ? 0. : energy_slack * x.cwiseAbs().maxCoeff();
  return std::all_of(
    held.begin(), held.end(),
    [&](const int vertex)
    { return (target.row(vertex) - x.row(vertex) - way).cwiseAbs().maxCoeff() <= round_off; });
}

double Cloth::kinetic_energy_in(const Eigen::RowVector3d &frame, const Vectors &velocities) const
{
  return 0.5 * m.dot((velocities.rowwise() - frame).rowwise().squaredNorm());
}

/// Whether nothing acts from outside, so that both momenta stay.
bool Cloth::is_alone() const
{
  return held.empty() && std::all_of(terms().begin(), terms().end(),
                                     [](const auto &term) { return term->is_internal(); });
}

/// Where Newton's method begins: a free cloth where its integrator would take a rigid body with its
/// momenta, so that no part of them is lost in a line search.
Vectors Cloth::start_of_solve(const double h) const
{
  if (held.empty())
    return moved_rigidly(m, x, v, h,
                         options.integrator == Integrator::conserving ? RigidStep::midpoint
                                                                      : RigidStep::implicit_euler);
  Vectors start = x;
  set_held(start);
  return start;
}

/// Where a linearly implicit step ends: one Newton step of Φ, of a cloth with handles from x_n.
Vectors Cloth::linear_step(const Vectors &inertial, const double h, StepReport &report)
{
  const Vectors from = held.empty() ? start_of_solve(h) : x;
  Vectors next = from + potential.linear_step(from, (inertial - from) / h, target - x, h, report);
  set_held(next);
  check_finite(next, h);
  return next;
}

/// Whether a linearly implicit step raises the energy of a cloth on which nothing does work, or
/// otherwise Φ.
bool Cloth::is_overshot(const Vectors &next, const Vectors &inertial, const double h) const
{
  const auto has_grown = [](const double before, const double after, const double size)
  { return !(after <= before + energy_slack * (std::abs(before) + std::abs(size))); };
  if (const auto frame = closed_frame(h))
  {
    const double stored_then = potential.stored_energy(next);
    return has_grown(kinetic_energy_in(*frame, v) + stored_energy(),
                     kinetic_energy_in(*frame, (next - x) / h) + stored_then, stored_then);
  }
  if (!potential.has_energy())
    return false;
  Vectors start = x;
  set_held(start);
  const double after = potential.value(next, inertial, 1. / (h * h));
  return has_grown(potential.value(start, inertial, 1. / (h * h)), after, after);
}

/// The minimum of Φ; of a linearly implicit step that is guarded at least a place that is not
/// overshot.
Vectors Cloth::minimum(const Vectors &inertial, const double h, StepReport &report)
{
  Vectors next = start_of_solve(h);
  potential.minimize(
    inertial, h,
    [&](const Vectors &found) {
      return options.integrator == Integrator::linearly_implicit &&
             !is_overshot(found, inertial, h);
    },
    next, report);
  check_finite(next, h);
  return next;
}

/// Where a conserving step ends.
Vectors Cloth::conserved(const double h, StepReport &report)
{
  if (!conserving)
    conserving = std::make_unique<ConservingStep>(m, flags(held, m.size()),
                                                  static_cast<SolverOptions>(options));
  Vectors next = start_of_solve(h);
  conserving->solve(terms(), x, v, h, next, report);
  check_finite(next, h);
  return next;
}

void Cloth::try_step(const double h, StepReport &report)
{
  for (const auto &term : terms())
    term->begin_step({x, v, now, h});
  const auto frame              = closed_frame(h);
  const double energy           = frame ? kinetic_energy_in(*frame, v) + stored_energy() : 0.;
  const Eigen::RowVector3d spin = angular_momentum();
  const Vectors inertial        = x + h * v;
  Vectors next;
  switch (options.integrator)
  {
  case Integrator::linearly_implicit:
    next = linear_step(inertial, h, report);
    if (is_overshot(next, inertial, h))
    {
      ++report.guarded;
      next = minimum(inertial, h, report);
    }
    break;
  case Integrator::implicit:
    next = minimum(inertial, h, report);
    break;
  case Integrator::conserving:
    next = conserved(h, report);
    break;
  }
  const Vectors seen = (next - x) / h;
  v                  = options.integrator == Integrator::conserving ? (2. * seen - v).eval() : seen;
  for (const int vertex : held)
    v.row(vertex) = seen.row(vertex);
  x = next;
  stored.reset();
  if (frame)
    report.energy_gained += std::max(0., kinetic_energy_in(*frame, v) + stored_energy() - energy);
  if (is_alone())
    report.spin_lost += (angular_momentum() - spin).norm();
}

StepReport Cloth::step(const double h)
{
  if (!(h > 0.) || !std::isfinite(h))
    throw meshes::BadInput("time step: found " + std::to_string(h) +
                           " s; expected a positive number");
  check_start();
  if (options.integrator != Integrator::conserving)
    potential.prepare();
  StepReport report;
  const Vectors old_x = x, old_v = v, final_target = target;
  const double begin = now;
  // Parts of the step still to go; one that fails is cut in two.
  double done = 0., part = 1.;
  while (done < 1.)
  {
    const double until = std::min(1., done + part);
    target = until == 1. ? final_target : (old_x + until * (final_target - old_x)).eval();
    const Vectors before_x = x, before_v = v;
    try
    {
      try_step((until - done) * h, report);
      done = until;
      now  = begin + done * h;
    }
    catch (const meshes::NotConverged &failure)
    {
      x = before_x;
      v = before_v;
      stored.reset();
      part *= 0.5;
      if (++report.cuts > options.max_cuts)
      {
        x                     = old_x;
        v                     = old_v;
        target                = final_target;
        now                   = begin;
        const std::string why = why_infinite(x);
        throw meshes::NotConverged(
          (why.empty() ? why : "the step begins with " + why + ": ") + failure.what() + " (step " +
            std::to_string(n_step + 1) + ", time " + std::to_string(begin) + " s, cut " +
            std::to_string(options.max_cuts) +
            " times); try a smaller time step, damping, or look for a coarse triangle that is "
            "crushed",
          failure.residual_history());
      }
    }
  }
  target = final_target;
  ++n_step;
  return report;
}

double Cloth::kinetic_energy() const
{
  return kinetic_energy_in(Eigen::RowVector3d::Zero(), v);
}

double Cloth::stored_energy() const
{
  if (!stored)
    stored = potential.stored_energy(x);
  return *stored;
}

Eigen::RowVector3d Cloth::momentum() const
{
  return m.transpose() * v;
}

Eigen::RowVector3d Cloth::angular_momentum() const
{
  return shell::angular_momentum(m, x, v);
}

Vectors Cloth::gradient() const
{
  Vectors sum = Vectors::Zero(x.rows(), 3);
  for (const auto &term : terms())
    term->add_gradient(x, sum);
  return sum;
}

std::size_t Cloth::bytes() const
{
  return static_cast<std::size_t>(x.size()) * 4 * sizeof(double) + potential.bytes() +
         (conserving ? conserving->bytes() : 0);
}
} // namespace homespun::shell
