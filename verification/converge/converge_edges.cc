// SPDX-License-Identifier: MIT
// The study of edges: all terms of the method, the macro problem resolved, on sheets of more and
// more cells in linear theory.
#include "homogenization/cell/corners.h"
#include "meshes/plain/errors.h"
#include "verification/cell/cell_edges.h"
#include "verification/converge/closed_strip.h"
#include "verification/converge/converge_cases.h"
#include "verification/method/coarse_model.h"
#include "verification/reference/fine_reference.h"

#include <chrono>
#include <cmath>

namespace homespun::verification
{
using homogenization::UnitCell;

double corner_exponent(const meshes::Lattice &lattice, const Eigen::Matrix3d &stiffness,
                       const int clamped)
{
  // The edge where axis 1 ends lies along a2, the free one beside it along a1.
  Eigen::RowVector2d ray = lattice.vectors.row(1 - clamped), free = lattice.vectors.row(clamped);
  double least = 2.;
  for (const double turn : {1., -1.}) // the four corners are two, each twice
  {
    const auto angle_of = [](const Eigen::RowVector2d &v) { return std::atan2(v(1), v(0)); };
    homogenization::Corner corner;
    corner.is_closed = false;
    const double a = angle_of(ray), b = angle_of(turn * free),
                 width = std::remainder(b - a, 2. * M_PI);
    corner.clamped =
      width > 0. ? homogenization::ClampedRay::first : homogenization::ClampedRay::last;
    corner.sectors = {{std::min(a, a + width), std::max(a, a + width), stiffness}};
    for (const double exponent : homogenization::exponents_of(corner)) // none may lie below 2
      least = std::min(least, exponent);
  }
  return least;
}

namespace
{
/// What the cases of a cell share.
struct EdgedCell
{
  const UnitCell &cell;
  const meshes::HomogenizedCell &homogenized;
  KnownEdges known;
  ConvergenceSizes sizes;
  MPI_Comm communicator;
};

/// Nodes of quadratic triangles along a side of the sheet, on which the macro problem counts as
/// resolved.
constexpr int n_nodes = 160;

/// Above order 1 per cell side the next power shows beside the first one, which may have a small
/// coefficient: an error that falls faster than theory has it is no fault.
constexpr OrderLimit with_the_next = {1.1, 2.1};

Series series_of(const std::string &method)
{
  Series series;
  series.quantity = method + ": mean error per strain [cell sides]";
  series.h_unit   = "cell sides per sheet side";
  return series;
}

ConvergenceResult with_corners(const EdgedCell &of, const Load &load)
{
  constexpr double strain = 0.01; // any: the law is linear
  Series full             = series_of("full");
  const auto solve        = [&](const int n)
  {
    const meshes::Sheet sheet = meshes::tile(of.cell.mesh, of.cell.lattice, n, n);
    FineReference reference(sheet, of.cell.stiffness_of_phase(), ReferenceOptions(),
                            of.communicator);
    reference.start(load, Law::linear);
    const ReferenceStep fine = reference.advance(strain);
    if (!fine.reached)
      throw meshes::NotConverged(load.name + ": " + fine.why, {});
    const int n_quads = 2 * std::max(1, n_nodes / (2 * n));
    const CoarseModel model({of.homogenized, &*of.known.edges}, sheet, load, Method("full"),
                            Law::linear, quads_per_cell(sheet, n_quads));
    const meshes::Points positions = model.upsample(model.solve(strain));
    full.levels.push_back({1. / n, reference.n_dofs(), std::nullopt,
                           (positions - fine.positions).rowwise().norm().mean() /
                             (strain * std::sqrt(of.cell.lattice.area())),
                           fine.seconds});
  };
  ConvergenceResult result;
  for (const int n : of.sizes.cells_of_edges)
    if (!result.solves([&]() { solve(n); }))
      break;
  if (full.levels.empty())
    return result;
  const double exponent =
    corner_exponent(of.homogenized.lattice, of.homogenized.stiffness, load.axis());
  full.judgement = judge_errors(full.sizes(), full.errors(),
                                {std::min(1., 2. * exponent - 1.) - 0.1, 1.1}, 0., with_the_next);
  result.add(full, "edge-order.corners");
  return result;
}

ConvergenceResult without_corners(const EdgedCell &of)
{
  Series full = series_of("full"), localized = series_of("localized");
  const double side = std::sqrt(of.cell.lattice.area());
  const auto solve  = [&](const int n)
  {
    const auto start = std::chrono::steady_clock::now();
    const ClosedStripErrors errors =
      closed_strip_errors(of.cell, {of.homogenized, &*of.known.edges}, n);
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    full.levels.push_back({1. / n, errors.n_dofs, std::nullopt, errors.full / side, seconds});
    localized.levels.push_back(
      {1. / n, errors.n_dofs, std::nullopt, errors.localized / side, seconds});
  };
  ConvergenceResult result;
  for (const int n : of.sizes.cells_of_edges)
    if (!result.solves([&]() { solve(n); }))
      break;
  if (full.levels.empty())
    return result;
  full.judgement = judge_errors(full.sizes(), full.errors(), about(1.), 0., with_the_next);
  result.add(full, "edge-order.no-corners");
  result.add(localized);
  return result;
}
} // namespace

std::vector<ConvergenceCase> edge_cases(const UnitCell &cell,
                                        const meshes::HomogenizedCell &homogenized,
                                        const ConvergenceSizes &sizes, const MPI_Comm communicator)
{
  const auto of = std::make_shared<EdgedCell>(
    EdgedCell{cell, homogenized, known_edges(cell, 1), sizes, communicator});
  const auto guarded = [of](const std::function<ConvergenceResult()> &run)
  {
    return [of, run]()
    {
      if (of->known.edges)
        return run();
      ConvergenceResult result;
      result.unfinished            = "the cell has no terms of edges; " + of->known.why_not;
      result.outcome_of_unfinished = Outcome::inconclusive;
      return result;
    };
  };
  std::vector<ConvergenceCase> cases = {
    {cell.name, "edges", "closed along axis 1", guarded([of]() { return without_corners(*of); })}};
  for (const std::string &name : Load::names_of(LoadKind::sheet))
    cases.push_back({cell.name, "edges", name,
                     guarded([of, load = Load(name)]() { return with_corners(*of, load); })});
  return cases;
}
} // namespace homespun::verification
