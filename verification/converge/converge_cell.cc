// SPDX-License-Identifier: MIT
// Studies of one cell: uniform refinement, and strain under periodic loads.
#include "homogenization/fem/homogenize.h"
#include "meshes/plain/errors.h"
#include "verification/converge/cell_refinement.h"
#include "verification/converge/converge_cases.h"
#include "verification/ellipticity/default_law.h"
#include "verification/method/coarse_model.h"
#include "verification/method/fluctuation.h"
#include "verification/record/number_text.h"
#include "verification/reference/fine_reference.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
RefinementLadder refined_uniformly(const UnitCell &cell, const unsigned int order,
                                   const std::vector<int> &levels, const MPI_Comm communicator,
                                   ConvergenceResult &result)
{
  RefinementLadder ladder{order, {}};
  const auto solve = [&](const int refine)
  {
    homogenization::HomogenizationOptions options;
    options.order  = order;
    options.refine = static_cast<unsigned int>(refine);
    const homogenization::Homogenization one =
      homogenization::homogenize(cell, options, communicator);
    const auto &s = one.seconds;
    ladder.levels.push_back({std::pow(0.5, refine) / std::sqrt(cell.mesh.n_triangles()), one.n_dofs,
                             one.stiffness,
                             s.setup + s.assembly + s.preconditioner + s.solve + s.evaluation});
  };
  for (const int refine : levels)
    if (!result.solves([&]() { solve(refine); }))
      break;
  return ladder;
}

ConvergenceResult refine_uniformly(const UnitCell &cell, const ConvergenceSizes &sizes,
                                   const MPI_Comm communicator)
{
  ConvergenceResult result;
  const RefinementLadder p1 =
    refined_uniformly(cell, 1, sizes.refinements_p1, communicator, result);
  const RefinementLadder p2 =
    refined_uniformly(cell, 2, sizes.refinements_p2, communicator, result);
  judge_refinements(cell, {p1, p2}, result);
  return result;
}

/// How far an observed order may be from the one of theory.
const std::string with_settled = " +- 0.1, the change from level to level that counts as settled";

/// A method and the order in strain of its error.
struct MethodOfOrder
{
  std::string name;
  double order, tolerance;
  std::string error, theory;
};

/// Those that have a meaning under a law. The third order is seen over fewer levels before the
/// solver's share: 0.2.
std::vector<MethodOfOrder> methods_under(const Law law)
{
  std::vector<MethodOfOrder> methods = {
    {"localized", 2., 0.1, "strain squared", "chi is exact to first order in strain: order 2"},
    {"affine", 1., 0.1, "strain", "affine lacks the fluctuation: order 1"},
    {"localized+cubic+modes", 3., 0.2, "strain cubed",
     "chi and its quadratic modes are exact to second order in strain: order 3"}};
  methods.erase(std::remove_if(methods.begin(), methods.end(),
                               [&](const MethodOfOrder &method)
                               {
                                 const Method named(method.name);
                                 return !named.beyond(named.under(law)).empty();
                               }),
                methods.end());
  return methods;
}

/// Adds the errors of a method along the ladder, and what they say of its order.
/// @param reference what the method is compared with
/// @param may_be_zero whether nothing fluctuates, so that zero says nothing
void judge_method(const MethodOfOrder &method, const std::string &reference, const UnitCell &cell,
                  const bool may_be_zero, Series errors, ConvergenceResult &result)
{
  constexpr double floor = 1e-12; // of errors in cell sides: solvers stop at 1e-11 of the strain
  double largest         = 0.;    // per strain
  for (const ConvergenceLevel &level : errors.levels)
    largest = larger(largest, *level.error / level.h);
  if (largest < 1e-10)
  {
    const bool is_laminate =
      homogenization::corners_of(cell.mesh, cell.lattice, cell.stiffness_of_phase()).empty();
    const auto [outcome, limit] =
      is_laminate   ? std::pair(Outcome::pass, "< 1e-10")
      : may_be_zero ? std::pair(Outcome::inconclusive, "open: nothing fluctuates, chi is zero")
                    : std::pair(Outcome::fail, "not zero: the cell has corners");
    result.verdicts.push_back(judged(
      "method-order.zero", {{"method", method.name}, {"reference", reference}, {"limit", limit}},
      outcome, largest));
    result.add(errors);
    return;
  }
  errors.judgement =
    judge_errors(errors.sizes(), errors.errors(), about(method.order, method.tolerance), floor);
  result.add(errors, "method-order",
             {{"method", method.name},
              {"reference", reference},
              {"error", method.error},
              {"theory", method.theory},
              {"tolerance", method.tolerance}});
}

