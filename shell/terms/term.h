// SPDX-License-Identifier: MIT
// What a moving cloth is made of. Each physical effect is a term that a scene adds or leaves out: a
// function of the positions with a gradient and a Hessian. The cloth (cloth.h) sums the terms that
// are there; of one that is not, nothing is called, allocated or coupled.
//
// A time step minimises  Σ m/(2 h²) |x − x_n − h v_n|² + Σ_terms E(x)  (implicit Euler), takes one
// Newton step of it (linearly implicit Euler), or asks for discrete gradients (conserving_step.h).
// What a term freezes over the step (the direction of friction, the wind's relative speed) it
// freezes in begin_step(), so that E is a function of x alone.
#pragma once

#include "shell/algebra/block_matrix.h"
#include "shell/membrane/corotational_energy.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace homespun::shell
{
class VertexMatrix;

/// State at the beginning of a step, and how long it is.
struct StepStart
{
  const Vectors &positions;  ///< x_n (n,3) [m]
  const Vectors &velocities; ///< v_n (n,3) [m/s]
  double time = 0.;          ///< at the beginning of the step [s]
  double step = 0.;          ///< h [s]; infinity for an equilibrium
};

class Term
{
public:
  virtual ~Term() = default;

  /// As a scene file and a report call it.
  virtual std::string name() const = 0;

  /// Called once before couple(): the term may take nodes that are no vertices, three unknowns
  /// each, without mass, from a number on. They are in the matrix alone: E and its gradient are
  /// those of the minimum over them, so that their right sides are zero; the Hessian of E is what
  /// is left where they are eliminated. @return how many it takes. Default: none.
  virtual int take_nodes(int /*first*/)
  {
    return 0;
  }

  /// Appends the pairs of different vertices that the Hessian couples, in any order, repeated or
  /// not. Default: none, the Hessian is block diagonal.
  virtual void couple(std::vector<std::array<int, 2>> & /*pairs*/) const
  {
  }

  /// Called once when the matrix is laid out, so that places of blocks are looked up only once.
  virtual void attach(const BlockMatrix & /*matrix*/)
  {
  }

  /// Called before each step.
  virtual void begin_step(const StepStart & /*start*/)
  {
  }

  /// E(x) [J], up to a constant that does not change within a step.
  virtual double energy(const Vectors &positions) const = 0;

  /// What rounding does to energy() where it is a sum of what cancels [J]. Default: nothing beyond
  /// a few roundings of E itself.
  virtual double round_off(const Vectors & /*positions*/) const
  {
    return 0.;
  }

  /// Adds dE/dx [N]; the forces are its negative.
  virtual void add_gradient(const Vectors &positions, Vectors &gradient) const = 0;

  /// Adds dE/dx and d²E/dx² in one pass. A projected Hessian is positive semi-definite.
  virtual void add_derivatives(const Vectors &positions, Hessian kind, Vectors &gradient,
                               BlockMatrix &matrix) const = 0;

  /// Which element makes E(x) infinite, and by what; empty where E is finite. Default: it always
  /// is.
  virtual std::string why_infinite(const Vectors & /*positions*/) const
  {
    return {};
  }

  /// The part of E that the cloth or a field (gravity) stores and gives back [J]: what an energy
  /// balance counts. Zero of a dissipation and of a load that does work. Default: E itself.
  virtual double stored_energy(const Vectors &positions) const
  {
    return energy(positions);
  }

  /// Whether the gradient is one: false of forces that have no energy, for which energy() is zero
  /// and nothing can be minimised.
  virtual bool has_energy() const
  {
    return true;
  }

  /// Whether the term may bring energy into the cloth beyond what stored_energy() gives back: wind,
  /// a moving obstacle. Where none does and no handle moves, a step may not raise the energy.
  virtual bool does_work() const
  {
    return false;
  }

  /// Whether the forces act between the vertices of the cloth alone, without sum and torque.
  virtual bool is_internal() const
  {
    return true;
  }

  /// Whether a step that conserves can take the term: whether add_discrete_gradient() is there.
  virtual bool has_discrete_gradient() const
  {
    return false;
  }

  /// Adds a discrete gradient g of the step from x_n to x, and its derivative by x. The work g·(x −
  /// x_n) is the change of the stored energy, of a dissipation it is not negative. Of an internal
  /// term g sums to zero and has no torque about the mean positions (x_n + x)/2.
  /// @param old x_n (n,3) [m]
  virtual void add_discrete_gradient(const Vectors & /*old*/, const Vectors & /*positions*/,
                                     Vectors & /*gradient*/, VertexMatrix & /*jacobian*/) const
  {
  }

  /// Bytes that the term keeps, for the table of what leaving it out saves.
  virtual std::size_t bytes() const = 0;
};
} // namespace homespun::shell
