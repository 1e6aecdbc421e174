// SPDX-License-Identifier: MIT
// Studies of one cell: uniform refinement, and strain under periodic loads.
#include "homogenization/homogenize.h"
#include "meshes/errors.h"
#include "verification/converge_cases.h"
#include "verification/fine_reference.h"
#include "verification/lightweight_cloth.h"
#include "verification/manufactured_cases.h"

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <map>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
/// Relative changes of C^H below this are round-off and what solvers leave, whose residuals of 1e-11 enter an
/// energy squared.
constexpr double stiffness_floor = 1e-10;

struct Refinement
{
  unsigned int order;
  double h; ///< sqrt of the mean area of the triangles over the cell side
  homogenization::Homogenization result;
  double seconds;
};

std::vector<Refinement> refinements(const UnitCell &cell, const unsigned int order,
                                    const std::vector<int> &levels, const MPI_Comm communicator)
{
  std::vector<Refinement> ladder;
  for (const int refine : levels)
  {
    homogenization::HomogenizationOptions options;
    options.order  = order;
    options.refine = static_cast<unsigned int>(refine);
    const homogenization::Homogenization one =
      homogenization::homogenize(cell, options, communicator);
    const auto &s = one.seconds;
    ladder.push_back({order, std::pow(0.5, refine) / std::sqrt(cell.mesh.n_triangles()), one,
                      s.setup + s.assembly + s.preconditioner + s.solve + s.evaluation});
  }
  return ladder;
}

/// Smallest eigenvalue of larger − smaller over the size of the larger; not negative where larger >= smaller.
double loewner_gap(const Eigen::Matrix3d &larger, const Eigen::Matrix3d &smaller)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(larger - smaller).eigenvalues()(0) /
         larger.norm();
}

Series series_of(const std::vector<Refinement> &ladder, const std::string &quantity,
                 double (*function)(const Eigen::Matrix3d &))
{
  Series series;
  series.quantity = quantity;
  series.order    = ladder.front().order;
  series.h_unit   = "cell side";
  for (const Refinement &one : ladder)
    series.levels.push_back(
      {one.h, one.result.n_dofs, function(one.result.stiffness), std::nullopt, one.seconds});
  const Richardson limit = extrapolated(series.sizes(), series.values(),
                                        stiffness_floor * ladder.back().result.stiffness.norm());
  if (limit.exists)
  {
    series.richardson = limit;
    for (ConvergenceLevel &level : series.levels)
      level.error = std::abs(*level.value - limit.limit);
  }
  return series;
}

double trace_of(const Eigen::Matrix3d &C)
{
  return C.trace();
}

