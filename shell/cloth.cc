// SPDX-License-Identifier: MIT
#include "shell/cloth.h"

#include "meshes/errors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace homespun::shell
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

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
} // namespace

Cloth::Cloth(const Vectors &positions, const Eigen::VectorXd &masses,
             const std::vector<int> &held_vertices, const ClothOptions &options)
    : x(positions)
    , v(Vectors::Zero(positions.rows(), 3))
    , target(positions)
    , m(masses)
    , is_held(static_cast<std::size_t>(positions.rows()), false)
    , options(options)
{
  std::vector<std::string> faults;
  if (masses.size() != positions.rows())
    throw meshes::BadInput("cloth: " + std::to_string(masses.size()) + " masses for " +
                           std::to_string(positions.rows()) + " vertices; expected one each");
  if (const int vertex = first_not_finite(positions); vertex >= 0)
    faults.push_back("vertex " + std::to_string(vertex) + ": its position is not finite");
  for (Eigen::Index i = 0; i < masses.size() && faults.size() < 4; ++i)
    if (!(masses(i) > 0.) || !std::isfinite(masses(i)))
      faults.push_back("vertex " + std::to_string(i) + ": has a mass of " +
                       std::to_string(masses(i)) + " kg; expected a positive one");
  for (const int vertex : held_vertices)
    if (vertex < 0 || vertex >= static_cast<int>(positions.rows()))
      faults.push_back("held vertex " + std::to_string(vertex) +
                       ": does not exist; expected 0 ... " + std::to_string(positions.rows() - 1));
    else
      is_held[static_cast<std::size_t>(vertex)] = true;
  for (int vertex = 0; vertex < static_cast<int>(positions.rows()); ++vertex)
    if (is_held[static_cast<std::size_t>(vertex)])
      held.push_back(vertex);
  if (!faults.empty())
    throw meshes::BadInput(faults);
}

void Cloth::add(std::unique_ptr<Term> term)
{
  all_terms.push_back(std::move(term));
  matrix.reset();
  stored.reset();
}

void Cloth::prescribe(const int vertex, const Eigen::RowVector3d &position)
{
  if (vertex < 0 || vertex >= static_cast<int>(x.rows()) ||
      !is_held[static_cast<std::size_t>(vertex)] || !position.allFinite())
    throw meshes::BadInput("vertex " + std::to_string(vertex) +
                           ": only a held vertex can be moved, and to a finite position");
  target.row(vertex) = position;
}

void Cloth::set_state(const Vectors &positions, const Vectors &velocities, const double time)
{
  if (positions.rows() != x.rows() || velocities.rows() != x.rows() || !positions.allFinite() ||
      !velocities.allFinite() || !std::isfinite(time))
    throw meshes::BadInput("cloth: a state of " + std::to_string(positions.rows()) +
                           " vertices, or one that is not finite; expected " +
                           std::to_string(x.rows()) + " finite positions and velocities");
  x      = positions;
  v      = velocities;
  now    = time;
  target = x;
  stored.reset();
}

/// The matrix, its solver, and the terms' places in it.
void Cloth::lay_out()
{
  std::vector<std::array<int, 2>> pairs;
  for (const auto &term : all_terms)
    term->couple(pairs);
  matrix = std::make_unique<BlockMatrix>(pairs, is_held);
  for (const auto &term : all_terms)
    term->attach(*matrix);
  diagonal.clear();
  for (int i = 0; i < static_cast<int>(x.rows()); ++i)
    diagonal.push_back(matrix->place(i, i));
  cholesky.reset();
  preconditioner.reset();
  if (options.solver == LinearSolver::direct ||
      (options.solver == LinearSolver::automatic && matrix->n_free() <= options.direct_limit))
    cholesky = std::make_unique<BlockCholesky>(*matrix);
  else
    preconditioner = std::make_unique<IncompleteCholesky>(*matrix);
}

