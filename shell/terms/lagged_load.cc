// SPDX-License-Identifier: MIT
#include "shell/terms/lagged_load.h"

#include "meshes/plain/errors.h"

#include <utility>

namespace homespun::shell
{
namespace
{
class LaggedLoad final : public Term
{
public:
  LaggedLoad(std::string name, std::function<Vectors(const Vectors &)> &&forces)
      : label(std::move(name))
      , forces_at(std::move(forces))
  {
  }

  std::string name() const override
  {
    return label;
  }
  void begin_step(const StepStart &start) override
  {
    forces = forces_at(start.positions);
  }
  double energy(const Vectors &positions) const override
  {
    return forces.size() == 0 ? 0. : -forces.cwiseProduct(positions).sum();
  }
  double stored_energy(const Vectors &) const override
  {
    return 0.;
  }
  void add_gradient(const Vectors &, Vectors &gradient) const override
  {
    if (forces.size() != 0)
      gradient -= forces;
  }
  void add_derivatives(const Vectors &positions, Hessian, Vectors &gradient,
                       BlockMatrix &) const override
  {
    add_gradient(positions, gradient);
  }
  bool has_discrete_gradient() const override
  {
    return true;
  }
  void add_discrete_gradient(const Vectors &, const Vectors &x, Vectors &gradient,
                             VertexMatrix &) const override
  {
    add_gradient(x, gradient);
  }
  bool does_work() const override
  {
    return true;
  }
  bool is_internal() const override
  {
    return false;
  }
  std::size_t bytes() const override
  {
    return static_cast<std::size_t>(forces.size()) * sizeof(double);
  }

private:
  const std::string label;
  const std::function<Vectors(const Vectors &)> forces_at;
  Vectors forces; ///< empty before the first step [N]
};
} // namespace

std::unique_ptr<Term> lagged_load_term(std::string name,
                                       std::function<Vectors(const Vectors &positions)> forces)
{
  if (!forces)
    throw meshes::BadInput("load `" + name + "`: no function of the positions is given");
  return std::make_unique<LaggedLoad>(std::move(name), std::move(forces));
}
} // namespace homespun::shell