ConvergenceResult refine_uniformly(const UnitCell &cell, const ConvergenceSizes &sizes,
                                   const MPI_Comm communicator)
{
  ConvergenceResult result;
  std::vector<std::vector<Refinement>> ladders = {
    refinements(cell, 1, sizes.refinements_p1, communicator),
    refinements(cell, 2, sizes.refinements_p2, communicator)};
  const Eigen::Matrix3d &best = ladders[1].back().result.stiffness;
  double largest_change = 0., lowest_gap = 1.;
  for (const std::vector<Refinement> &ladder : ladders)
    for (std::size_t k = 0; k < ladder.size(); ++k)
    {
      const Eigen::Matrix3d &C = ladder[k].result.stiffness;
      largest_change           = std::max(largest_change, (C - best).norm() / best.norm());
      if (k > 0)
        lowest_gap = std::min(lowest_gap, loewner_gap(ladder[k - 1].result.stiffness, C));
    }
  const bool is_exact = largest_change <= stiffness_floor;
  const bool corners  = has_corners(cell);
  result.verdicts.push_back(
    {"C^H falls from level to level in the Loewner order: P1 and P2 (smallest eigenvalue of a difference "
     "over the norm)",
     lowest_gap >= -stiffness_floor ? Outcome::pass : Outcome::fail, lowest_gap, ">= -1e-10"});
  if (is_exact)
    result.verdicts.push_back(
      {"C^H is the same on every level and for both orders: the characteristic displacements are "
       "piecewise linear as in a laminate (largest relative difference)",
       Outcome::pass, largest_change, "<= 1e-10"});

  std::vector<Series> traces;
  for (const std::vector<Refinement> &ladder : ladders)
  {
    Series trace   = series_of(ladder, "trace of C^H [N/m]", trace_of);
    const double p = trace.order;
    if (!is_exact)
    {
      const OrderLimit expected = corners ? OrderLimit{0.05, 2. * p + 0.2} : about(2. * p, 0.2);
      trace.judgement =
        judge_values(trace.sizes(), trace.values(), expected, stiffness_floor * best.norm());
    }
    traces.push_back(trace);
    const std::string claim =
      corners ? "the energy converges with twice the exponent of the corners: between 0 and 2p"
              : "the energy converges with order 2p: no phase has a corner";
    result.add(trace, claim + "; P" + std::to_string(trace.order));
    const std::array<std::pair<const char *, double (*)(const Eigen::Matrix3d &)>, 6> entries = {
      {{"C11 [N/m]", [](const Eigen::Matrix3d &C) { return C(0, 0); }},
       {"C22 [N/m]", [](const Eigen::Matrix3d &C) { return C(1, 1); }},
       {"C66 [N/m]", [](const Eigen::Matrix3d &C) { return C(2, 2); }},
       {"C12 [N/m]", [](const Eigen::Matrix3d &C) { return C(0, 1); }},
       {"C16 [N/m]", [](const Eigen::Matrix3d &C) { return C(0, 2); }},
       {"C26 [N/m]", [](const Eigen::Matrix3d &C) { return C(1, 2); }}}};
    for (const auto &[name, function] : entries)
      result.add(series_of(ladder, name, function));
  }
  if (!is_exact)
  {
    const auto &a = traces[0], &b = traces[1];
    Verdict verdict = {
      "Richardson limits of P1 and P2 agree (their distance over the sum of both error bars)",
      Outcome::inconclusive, std::nan(""), "<= 1 where both orders have settled"};
    if (a.richardson && b.richardson)
    {
      verdict.value = std::abs(a.richardson->limit - b.richardson->limit) /
                      (a.richardson->gci + b.richardson->gci);
      const bool have_settled = a.judgement->outcome != Outcome::inconclusive &&
                                b.judgement->outcome != Outcome::inconclusive;
      verdict.outcome = verdict.value <= 1. ? Outcome::pass
                        : have_settled      ? Outcome::fail
                                            : Outcome::inconclusive;
    }
    result.verdicts.push_back(verdict);
  }
  return result;
}

/// The distance of `localized` and `affine` from biot on one cell, along a ladder of strains.
ConvergenceResult climb_strains(const UnitCell &cell, const meshes::HomogenizedCell &homogenized,
                                const Load &load, const ConvergenceSizes &sizes,
                                const MPI_Comm communicator)
{
  constexpr double floor    = 1e-12; // of errors in cell sides: solvers stop at 1e-11 of the strain
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  ReferenceOptions options;
  options.tolerance = 1e-11;
  FineReference reference(sheet, cell.stiffness_of_phase(), options, communicator);
  reference.start(load, Law::biot);
  LightweightCloth cloth(homogenized, sheet, load);
  const double side                      = std::sqrt(cell.lattice.area());
  const std::vector<std::string> methods = {"localized", "affine"};
  std::vector<Series> all(2);
  for (std::size_t m = 0; m < 2; ++m)
  {
    all[m].quantity = methods[m] + ": mean error [cell sides]";
    all[m].h_unit   = "strain";
  }
  // References walk up; the levels of a series run from coarse to fine.
  for (auto strain = sizes.strains.rbegin(); strain != sizes.strains.rend(); ++strain)
  {
    const ReferenceStep fine = reference.advance(*strain);
    if (!fine.reached)
      throw meshes::NotConverged(load.name + ": " + fine.why, {});
    const auto coarse = cloth.solve(Law::biot, *strain).positions;
    for (std::size_t m = 0; m < 2; ++m)
    {
      const double error =
        (cloth.upsample(Method(methods[m]), Law::biot, coarse).positions - fine.positions)
          .rowwise()
          .norm()
          .mean() /
        side;
      all[m].levels.insert(all[m].levels.begin(),
                           {*strain, reference.n_dofs(), std::nullopt, error, fine.seconds});
    }
  }
  ConvergenceResult result;
  for (std::size_t m = 0; m < 2; ++m)
  {
    double largest = 0.; // per strain
    for (const ConvergenceLevel &level : all[m].levels)
      largest = std::max(largest, *level.error / level.h);
    const std::string what = methods[m] + " against biot";
    if (largest < 1e-10)
    {
      result.verdicts.push_back(
        {what + ": zero to round-off at every level as where the law is linear in this "
                "load (largest error per strain and cell side)",
         Outcome::pass, largest, "< 1e-10"});
      result.add(all[m]);
      continue;
    }
    all[m].judgement =
      judge_errors(all[m].sizes(), all[m].errors(), about(m == 0 ? 2. : 1.), floor);
    result.add(all[m], what + (m == 0 ? " errs by strain squared" : " errs by strain"));
  }
  return result;
}
} // namespace

