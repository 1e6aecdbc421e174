// SPDX-License-Identifier: MIT
#include "verification/drape/fine_run.h"

#include "meshes/plain/errors.h"
#include "shell/terms/membrane_term.h"
#include "verification/record/on_root.h"
#include "verification/reference/cloth_reference.h"
#include "verification/reference/space_gradient.h"

#include <chrono>

namespace homespun::verification
{
namespace
{
class DealiiRun : public FineRun
{
public:
  DealiiRun(const DrapedCell &draped, const Law law, const Discretization discretization,
            const MPI_Comm communicator)
      : motion(draped.fine_motion())
      , reference(draped.fine.rest, draped.phases.stiffness, draped.phases.areal_density,
                  options_of(law, discretization), communicator)
      , n(draped.fine.n_vertices())
      , law(law)
      , rest(draped.fine.rest)
      , stiffness(draped.phases.stiffness)
      , masses(shell::lumped_masses(draped.fine, draped.phases.areal_density))
  {
    if (draped.scene.has("gravity"))
      loads.gravity = draped.scene.gravity;
    if (draped.scene.has("damping"))
      loads.mass_damping = draped.scene.damping_rate;
    reference.start(
      draped.placement->start,
      [this](const Eigen::RowVector2d &point, const double time) { return motion.at(point, time); },
      loads);
  }
  FineStep advance(const bool to_equilibrium, const double step, const double time) override
  {
    const ClothStep report =
      to_equilibrium ? reference.solve_equilibrium(time) : reference.step(step);
    return {report.reached ? "" : report.why.empty() ? "not reached" : report.why, report.seconds};
  }
  void resume(const meshes::ClothState &state) override
  {
    reference.resume(state.positions, state.velocities, state.time);
  }
  const meshes::SpacePoints &positions() const override
  {
    return reference.positions();
  }
  meshes::SpacePoints velocities() const override
  {
    return reference.velocities();
  }
  double time() const override
  {
    return reference.time();
  }
  double kinetic_energy() const override
  {
    return reference.kinetic_energy();
  }
  double elastic_energy() const override
  {
    return reference.stored_energy();
  }
  meshes::SpacePoints gradient() const override
  {
    return space_gradient(rest, stiffness, law, positions()) +
           masses.asDiagonal() * ((loads.mass_damping * velocities()).rowwise() - loads.gravity);
  }
  int n_vertices() const override
  {
    return n;
  }
  unsigned long n_dofs() const override
  {
    return reference.n_dofs();
  }

private:
  static ClothReferenceOptions options_of(const Law law, const Discretization discretization)
  {
    ClothReferenceOptions options;
    options.law    = law;
    options.order  = discretization.order;
    options.refine = discretization.refine;
    // Lumped P2 shows second order only.
    options.consistent_mass = discretization.order == 2;
    return options;
  }
  const HeldMotion motion;
  ClothReference reference;
  const int n;
  const Law law;
  ClothLoads loads;
  const meshes::TriangleMesh &rest;
  const std::vector<Eigen::Matrix3d> &stiffness;
  const Eigen::VectorXd masses; ///< of P1 on the mesh as given [kg]
};

class ShellRun : public FineRun
{
public:
  ShellRun(const DrapedCell &draped, const MPI_Comm communicator)
      : communicator(communicator)
      , n(draped.fine.n_vertices())
      , here(draped.fine.positions)
  {
    on_root(communicator,
            [&]()
            {
              run = std::make_unique<SceneCloth>(draped.scene, draped.fine, draped.phases,
                                                 draped.fine_motion());
            });
  }
  FineStep advance(const bool to_equilibrium, const double step, const double time) override
  {
    FineStep result;
    int failed = 0;
    if (run)
    {
      const auto begin = std::chrono::steady_clock::now();
      try
      {
        if (to_equilibrium)
          run->solve_equilibrium(time);
        else
          run->step(step);
        here = run->cloth().positions();
      }
      catch (const meshes::NotConverged &failure)
      {
        result.why = failure.what();
        failed     = 1;
      }
      result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    MPI_Bcast(&failed, 1, MPI_INT, 0, communicator);
    MPI_Bcast(&result.seconds, 1, MPI_DOUBLE, 0, communicator);
    if (failed && result.why.empty())
      result.why = "the first rank failed";
    return result;
  }
  void resume(const meshes::ClothState &state) override
  {
    if (run)
      run->cloth().set_state(state.positions, state.velocities, state.time);
    here = state.positions;
  }
  const meshes::SpacePoints &positions() const override
  {
    return here;
  }
  meshes::SpacePoints velocities() const override
  {
    return run ? run->cloth().velocities() : meshes::SpacePoints::Zero(n, 3).eval();
  }
  double time() const override
  {
    return run ? run->cloth().time() : 0.;
  }
  double kinetic_energy() const override
  {
    return run ? run->cloth().kinetic_energy() : 0.;
  }
  double elastic_energy() const override
  {
    return run ? run->elastic_energy() : 0.;
  }
  meshes::SpacePoints gradient() const override
  {
    return run ? run->cloth().gradient() : meshes::SpacePoints::Zero(n, 3).eval();
  }
  int n_vertices() const override
  {
    return n;
  }
  unsigned long n_dofs() const override
  {
    return 3ul * static_cast<unsigned long>(n);
  }

private:
  const MPI_Comm communicator;
  const int n;
  meshes::SpacePoints here;
  std::unique_ptr<SceneCloth> run;
};
} // namespace

std::unique_ptr<FineRun> dealii_run(const DrapedCell &draped, const Law law,
                                    const Discretization discretization,
                                    const MPI_Comm communicator)
{
  return std::make_unique<DealiiRun>(draped, law, discretization, communicator);
}

std::unique_ptr<FineRun> shell_run(const DrapedCell &draped, const MPI_Comm communicator)
{
  return std::make_unique<ShellRun>(draped, communicator);
}
} // namespace homespun::verification
