// SPDX-License-Identifier: MIT
#include "shell/cloth.h"

#include "meshes/errors.h"
#include "shell/rigid_motion.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace homespun::shell
{
namespace
{
/// Round-off of energies that are large and cancel.
constexpr double energy_slack = 1e-12;

int first_not_finite(const Vectors &values)
{
  if (values.allFinite())
    return -1;
  int vertex = 0;
  while (values.row(vertex).allFinite())
    ++vertex;
  return vertex;
}

/// The held vertices in ascending order, each once.
/// @throws BadInput with one message per fault
std::vector<int> checked(const Vectors &positions, const Eigen::VectorXd &masses,
                         std::vector<int> held)
{
  if (masses.size() != positions.rows())
    throw meshes::BadInput("cloth: " + std::to_string(masses.size()) + " masses for " +
                           std::to_string(positions.rows()) + " vertices; expected one each");
  std::vector<std::string> faults;
  if (const int vertex = first_not_finite(positions); vertex >= 0)
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
  potential.add(std::move(term));
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
       {std::make_pair("position", &positions), std::make_pair("velocity", &velocities)})
    if (const int vertex = first_not_finite(*values); vertex >= 0)
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
  const int vertex = first_not_finite(positions);
  if (vertex < 0)
    return;
  std::ostringstream text;
  text << "step " << n_step + 1 << " of " << h << " s: vertex " << vertex << " is not finite";
  throw meshes::NotConverged(text.str(), {});
}

void Cloth::set_held(Vectors &positions) const
{
  for (const int vertex : held)
    positions.row(vertex) = target.row(vertex);
}

/// Whether a step may not raise the energy: no handle moves, and no term does work.
bool Cloth::is_closed() const
{
  for (const int vertex : held)
    if (target.row(vertex) != x.row(vertex))
      return false;
  return std::none_of(terms().begin(), terms().end(),
                      [](const auto &term) { return term->does_work() || !term->has_energy(); });
}

/// Where a linearly implicit step ends.
Vectors Cloth::linear_step(const double h, StepReport &report)
{
  Vectors next = x + potential.linear_step(x, v, target - x, h, report);
  set_held(next);
  check_finite(next, h);
  return next;
}

/// The minimum of Φ, or of a linearly implicit step that is guarded what ten iterations find of it.
Vectors Cloth::minimum(const Vectors &inertial, const double h, StepReport &report)
{
  Vectors next = x;
  set_held(next);
  // A free cloth begins where its momentum takes it: a line search that shortens the step would keep a
  // part of the momentum only.
  if (held.empty())
    next.rowwise() += h * momentum() / m.sum();
  const bool to_tolerance = options.integrator == Integrator::implicit;
  potential.minimize(inertial, h, to_tolerance ? options.max_newton_iterations : 10, to_tolerance,
                     next, report);
  check_finite(next, h);
  return next;
}

/// @param may_fail false: the last of many cuts; an energy that grows is then kept
void Cloth::try_step(const double h, const bool may_fail, StepReport &report)
{
  for (const auto &term : terms())
    term->begin_step({x, v, now, h});
  const Vectors inertial = x + h * v, old_x = x, old_v = v;
  const bool closed             = is_closed();
  const double energy           = closed ? kinetic_energy() + stored_energy() : 0.;
  const Eigen::RowVector3d spin = held.empty() ? angular_momentum() : Eigen::RowVector3d::Zero();
  const auto has_grown          = [](const double before, const double after, const double size)
  { return !(after <= before + energy_slack * (std::abs(before) + std::abs(size))); };
  const bool is_alone =
    held.empty() && std::all_of(terms().begin(), terms().end(),
                                [](const auto &term) { return term->is_internal(); });
  const Eigen::RowVector3d velocity =
    is_alone ? (momentum() / m.sum()).eval() : Eigen::RowVector3d::Zero();
  double spin_restored = 0.;
  const auto move_to   = [&](const Vectors &next)
  {
    x = next;
    v = (x - old_x) / h;
    if (is_alone)
    {
      // No force from outside: what momentum changed by is round-off of the solver.
      const Eigen::RowVector3d lost = velocity - momentum() / m.sum();
      v.rowwise() += lost;
      x.rowwise() += h * lost;
    }
    stored.reset();
    if (held.empty())
      spin_restored = restore_angular_momentum(spin, h);
  };
  bool is_good = false;
  if (options.integrator == Integrator::linearly_implicit)
  {
    const Vectors next = linear_step(h, report);
    if (closed)
    {
      // With the spin that is put right: a step that turns motion into stretch loses as much of it as it stores.
      move_to(next);
      is_good = !has_grown(energy, kinetic_energy() + stored_energy(), stored_energy());
    }
    else
    {
      Vectors start = x;
      set_held(start);
      const auto potential_at = [&](const Vectors &positions)
      { return potential.value(positions, inertial, 1. / (h * h)); };
      const double after = potential.has_energy() ? potential_at(next) : 0.;
      is_good            = !potential.has_energy() || !has_grown(potential_at(start), after, after);
      if (is_good)
        move_to(next);
    }
    if (!is_good)
    {
      ++report.guarded;
      x = old_x;
      v = old_v;
    }
  }
  if (!is_good)
    move_to(minimum(inertial, h, report));
  if (closed && is_alone)
  {
    // Where this shape with the momenta of the cloth has more energy than there was: a shape nearer to the one before, which
    // turns as a rigid body; at last that one as it lay, with which there is enough.
    const Vectors found = x, turned = moved_rigidly(m, old_x, old_v, h);
    for (const double part : {0.5, 0.25, 0.125, 0., -1.})
      if (has_grown(energy, least_energy(), stored_energy()))
        move_to(part >= 0. ? (turned + part * (found - turned)).eval()
                           : (old_x.rowwise() + h * velocity).eval());
  }
  report.spin_restored += spin_restored;
  if (closed)
    report.energy_removed += limit_energy(energy, may_fail);
}

/// What is stored in the shape, and the kinetic energy of a rigid body of this shape with the momenta of the cloth [J].
double Cloth::least_energy() const
{
  const Eigen::RowVector3d L = angular_momentum();
  return stored_energy() + 0.5 * momentum().squaredNorm() / m.sum() + 0.5 * spin_of(m, x, L).dot(L);
}

/// Takes from the motion what energy a step brought into a closed cloth: velocities are drawn towards
/// those of a rigid body with the same momenta, of a held cloth towards rest.
/// @return what was taken [J]
double Cloth::limit_energy(const double before, const bool may_fail)
{
  const double of_terms = stored_energy(), kinetic = kinetic_energy();
  if (kinetic + of_terms <= before + energy_slack * (std::abs(before) + std::abs(of_terms)))
    return 0.;
  Vectors rigid = Vectors::Zero(x.rows(), 3);
  if (held.empty())
  {
    rigid.rowwise() += momentum() / m.sum();
    add_spin(m, x, spin_of(m, x, angular_momentum()), rigid);
  }
  const double of_rigid = 0.5 * m.dot(rigid.rowwise().squaredNorm()), of_rest = kinetic - of_rigid;
  const double room = before - of_terms - of_rigid;
  // Of a free cloth the momenta come first: what a rigid body would have is left.
  if (room < 0. && may_fail && !held.empty())
    throw meshes::NotConverged("a step raised the energy", {before, kinetic + of_terms});
  const double factor = room > 0. && of_rest > 0. ? std::sqrt(std::min(1., room / of_rest)) : 0.;
  v                   = rigid + factor * (v - rigid);
  return kinetic - kinetic_energy();
}

/// So that L_{n+1} = L_n + h · torque of the external terms at x_{n+1}. They were evaluated with the velocities
/// before the spin was put right, of which damping by mass at the rate α takes its part: (1 + h α) I ω is what is missing.
/// @return the size of what was added [kg m^2/s]
double Cloth::restore_angular_momentum(const Eigen::RowVector3d &before, const double h)
{
  Eigen::RowVector3d torque = Eigen::RowVector3d::Zero();
  if (std::any_of(terms().begin(), terms().end(),
                  [](const auto &term) { return !term->is_internal(); }))
  {
    Vectors external                = Vectors::Zero(x.rows(), 3);
    const Eigen::RowVector3d centre = centre_of_mass(m, x);
    for (const auto &term : terms())
      if (!term->is_internal())
        term->add_gradient(x, external);
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      torque -= (x.row(i) - centre).cross(external.row(i));
  }
  double damping = 0.;
  for (const auto &term : terms())
    damping += term->mass_damping();
  const Eigen::RowVector3d missing =
    (before + h * torque - angular_momentum()) / (1. + h * damping);
  const Eigen::RowVector3d old = angular_momentum();
  add_spin(m, x, spin_of(m, x, missing), v);
  return (angular_momentum() - old).norm();
}

StepReport Cloth::step(const double h)
{
  if (!(h > 0.) || !std::isfinite(h))
    throw meshes::BadInput("time step: found " + std::to_string(h) +
                           " s; expected a positive number");
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
      try_step((until - done) * h, report.cuts < options.max_cuts, report);
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
        x      = old_x;
        v      = old_v;
        target = final_target;
        now    = begin;
        throw meshes::NotConverged(
          std::string(failure.what()) + " (step " + std::to_string(n_step + 1) + ", time " +
            std::to_string(begin) + " s, cut " + std::to_string(options.max_cuts) +
            " times); try a smaller time step, damping, or look for a coarse triangle that is crushed",
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
  return 0.5 * m.dot(v.rowwise().squaredNorm());
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
  return static_cast<std::size_t>(x.size()) * 4 * sizeof(double) + potential.bytes();
}
} // namespace homespun::shell