bool has_corners(const UnitCell &cell)
{
  const meshes::TriangleMesh &mesh   = cell.mesh;
  const meshes::ImageClasses classes = meshes::match_images(mesh.vertices, cell.lattice);
  // An edge and its periodic images: the classes of its ends, and the lattice vector between them.
  using Edge = std::array<int, 4>;
  std::map<Edge, std::vector<int>> phases;
  std::map<Edge, Eigen::RowVector2d> directions;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      int a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
      const auto of = [&](const int v)
      { return classes.representative[static_cast<std::size_t>(v)]; };
      if (of(a) > of(b))
        std::swap(a, b);
      const Eigen::RowVector2i offset = classes.offset.row(b) - classes.offset.row(a);
      const Edge edge                 = {of(a), of(b), offset(0), offset(1)};
      phases[edge].push_back(mesh.material(t));
      directions[edge] = (mesh.vertices.row(b) - mesh.vertices.row(a)).normalized();
    }
  std::map<int, std::vector<Eigen::RowVector2d>> leaving; // along interfaces, from each vertex
  for (const auto &[edge, sides] : phases)
    if (sides.size() != 2 || sides[0] != sides[1])
    {
      leaving[edge[0]].push_back(directions[edge]);
      leaving[edge[1]].push_back(-directions[edge]);
    }
  for (const auto &[vertex, rays] : leaving)
    if (rays.size() != 2 || (rays[0] + rays[1]).norm() > 1e-6)
      return true;
  return false;
}

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
  for (const char *name : {"periodic-11", "periodic-22", "periodic-12"})
    cases.push_back({cell.name, "strain", name,
                     [&cell, &homogenized, load = Load(name), sizes, communicator]()
                     { return climb_strains(cell, homogenized, load, sizes, communicator); }});
  return cases;
}

std::vector<ConvergenceCase> manufactured_study_cases(const MPI_Comm communicator)
{
  std::vector<ConvergenceCase> cases;
  for (const ManufacturedCase &one : manufactured_cases())
    cases.push_back(
      {"none", "manufactured", one.name + "; P" + std::to_string(one.order),
       [&one, communicator]()
       {
         const ManufacturedLadder ladder = climb(one, communicator);
         const ManufacturedClaims claims = judge(one, ladder);
         ConvergenceResult result;
         const auto add = [&](const char *quantity, const std::vector<double> &errors,
                              const OrderJudgement &judgement, const char *claim)
         {
           Series series;
           series.quantity  = quantity;
           series.order     = one.order;
           series.h_unit    = one.h_unit;
           series.judgement = judgement;
           for (std::size_t k = 0; k < errors.size(); ++k)
             series.levels.push_back({ladder.h[k], ladder.n_dofs[k], std::nullopt, errors[k], 0.});
           result.add(series, claim);
         };
         add("L2 error [side]", ladder.L2, claims.L2,
             one.has_H1 ? "the L2 error has order p + 1" : "the L2 error has order 1");
         if (one.has_H1)
           add("H1 error [-]", ladder.H1, claims.H1, "the H1 error has order p");
         result.verdicts.push_back(
           {"the algebraic error lies 100 times below the smallest L2 error (their ratio)",
            claims.algebraic_share <= 0.01 ? Outcome::pass : Outcome::inconclusive,
            claims.algebraic_share, "<= 0.01"});
         return result;
       }});
  return cases;
}
} // namespace homespun::verification