bool Cloth::is_direct() const
{
  return cholesky != nullptr;
}

double Cloth::incremental_potential(const Vectors &positions, const Vectors &inertial,
                                    const double h) const
{
  double sum = 0.;
  if (std::isfinite(h))
    sum = 0.5 / (h * h) * m.dot((positions - inertial).rowwise().squaredNorm());
  for (const auto &term : all_terms)
    sum += term->energy(positions);
  return sum;
}

/// Solves with the matrix as it is. @return false where it is not positive definite
bool Cloth::solve_linear(const Vectors &right_side, Vectors &result, StepReport &report)
{
  ++report.newton_iterations;
  if (cholesky)
  {
    if (!cholesky->factorize(*matrix))
      return false;
    cholesky->solve(right_side, result);
    return true;
  }
  preconditioner->factorize(*matrix);
  report.linear_iterations +=
    conjugate_gradients(*matrix, *preconditioner, right_side, options.linear_tolerance,
                        options.max_linear_iterations, result)
      .iterations;
  return true;
}

/// Assembles gradient and Hessian of Φ at the given positions.
Cloth::Residual Cloth::assemble(const Vectors &positions, const Vectors &inertial,
                                const double inverse_square, const Hessian kind)
{
  matrix->clear();
  work_gradient.setZero(x.rows(), 3);
  Residual residual;
  Vectors own(x.rows(), 3);
  const auto collect = [&]()
  {
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      if (!is_held[static_cast<std::size_t>(i)])
        residual.size += own.row(i).squaredNorm();
    work_gradient += own;
  };
  for (const auto &term : all_terms)
  {
    own.setZero();
    term->add_derivatives(positions, kind, own, *matrix);
    collect();
  }
  if (inverse_square > 0.)
  {
    own = inverse_square * m.asDiagonal() * (positions - inertial);
    collect();
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      matrix->add_multiple(diagonal[static_cast<std::size_t>(i)], inverse_square * m(i));
  }
  // Forces change by this when every position moves by one rounding.
  const double rounding = std::numeric_limits<double>::epsilon() * positions.cwiseAbs().maxCoeff();
  double floor          = 0.;
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    if (is_held[static_cast<std::size_t>(i)])
      work_gradient.row(i).setZero();
    else
      floor += std::pow(rounding * matrix->diagonal(static_cast<int>(i)).trace(), 2);
  residual.size      = std::sqrt(residual.size);
  residual.round_off = 4. * std::sqrt(floor);
  residual.norm      = work_gradient.norm();
  return residual;
}

/// Newton's method with line search on Φ from the given positions, whose held rows are prescribed.
/// @param must_converge false: to stop after the last iteration is no failure
void Cloth::newton(const Vectors &inertial, const double h, Vectors &positions,
                   const int max_iterations, const bool must_converge, StepReport &report)
{
  const double inverse = 1. / (h * h);
  double potential     = incremental_potential(positions, inertial, h);
  std::vector<double> history;
  for (int iteration = 0;; ++iteration)
  {
    // Conjugate gradients would not notice an indefinite matrix in time, hence no exact Hessian for them.
    const bool try_exact = cholesky != nullptr;
    Residual residual =
      assemble(positions, inertial, inverse, try_exact ? Hessian::exact : Hessian::projected);
    history.push_back(residual.norm);
    if (!std::isfinite(residual.norm))
      throw meshes::NotConverged("a force is not finite", history);
    if (residual.norm <= options.newton_tolerance * residual.size + residual.round_off)
      return;
    if (iteration >= max_iterations)
    {
      if (must_converge)
        throw meshes::NotConverged("Newton's method of the step", history);
      return;
    }
    Vectors forces = -work_gradient;
    work_step.setZero(x.rows(), 3);
    bool solved = solve_linear(forces, work_step, report);
    if (!solved && try_exact)
    {
      assemble(positions, inertial, inverse, Hessian::projected);
      solved = solve_linear(forces, work_step, report);
    }
    if (!solved)
      throw meshes::NotConverged("the step's matrix is not positive definite", history);
    const double slope = -forces.cwiseProduct(work_step).sum();
    double length      = 1.;
    Vectors trial;
    while (true)
    {
      trial             = positions + length * work_step;
      const double next = incremental_potential(trial, inertial, h);
      if (!has_energy() || next <= potential + 1e-4 * length * slope + 1e-13 * std::abs(potential))
      {
        potential = next;
        break;
      }
      length *= 0.5;
      if (length < 1e-6)
      {
        if (must_converge)
          throw meshes::NotConverged("the line search of the step found no lower potential",
                                     history);
        return;
      }
    }
    positions = trial;
  }
}

