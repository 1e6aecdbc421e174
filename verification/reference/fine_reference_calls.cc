// SPDX-License-Identifier: MIT
// FineReference, which hands on to its solver, and the words of its answers.
#include "verification/record/number_text.h"
#include "verification/reference/fine_reference_solver.h"

namespace homespun::verification
{
FineReference::FineReference(const meshes::Sheet &sheet,
                             std::vector<Eigen::Matrix3d> stiffness_of_phase,
                             const ReferenceOptions &options, const MPI_Comm communicator)
    : solver(std::make_unique<Solver>(sheet, std::move(stiffness_of_phase), options, communicator))
{
}

FineReference::~FineReference() = default;

void FineReference::start(const Load &load, const Law law, BodyForce body_force)
{
  solver->start(load, law, std::move(body_force));
}

ReferenceStep FineReference::advance(const double strain)
{
  return solver->advance(strain);
}

FieldDistance FineReference::distance_from(const KnownField &known) const
{
  return solver->distance_from(known);
}

ReferenceStep FineReference::tighten(const double tolerance)
{
  return solver->tighten(tolerance);
}

Stability FineReference::stability_of_last(const ReferenceStep &stopped)
{
  if (stopped.positions.rows() == 0)
    return Stability::unknown;
  ReferenceStep last = stopped;
  last.strain        = stopped.stopped_at;
  return solver->stabilize(last);
}

Stability FineReference::stabilize(ReferenceStep &step)
{
  return solver->stabilize(step);
}

ReferencePath FineReference::follow(const double goal, const double first_step)
{
  return solver->follow(goal, first_step);
}

unsigned long FineReference::n_dofs() const
{
  return solver->n_dofs();
}

std::string name_of(const Stability stability)
{
  switch (stability)
  {
  case Stability::every_triangle:
    return "every triangle";
  case Stability::stable:
    return "stable";
  case Stability::left:
    return "left";
  case Stability::unstable:
    return "unstable";
  case Stability::unknown:
    break;
  }
  return "unknown";
}

std::string note_of_round_off(const ReferenceStep &step)
{
  if (!step.is_at_round_off || !(step.relative_residual > 1e-6))
    return {};
  return "the reference is accepted at round-off: " + short_text(step.relative_residual) +
         " of its forces are left, those of the stiff phases; expected 1e-6 at most: a smaller "
         "contrast, or a larger strain";
}
} // namespace homespun::verification