/// The distance of methods from the default law on one cell, along a ladder of strains.
ConvergenceResult climb_strains(const UnitCell &cell, const meshes::HomogenizedCell &homogenized,
                                const Load &load, const ConvergenceSizes &sizes,
                                const MPI_Comm communicator)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  ReferenceOptions options;
  options.tolerance = 1e-11;
  FineReference reference(sheet, cell.stiffness_of_phase(), options, communicator);
  const Law law = default_law(cell);
  reference.start(load, law);
  const double side                        = std::sqrt(cell.lattice.area());
  const std::vector<MethodOfOrder> methods = methods_under(law);
  std::vector<std::unique_ptr<CoarseModel>> models;
  for (const MethodOfOrder &method : methods)
    models.push_back(
      std::make_unique<CoarseModel>(CellModel{homogenized}, sheet, load, Method(method.name), law));
  std::vector<Series> all(methods.size());
  for (std::size_t m = 0; m < methods.size(); ++m)
  {
    all[m].quantity = methods[m].name + ": mean error [cell sides]";
    all[m].h_unit   = "strain";
  }
  const auto solve = [&](const double strain)
  {
    const ReferenceStep fine = reference.advance(strain);
    if (!fine.reached)
      throw meshes::NotConverged(load.name + ": " + fine.why, {});
    for (std::size_t m = 0; m < methods.size(); ++m)
    {
      const double error =
        (models[m]->upsample(models[m]->solve(strain)) - fine.positions).rowwise().norm().mean() /
        side;
      all[m].levels.insert(all[m].levels.begin(),
                           {strain, reference.n_dofs(), std::nullopt, error, fine.seconds});
    }
  };
  ConvergenceResult result;
  // References walk up; the levels of a series run from coarse to fine.
  for (auto strain = sizes.strains.rbegin(); strain != sizes.strains.rend(); ++strain)
    if (!result.solves([&]() { solve(*strain); }))
      break;
  if (all[0].levels.empty())
    return result;
  result.outcome_of_unfinished = Outcome::inconclusive; // a limit point, or one that was missed
  const Eigen::Matrix2d H      = load.gradient(1.) - Eigen::Matrix2d::Identity();
  const bool may_be_zero       = !fluctuates(homogenized, {H(0, 0), H(1, 1), H(0, 1) + H(1, 0)});
  for (std::size_t m = 0; m < methods.size(); ++m)
    judge_method(methods[m], name_of(law), cell, may_be_zero, std::move(all[m]), result);
  return result;
}
} // namespace

std::vector<ConvergenceCase> mesh_cases(const UnitCell &cell, const ConvergenceSizes &sizes,
                                        const MPI_Comm communicator)
{
  return {{cell.name, "mesh", "uniform refinement",
           [&cell, sizes, communicator]() { return refine_uniformly(cell, sizes, communicator); }}};
}

std::vector<ConvergenceCase> strain_cases(const UnitCell &cell,
                                          const meshes::HomogenizedCell &homogenized,
                                          const ConvergenceSizes &sizes,
                                          const MPI_Comm communicator)
{
  std::vector<ConvergenceCase> cases;
  for (const std::string &name : Load::names_of(LoadKind::periodic))
    cases.push_back({cell.name, "strain", name,
                     [&cell, &homogenized, load = Load(name), sizes, communicator]()
                     { return climb_strains(cell, homogenized, load, sizes, communicator); }});
  return cases;
}
} // namespace homespun::verification