bool Cloth::has_energy() const
{
  return std::all_of(all_terms.begin(), all_terms.end(),
                     [](const auto &term) { return term->has_energy(); });
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
  return std::none_of(all_terms.begin(), all_terms.end(),
                      [](const auto &term) { return term->does_work() || !term->has_energy(); });
}

/// @param may_fail false: the last of many cuts; an energy that grows is then kept
void Cloth::try_step(const double h, const bool may_fail, StepReport &report)
{
  for (const auto &term : all_terms)
    term->begin_step({x, v, now, h});
  const Vectors inertial = x + h * v;
  const bool closed      = is_closed();
  const double energy    = closed ? kinetic_energy() + stored_energy() : 0.;
  Vectors next;
  bool is_good = false;
  if (options.integrator == Integrator::linearly_implicit)
  {
    next    = linear_step(inertial, h, report);
    is_good = !has_energy();
    if (closed)
    {
      stored             = sum_of_stored_energies(next);
      const double after = 0.5 / (h * h) * m.dot((next - x).rowwise().squaredNorm()) + *stored;
      is_good            = after <= energy + energy_slack * (std::abs(energy) + std::abs(*stored));
    }
    else if (!is_good)
    {
      Vectors start = x;
      set_held(start);
      const double before = incremental_potential(start, inertial, h),
                   after  = incremental_potential(next, inertial, h);
      is_good             = after <= before + energy_slack * (std::abs(before) + std::abs(after));
    }
    if (!is_good)
      ++report.guarded;
  }
  if (!is_good)
  {
    stored.reset();
    next = x;
    set_held(next);
    // A free cloth begins where its momentum takes it: a line search that shortens the step would keep
    // a part of the momentum only.
    if (held.empty())
      next.rowwise() += h * momentum() / m.sum();
    const bool to_tolerance = options.integrator == Integrator::implicit;
    newton(inertial, h, next, to_tolerance ? options.max_newton_iterations : 10, to_tolerance,
           report);
  }
  check_finite(next, h);
  const Eigen::RowVector3d before = held.empty() ? angular_momentum() : Eigen::RowVector3d::Zero();
  v                               = (next - x) / h;
  x                               = next;
  if (!closed)
    stored.reset();
  if (held.empty())
    restore_angular_momentum(before, h);
  if (closed)
    limit_energy(energy, may_fail);
}

/// One Newton step of Φ from x_n with the projected Hessian: where linearly implicit Euler ends.
Vectors Cloth::linear_step(const Vectors &inertial, const double h, StepReport &report)
{
  const double inverse = 1. / (h * h);
  matrix->clear();
  work_gradient.setZero(x.rows(), 3);
  for (const auto &term : all_terms)
    term->add_derivatives(x, Hessian::projected, work_gradient, *matrix);
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    matrix->add_multiple(diagonal[i], inverse * m(static_cast<Eigen::Index>(i)));
  work_gradient = (m / h).asDiagonal() * v - work_gradient;
  if (!held.empty())
    matrix->subtract_held(target - x, work_gradient);
  work_step = inertial - x;
  for (const int vertex : held)
    work_step.row(vertex).setZero();
  if (!solve_linear(work_gradient, work_step, report))
    throw meshes::NotConverged("the step's matrix is not positive definite", {});
  Vectors next = x + work_step;
  set_held(next);
  check_finite(next, h);
  return next;
}

