// SPDX-License-Identifier: MIT
#include "verification/cell/assessed_cell.h"

#include "homogenization/cell/chi_strains.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/cell/discretization_distance.h"
#include "verification/cell/energy_order.h"
#include "verification/record/claim.h"

#include <Eigen/LU>

#include <array>
#include <limits>

namespace homespun::verification
{
using homogenization::Homogenization;
using homogenization::UnitCell;

namespace
{
/// What a bound on an energy of C^H may miss by, relative: round-off at this size and contrast, the
/// sums over all triangles, and lattice images that lie apart; and that C^H and its bound are
/// stored: nine entries of each in parts of the largest, 1.5 epsilon in their norm, which the
/// softest direction feels by the anisotropy.
double limit_of_bounds(const UnitCell &cell, const Homogenization &result)
{
  const auto n_triangles   = static_cast<double>(result.n_dofs); // with P1; fewer with P2
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  return algebraic_limit(cell, std::sqrt(0.5 * n_triangles)) +
         3. * epsilon * contrast_of({result.stiffness}) + n_triangles * epsilon +
         4. * result.audit.largest_gap / std::sqrt(cell.lattice.area());
}

/// Whether the two claims on bounds can fail for a fault that matters.
Verdict check_of_limit(const UnitCell &cell, const double limit)
{
  constexpr double that_matters = 1e-6, moderate = 1e6;
  double softest = std::numeric_limits<double>::infinity(), stiffest = 0.;
  for (const Eigen::Matrix3d &c : cell.stiffness_of_phase())
  {
    // The product of the two larger eigenvalues is below the squared trace.
    softest  = std::min(softest, c.determinant() / (c.trace() * c.trace()));
    stiffest = std::max(stiffest, c.trace());
  }
  Verdict check = at_most("checks-find-a-millionth", {}, limit, that_matters);
  if (check.outcome == Outcome::fail && stiffest / softest > moderate)
    check.outcome = Outcome::inconclusive;
  return check;
}

/// Whether the measures of all checks see what is a millionth too stiff or too soft.
Verdict check_of_measures(const Eigen::Matrix3d &stiffness)
{
  constexpr double fault = 1e-6;
  double deviation       = 0.;
  for (const double sign : {1., -1.})
  {
    const Eigen::Matrix3d other = (1. + sign * fault) * stiffness;
    deviation = larger(deviation, std::abs(energy_difference(other, stiffness) / fault - 1.));
    deviation = larger(deviation,
                       std::abs(order_violation(other, stiffness) / fault - (sign > 0. ? 1. : 0.)));
  }
  Verdict check = at_most("measures-see-a-millionth", {}, deviation, 1e-3);
  if (check.outcome == Outcome::fail &&
      std::pow(stiffness.trace(), 3) / stiffness.determinant() > 1e6)
    check.outcome = Outcome::inconclusive;
  return check;
}

std::vector<Verdict> checks_of(const UnitCell &cell, const Homogenization &result)
{
  // cwiseAbs().maxCoeff() may pass over what is not a number.
  double size = 0., gap = 0.;
  for (int k = 0; k < 9; ++k)
  {
    size = larger(size, std::abs(result.stiffness(k)));
    gap  = larger(gap, std::abs(result.stiffness(k) - result.stiffness_by_flux(k)));
  }
  // The solver leaves 1e-9 of the displacements in the energy norm of the soft phases, as its
  // preconditioner measures them; that norm may be the root of the condition too small, and
  // conjugate gradients that fall by 1e-11 in up to 130 iterations show a root of at most ten. In
  // the mean stress it counts with the stiffness of the stiff phases: by Cauchy and Schwarz with
  // the root of Voigt's energy.
  const double leverage =
    std::sqrt(result.voigt.diagonal().maxCoeff() / result.stiffness.diagonal().maxCoeff());
  const double limit = limit_of_bounds(cell, result);
  return {at_most("hill-mandel", {}, gap / size, 1e-8 * std::max(1., leverage)),
          at_most("below-voigt", {}, order_violation(result.stiffness, result.voigt), limit),
          at_most("above-reuss", {}, order_violation(result.reuss, result.stiffness), limit),
          check_of_limit(cell, limit), check_of_measures(result.stiffness)};
}

/// The strains of a chi that is linear in each triangle.
homogenization::UnitStrains strains_of(const meshes::Chi &chi, const UnitCell &cell)
{
  homogenization::UnitStrains strains(cell.mesh.n_triangles(), 9);
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    strains.row(t) = homogenization::strains_in(cell.mesh, chi, t).reshaped().transpose();
  return strains;
}

/// C of displacements that are linear in each triangle of the given mesh, 1/|Y| integral (e −
/// eps(chi)):c:(e − eps(chi)).
Eigen::Matrix3d energies_of(const meshes::Chi &chi, const UnitCell &cell)
{
  const std::vector<Eigen::Matrix3d> c = cell.stiffness_of_phase();
  const Eigen::VectorXd areas          = meshes::signed_areas(cell.mesh);
  Eigen::Matrix3d energy               = Eigen::Matrix3d::Zero();
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const Eigen::Matrix3d strain = homogenization::strains_in(cell.mesh, chi, t);
    energy += std::abs(areas(t)) * strain.transpose() *
              c[static_cast<std::size_t>(cell.mesh.material(t))] * strain;
  }
  return energy / cell.lattice.area();
}

/// What chi must be that was taken from the last mesh of an adaptive bracket and is handed on at
/// the vertices of the given one.
std::vector<Verdict> checks_of_sampled_chi(const UnitCell &cell, const Homogenization &result,
                                           const homogenization::Bracket &bracket)
{
  const meshes::ImageClasses classes = meshes::match_images(cell.mesh.vertices, cell.lattice);
  double size = 0., fault = 0.;
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    for (int k = 0; k < 6; ++k)
    {
      const double value = result.chi(v, k);
      size               = larger(size, std::abs(value));
      fault =
        larger(fault, std::abs(value -
                               result.chi(classes.representative[static_cast<std::size_t>(v)], k)));
      if (v == result.anchor)
        fault = larger(fault, std::abs(value));
    }
  const Eigen::Matrix3d energies = energies_of(result.chi, cell);
  const double limit             = limit_of_bounds(cell, result);
  return {at_most("last-mesh-chi-periodic", {}, size > 0. ? fault / size : fault, 1e-12),
          at_most("last-mesh-chi-admissible", {}, order_violation(bracket.lower, energies), limit),
          // No theorem: on a mesh that is much too coarse for them exact displacements may cost
          // more than none.
          at_most("last-mesh-chi-better", {}, order_violation(energies, result.voigt), limit)};
}
} // namespace

