// SPDX-License-Identifier: MIT
// ClothReference, which hands on to its solver.
#include "verification/reference/cloth_reference_solver.h"

namespace homespun::verification
{
ClothReference::ClothReference(const meshes::TriangleMesh &rest,
                               std::vector<Eigen::Matrix3d> stiffness_of_phase,
                               std::vector<double> areal_density_of_phase,
                               const ClothReferenceOptions &options, const MPI_Comm communicator)
    : solver(std::make_unique<Solver>(rest, std::move(stiffness_of_phase),
                                      std::move(areal_density_of_phase), options, communicator))
{
}

ClothReference::~ClothReference() = default;

void ClothReference::start(const Placement &initial_position, const Held &held,
                           const ClothLoads &loads)
{
  solver->start(initial_position, held, loads);
}

void ClothReference::resume(const meshes::SpacePoints &positions,
                            const meshes::SpacePoints &velocities, const double time)
{
  solver->resume(positions, velocities, time);
}

ClothStep ClothReference::step(const double dt)
{
  return solver->step(dt);
}

ClothStep ClothReference::solve_equilibrium(const double time)
{
  return solver->solve_equilibrium(time);
}

const meshes::SpacePoints &ClothReference::positions() const
{
  return solver->positions();
}

meshes::SpacePoints ClothReference::velocities() const
{
  return solver->velocities();
}

double ClothReference::time() const
{
  return solver->time();
}

double ClothReference::stored_energy() const
{
  return solver->stored_energy();
}

double ClothReference::kinetic_energy() const
{
  return solver->kinetic_energy();
}

FieldDistance ClothReference::distance_from(const KnownField &known) const
{
  return solver->distance_from(known);
}

unsigned long ClothReference::n_dofs() const
{
  return solver->n_dofs();
}
} // namespace homespun::verification
