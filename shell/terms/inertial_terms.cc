// SPDX-License-Identifier: MIT
#include "shell/terms/inertial_terms.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/vertex_matrix.h"

#include <cmath>

namespace homespun::shell
{
namespace
{
class GravityTerm : public Term
{
public:
  GravityTerm(const Eigen::VectorXd &masses, const Eigen::RowVector3d &acceleration)
      : weights(masses * acceleration)
  {
  }
  std::string name() const override
  {
    return "gravity";
  }
  double energy(const Vectors &positions) const override
  {
    return -weights.cwiseProduct(positions).sum();
  }
  void add_gradient(const Vectors &, Vectors &gradient) const override
  {
    gradient -= weights;
  }
  void add_derivatives(const Vectors &, Hessian, Vectors &gradient, BlockMatrix &) const override
  {
    gradient -= weights;
  }
  bool is_internal() const override
  {
    return false;
  }
  bool has_discrete_gradient() const override
  {
    return true;
  }
  void add_discrete_gradient(const Vectors &, const Vectors &, Vectors &gradient,
                             VertexMatrix &) const override
  {
    gradient -= weights;
  }
  std::size_t bytes() const override
  {
    return static_cast<std::size_t>(weights.size()) * sizeof(double);
  }

private:
  const Vectors weights; ///< m g [N]
};

class MassDampingTerm : public Term
{
public:
  MassDampingTerm(const Eigen::VectorXd &masses, const double rate)
      : masses(masses)
      , rate(rate)
  {
  }
  std::string name() const override
  {
    return "damping";
  }
  void attach(const BlockMatrix &matrix) override
  {
    places.clear();
    for (int v = 0; v < static_cast<int>(masses.size()); ++v)
      places.push_back(matrix.slot(v, v));
  }
  void begin_step(const StepStart &start) override
  {
    old    = start.positions;
    factor = rate / start.step;
  }
  // Before the first step nothing moves, and nothing is damped.
  double energy(const Vectors &positions) const override
  {
    if (old.size() == 0)
      return 0.;
    return 0.5 * factor * masses.dot((positions - old).rowwise().squaredNorm());
  }
  double stored_energy(const Vectors &) const override
  {
    return 0.;
  }
  void add_gradient(const Vectors &positions, Vectors &gradient) const override
  {
    if (old.size() == 0)
      return;
    gradient += factor * masses.asDiagonal() * (positions - old);
  }
  void add_derivatives(const Vectors &positions, Hessian, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    add_gradient(positions, gradient);
    for (std::size_t v = 0; v < places.size(); ++v)
      matrix.add_multiple(places[v], factor * masses(static_cast<Eigen::Index>(v)));
  }
  bool is_internal() const override
  {
    return false;
  }
  bool has_discrete_gradient() const override
  {
    return true;
  }
  // α m times the mean velocity.
  void add_discrete_gradient(const Vectors &, const Vectors &positions, Vectors &gradient,
                             VertexMatrix &jacobian) const override
  {
    add_gradient(positions, gradient);
    for (int v = 0; v < static_cast<int>(masses.size()); ++v)
      jacobian.add(v, v, factor * masses(v) * Eigen::Matrix3d::Identity());
  }
  std::size_t bytes() const override
  {
    return static_cast<std::size_t>(masses.size()) *
           (sizeof(double) + 3 * sizeof(double) + sizeof(BlockMatrix::Slot));
  }

private:
  const Eigen::VectorXd masses;
  const double rate;
  double factor = 0.; ///< α/h [1/s^2]
  Vectors old;        ///< x_n
  std::vector<BlockMatrix::Slot> places;
};
} // namespace

std::unique_ptr<Term> gravity_term(const Eigen::VectorXd &masses,
                                   const Eigen::RowVector3d &acceleration)
{
  if (!acceleration.allFinite())
    throw meshes::BadInput(
      "gravity: the acceleration is not finite; expected three numbers in m/s^2");
  return std::make_unique<GravityTerm>(masses, acceleration);
}

std::unique_ptr<Term> mass_damping_term(const Eigen::VectorXd &masses, const double rate)
{
  if (!(rate >= 0.) || !std::isfinite(rate))
    throw meshes::BadInput("damping: found a rate of " + std::to_string(rate) +
                           " 1/s; expected zero or a positive number");
  return std::make_unique<MassDampingTerm>(masses, rate);
}
} // namespace homespun::shell