bool is_of_drawing(const AssessedCell &assessed)
{
  return assessed.bracket && assessed.bracket->bracket && assessed.bracket->bracket->is_of_drawing;
}

double areal_density(const UnitCell &cell, const AssessedCell &assessed)
{
  return is_of_drawing(assessed)
           ? cell.areal_density(homogenization::drawn_areas(cell.mesh, cell.curved_sides))
           : cell.areal_density();
}

AssessedCell assess(const UnitCell &cell, const homogenization::HomogenizationOptions &options,
                    const MPI_Comm communicator)
{
  AssessedCell assessed;
  assessed.result  = homogenization::homogenize(cell, options, communicator);
  assessed.options = options;
  assessed.checks  = checks_of(cell, assessed.result);
  return assessed;
}

void add_estimate(const UnitCell &cell, const unsigned long max_dofs, const MPI_Comm communicator,
                  AssessedCell &assessed)
{
  int is_bracketed = assessed.bracket && assessed.bracket->bracket;
  MPI_Bcast(&is_bracketed, 1, MPI_INT, 0, communicator);
  const unsigned long growth = assessed.options.order == 1 ? 16 : 4;
  if (is_bracketed || growth * assessed.result.n_dofs > max_dofs)
    return;
  homogenization::HomogenizationOptions finer = assessed.options;
  finer.order                                 = 2;
  finer.pieces.clear();
  finer.second_order.clear();
  ++finer.refine;
  assessed.uncertainty =
    factor_of_bars(cell) *
    (homogenization::homogenize(cell, finer, communicator).stiffness - assessed.result.stiffness)
      .cwiseAbs();
}

void add_bracket(const UnitCell &cell, const BracketOptions &options,
                 const std::function<void(const std::string &)> &report, AssessedCell &assessed)
{
  assessed.bracket = bracket_of(cell, options, report);
  // Against C^H of the given mesh, before it is replaced.
  const std::vector<Verdict> of_bracket =
    checks_of(*assessed.bracket, options, assessed.result.stiffness,
              algebraic_limit(cell, std::sqrt(0.5 * cell.mesh.n_triangles())));
  assessed.checks.insert(assessed.checks.end(), of_bracket.begin(), of_bracket.end());
  // C and chi stay those of the straight triangles where the bracket is that of a drawing.
  if (!options.tolerance || !assessed.bracket->bracket || is_of_drawing(assessed))
    return;
  const homogenization::Bracket &found = *assessed.bracket->bracket;
  assessed.is_replaced                 = assessed.bracket->history.size() > 1;
  assessed.result.stiffness            = found.stiffness;
  assessed.result.stiffness_by_flux    = found.stiffness_by_flux;
  assessed.result.chi                  = found.chi.topRows(cell.mesh.n_vertices());
  assessed.result.strains              = strains_of(assessed.result.chi, cell);
  assessed.result.n_dofs               = found.n_displacement_dofs;
  assessed.result.iterations.fill(found.iterations);
  assessed.result.seconds       = {}; // those were of the given mesh
  assessed.result.seconds.solve = assessed.bracket->history.back().seconds;
  assessed.result.second_order.clear(); // it belongs to the chi that was replaced
  assessed.uncertainty.reset();
  assessed.checks = checks_of(cell, assessed.result);
  for (const std::vector<Verdict> &some :
       {of_bracket, checks_of_sampled_chi(cell, assessed.result, found)})
    assessed.checks.insert(assessed.checks.end(), some.begin(), some.end());
}

void add_bending(const UnitCell &cell, const BracketOptions &options,
                 const std::function<void(const std::string &)> &report, AssessedCell &assessed)
{
  assessed.bending = bending_of(cell, options, report);
  if (assessed.bending->bracket)
    assessed.bending->roll = roll_of(cell, options);
  for (const Verdict &check : checks_of(*assessed.bending, options))
    assessed.checks.push_back(check);
}

KnownEdges edges_beside(const UnitCell &cell, const AssessedCell &assessed)
{
  if (assessed.edges)
    return *assessed.edges;
  if (!assessed.is_of_given_mesh())
  {
    KnownEdges none;
    none.why_not = "they belong to the chi of the mesh as given, and this one is of a finer mesh: "
                   "leave --refine and --tolerance out, or give that mesh";
    return none;
  }
  return affordable_edges(cell, assessed.options.order);
}

meshes::HomogenizedCell homogenized_cell(const UnitCell &cell, const AssessedCell &assessed,
                                         const std::string &provenance)
{
  meshes::HomogenizedCell result =
    homogenization::homogenized_cell(cell, assessed.result, provenance);
  if (assessed.bending && assessed.bending->bracket)
    result.bending = {assessed.bending->bracket->stiffness, assessed.bending->bracket->deflection};
  return result;
}
} // namespace homespun::verification