/// Takes from the motion what energy a step brought into a closed cloth: velocities are drawn towards
/// those of a rigid body with the same momenta, of a held cloth towards rest.
void Cloth::limit_energy(const double before, const bool may_fail)
{
  const double potential = stored_energy(), kinetic = kinetic_energy();
  if (kinetic + potential <= before + energy_slack * (std::abs(before) + std::abs(potential)))
    return;
  Vectors rigid = Vectors::Zero(x.rows(), 3);
  if (held.empty())
  {
    const Eigen::RowVector3d centre = m.transpose() * x / m.sum(),
                             spin   = spin_of(angular_momentum());
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      rigid.row(i) = momentum() / m.sum() + spin.cross(x.row(i) - centre);
  }
  const double of_rigid = 0.5 * m.dot(rigid.rowwise().squaredNorm()), of_rest = kinetic - of_rigid;
  const double room = before - potential - of_rigid;
  // Of a free cloth the momenta come first: what a rigid body would have is left.
  if (room < 0. && may_fail && !held.empty())
    throw meshes::NotConverged("a step raised the energy", {before, kinetic + potential});
  const double factor = room > 0. && of_rest > 0. ? std::sqrt(std::min(1., room / of_rest)) : 0.;
  v                   = rigid + factor * (v - rigid);
}

/// Angular velocity of a rigid body in the place of the cloth, about its centre of mass. A cloth collapsed
/// to a line cannot turn about it.
Eigen::RowVector3d Cloth::spin_of(const Eigen::RowVector3d &angular) const
{
  const Eigen::RowVector3d centre = m.transpose() * x / m.sum();
  Eigen::Matrix3d inertia         = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < x.rows(); ++i)
  {
    const Eigen::RowVector3d arm = x.row(i) - centre;
    inertia += m(i) * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm.transpose() * arm);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(inertia);
  Eigen::Vector3d spin = eigen.eigenvectors().transpose() * angular.transpose();
  for (int k = 0; k < 3; ++k)
    spin(k) = eigen.eigenvalues()(k) > 1e-12 * eigen.eigenvalues()(2)
                ? spin(k) / eigen.eigenvalues()(k)
                : 0.;
  return (eigen.eigenvectors() * spin).transpose();
}

void Cloth::restore_angular_momentum(const Eigen::RowVector3d &before, const double h)
{
  const Eigen::RowVector3d centre = m.transpose() * x / m.sum();
  Eigen::RowVector3d torque       = Eigen::RowVector3d::Zero();
  bool any_external               = false;
  work_gradient.setZero(x.rows(), 3);
  for (const auto &term : all_terms)
    if (!term->is_internal())
    {
      term->add_gradient(x, work_gradient);
      any_external = true;
    }
  for (Eigen::Index i = 0; any_external && i < x.rows(); ++i)
    torque -= (x.row(i) - centre).cross(work_gradient.row(i));
  const Eigen::RowVector3d spin = spin_of(before + h * torque - angular_momentum());
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    v.row(i) += spin.cross(x.row(i) - centre);
}

