// SPDX-License-Identifier: MIT
// The full-resolution cloth of a scene, in two codes behind one face: by finite elements (deal.II),
// and by the shell's own code with a stiffness per triangle, the naive simulation at its best.
#pragma once

#include "meshes/files/state_file.h"
#include "verification/drape/draped_cell.h"

#include <mpi.h>

#include <memory>
#include <string>

namespace homespun::verification
{
struct FineStep
{
  std::string why; ///< reason where it was not reached
  double seconds = 0.;
};

/// A full-resolution cloth. All ranks call all members.
class FineRun
{
public:
  virtual ~FineRun() = default;
  /// One step, or the equilibrium of a time.
  virtual FineStep advance(bool to_equilibrium, double step, double time) = 0;
  virtual void resume(const meshes::ClothState &state)                    = 0;
  virtual const meshes::SpacePoints &positions() const                    = 0;
  virtual meshes::SpacePoints velocities() const                          = 0;
  virtual double time() const                                             = 0;
  virtual double kinetic_energy() const                                   = 0;
  /// Of membrane and plate [J].
  virtual double elastic_energy() const = 0;
  /// dE/dx of all that acts on the vertices but inertia (n,3), on the first rank [N].
  virtual meshes::SpacePoints gradient() const = 0;
  virtual int n_vertices() const               = 0;
  virtual unsigned long n_dofs() const         = 0;
};

/// Degree of the elements, and how often the mesh is refined uniformly.
struct Discretization
{
  unsigned int order = 1, refine = 0;
};

/// By finite elements, on all ranks.
std::unique_ptr<FineRun> dealii_run(const DrapedCell &draped, Law law,
                                    Discretization discretization, MPI_Comm communicator);

/// By the shell's own code, the method's law with a stiffness per triangle; on the first rank,
/// one thread.
std::unique_ptr<FineRun> shell_run(const DrapedCell &draped, MPI_Comm communicator);
} // namespace homespun::verification