StepReport Cloth::step(const double h)
{
  if (!(h > 0.) || !std::isfinite(h))
    throw meshes::BadInput("time step: found " + std::to_string(h) +
                           " s; expected a positive number");
  if (!matrix)
    lay_out();
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

ClothEquilibrium Cloth::solve_equilibrium(const double relative_tolerance, const int max_iterations)
{
  if (!matrix)
    lay_out();
  ClothEquilibrium result;
  for (const auto &term : all_terms)
    term->begin_step({x, v, now, infinity});
  set_held(x);
  v.setZero();
  stored.reset();

  StepReport report;
  // A step in which a typical edge's stiffness and the inertia weigh the same.
  double stiffest = 0., lightest = infinity;
  Residual residual = assemble(x, x, 0., Hessian::projected);
  for (int i = 0; i < static_cast<int>(x.rows()); ++i)
    if (matrix->is_free(i))
    {
      stiffest = std::max(stiffest, matrix->diagonal(i).trace());
      lightest = std::min(lightest, m(i));
    }
  double shift            = stiffest > 0. ? stiffest / lightest : 1.; // 1/h² [1/s²]
  const double first      = shift;
  double potential        = incremental_potential(x, x, infinity);
  result.residual_history = {residual.norm};
  while (!(residual.norm <= relative_tolerance * residual.size + residual.round_off))
  {
    if (result.iterations >= max_iterations || !std::isfinite(residual.norm))
      throw meshes::NotConverged(
        "equilibrium of the cloth; hold more vertices, or start nearer to it",
        result.residual_history);
    // With little shift left the exact Hessian ends quadratically.
    bool solved    = false;
    Vectors forces = -work_gradient;
    if (cholesky && shift < 1e-6 * first)
    {
      assemble(x, x, 0., Hessian::exact);
      solved = solve_linear(forces, work_step, report);
    }
    if (!solved)
    {
      assemble(x, x, shift, Hessian::projected);
      work_step.setZero(x.rows(), 3);
      solved = solve_linear(forces, work_step, report);
    }
    ++result.iterations;
    const double slope = -forces.cwiseProduct(work_step).sum();
    Vectors trial      = x + work_step;
    double next        = solved ? incremental_potential(trial, x, infinity) : infinity;
    double length      = 1.;
    while (solved && slope < 0. && length > 1e-3 &&
           !(next <= potential + 1e-4 * length * slope + 1e-13 * std::abs(potential)))
    {
      length *= 0.5;
      trial = x + length * work_step;
      next  = incremental_potential(trial, x, infinity);
    }
    if (!solved || !(next <= potential + 1e-13 * std::abs(potential)))
    {
      shift *= 10.;
      residual = assemble(x, x, 0., Hessian::projected);
      continue;
    }
    x         = trial;
    potential = next;
    shift *= length == 1. ? 0.2 : 2.;
    residual = assemble(x, x, 0., Hessian::projected);
    result.residual_history.push_back(residual.norm);
  }
  result.residual = residual.norm;
  return result;
}

double Cloth::kinetic_energy() const
{
  return 0.5 * m.dot(v.rowwise().squaredNorm());
}

double Cloth::sum_of_stored_energies(const Vectors &positions) const
{
  double sum = 0.;
  for (const auto &term : all_terms)
    sum += term->stored_energy(positions);
  return sum;
}

double Cloth::stored_energy() const
{
  if (!stored)
    stored = sum_of_stored_energies(x);
  return *stored;
}

Eigen::RowVector3d Cloth::momentum() const
{
  return m.transpose() * v;
}

Eigen::RowVector3d Cloth::angular_momentum() const
{
  const Eigen::RowVector3d centre = m.transpose() * x / m.sum();
  Eigen::RowVector3d sum          = Eigen::RowVector3d::Zero();
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    sum += m(i) * (x.row(i) - centre).cross(v.row(i));
  return sum;
}

Vectors Cloth::gradient() const
{
  Vectors sum = Vectors::Zero(x.rows(), 3);
  for (const auto &term : all_terms)
    term->add_gradient(x, sum);
  return sum;
}

std::size_t Cloth::bytes() const
{
  std::size_t sum = static_cast<std::size_t>(x.size()) * 5 * sizeof(double);
  for (const auto &term : all_terms)
    sum += term->bytes();
  if (matrix)
    sum += matrix->bytes() + diagonal.size() * sizeof(BlockMatrix::Place);
  if (cholesky)
    sum += cholesky->bytes();
  if (preconditioner)
    sum += preconditioner->bytes();
  return sum;
}
} // namespace homespun::shell
