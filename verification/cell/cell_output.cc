// SPDX-License-Identifier: MIT
#include "verification/cell/cell_output.h"

#include "homogenization/lint/facets.h"
#include "meshes/files/cell_file.h"
#include "meshes/files/surface_files.h"
#include "meshes/files/write_whole.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/cell/cell_bars.h"
#include "verification/cell/energy_order.h"
#include "verification/record/json_files.h"
#include "verification/record/printed_digits.h"
#include "verification/record/provenance.h"

#include <Eigen/LU>

#include <array>
#include <cstdio>
#include <limits>
#include <sstream>

namespace homespun::verification
{
using homogenization::Homogenization;
using homogenization::UnitCell;
using nlohmann::ordered_json;

namespace
{
Verdict at_most(const std::string &claim, const double value, const double limit,
                const std::string &derivation, const Kind kind = Kind::program)
{
  std::ostringstream text;
  text << "<= " << limit;
  return {claim, value <= limit ? Outcome::pass : Outcome::fail, value, text.str(), derivation,
          kind};
}

/// What a bound on an energy of C^H may miss by, relative: round-off at this size and contrast, the sums over all
/// triangles, and lattice images that lie apart.
double limit_of_bounds(const UnitCell &cell, const Homogenization &result)
{
  const auto n_triangles = static_cast<double>(result.n_dofs); // with P1; fewer with P2
  return algebraic_limit(cell, std::sqrt(0.5 * n_triangles)) +
         n_triangles * std::numeric_limits<double>::epsilon() +
         4. * result.audit.largest_gap / std::sqrt(cell.lattice.area());
}

const std::string source_of_bounds =
  "theory: 0; beside it round-off at this size and contrast, of the sums over all triangles, and the share of the area "
  "between lattice images that lie apart, four sides of the largest gap";

std::vector<Verdict> checks_of(const UnitCell &cell, const Homogenization &result)
{
  // cwiseAbs().maxCoeff() may pass over what is not a number.
  double size = 0., gap = 0.;
  for (int k = 0; k < 9; ++k)
  {
    size = larger(size, std::abs(result.stiffness(k)));
    gap  = larger(gap, std::abs(result.stiffness(k) - result.stiffness_by_flux(k)));
  }
  // The solver leaves 1e-9 of the displacements in the energy norm of the soft phases, as its preconditioner measures
  // them; that norm may be the root of the condition too small, and conjugate gradients that fall by 1e-11 in up to
  // 130 iterations show a root of at most ten. In the mean stress it counts with the stiffness of the stiff phases:
  // by Cauchy and Schwarz with the root of Voigt's energy.
  const double leverage =
    std::sqrt(result.voigt.diagonal().maxCoeff() / result.stiffness.diagonal().maxCoeff());
  const double limit = limit_of_bounds(cell, result);
  return {
    at_most(
      "Hill-Mandel: energy form and mean stress of C^H agree (relative gap)", gap / size,
      1e-8 * std::max(1., leverage),
      "the solver leaves 1e-9 of the displacements by its preconditioner, whose root of the condition is at "
      "most ten; in the mean stress this counts with the root of Voigt's energy over that of C^H"),
    at_most("C^H <= Voigt bound (relative violation)",
            order_violation(result.stiffness, result.voigt), limit, source_of_bounds),
    at_most("C^H >= Reuss bound (relative violation)",
            order_violation(result.reuss, result.stiffness), limit, source_of_bounds)};
}

/// C of displacements that are linear in each triangle of the given mesh, 1/|Y| integral (e − eps(chi)):c:(e − eps(chi)).
Eigen::Matrix3d energies_of(const meshes::CharacteristicDisplacements &chi, const UnitCell &cell)
{
  const std::vector<Eigen::Matrix3d> c = cell.stiffness_of_phase();
  Eigen::Matrix3d energy               = Eigen::Matrix3d::Zero();
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const Eigen::RowVector3i corners = cell.mesh.triangles.row(t);
    const Eigen::RowVector2d first   = cell.mesh.vertices.row(corners(0));
    Eigen::Matrix2d sides;
    Eigen::Matrix<double, 2, 6> change;
    for (int k = 0; k < 2; ++k)
    {
      sides.row(k)  = cell.mesh.vertices.row(corners(k + 1)) - first;
      change.row(k) = chi.row(corners(k + 1)) - chi.row(corners(0));
    }
    const Eigen::Matrix<double, 2, 6> gradient =
      sides.inverse() * change; // row d: derivative by x_d
    Eigen::Matrix3d strain = Eigen::Matrix3d::Identity();
    for (int load = 0; load < 3; ++load)
      strain.col(load) -= Eigen::Vector3d(gradient(0, 2 * load), gradient(1, 2 * load + 1),
                                          gradient(1, 2 * load) + gradient(0, 2 * load + 1));
    energy += 0.5 * std::abs(sides.determinant()) * strain.transpose() *
              c[static_cast<std::size_t>(cell.mesh.material(t))] * strain;
  }
  return energy / cell.lattice.area();
}

/// What chi must be that was taken from the last mesh of an adaptive bracket and is handed on at the vertices of the
/// given one.
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
  return {
    at_most(
      "chi of the last mesh is zero at the anchor and the same at lattice images (relative to the "
      "largest)",
      size > 0. ? fault / size : fault, 1e-12,
      "by definition 0; values are copied, and the anchor's is subtracted, with a rounding of 2e-16 of the coordinates' "
      "size each"),
    at_most(
      "chi of the last mesh is admissible on the given one: its energies lie above C_lower (relative "
      "violation)",
      order_violation(bracket.lower, energies), limit, source_of_bounds),
    // No theorem: on a mesh that is much too coarse for them exact displacements may cost more than none.
    at_most(
      "chi of the last mesh is better on the given one than no displacements: its energies lie below Voigt's "
      "(relative violation)",
      order_violation(energies, result.voigt), limit,
      "what better means, and round-off; where it fails the given mesh is too coarse for --tolerance",
      Kind::input)};
}

ordered_json json_matrix(const Eigen::Matrix3d &matrix)
{
  ordered_json rows = ordered_json::array();
  for (int i = 0; i < 3; ++i)
    rows.push_back({matrix(i, 0), matrix(i, 1), matrix(i, 2)});
  return rows;
}

/// Polygons in the place of arcs, of whose C^H no bar knows.
ordered_json geometry_json(const UnitCell &cell, const Homogenization &result)
{
  const auto estimate = homogenization::geometry_estimate(cell, result.chi);
  if (!estimate)
    return {};
  return {{"faceted_sides", estimate->n_facets},
          {"area", estimate->area}, // of the slivers, in parts of the cell
          {"C_change", json_matrix(estimate->change)}};
}

ordered_json json_moduli(const homogenization::EngineeringConstants &moduli)
{
  return {{"E1", json_number(moduli.E1)},
          {"E2", json_number(moduli.E2)},
          {"G12", json_number(moduli.G12)},
          {"nu12", json_number(moduli.nu12)},
          {"nu21", json_number(moduli.nu21)}};
}

ordered_json bracket_json(const AssessedCell &assessed)
{
  ordered_json json = {{"remark", assessed.bracket->remark}};
  if (assessed.bracket->bracket)
  {
    const homogenization::Bracket &found = *assessed.bracket->bracket;
    json["width"]                        = found.width; // largest v.(upper - lower).v / v.upper.v
    json["round_off"]                    = found.round_off;
    json["solver_excess"]                = found.excess;
    json["triangles"]                    = found.n_triangles;
    json["dofs"]                         = found.n_displacement_dofs;
    json["stress_dofs"]                  = found.n_stress_dofs;
    json["entry_bars"] = json_matrix(*bars_of_stiffness(assessed)); // of C as written
  }
  return json;
}

ordered_json history_json(const std::vector<BracketStep> &history)
{
  ordered_json rows = ordered_json::array();
  for (const BracketStep &step : history)
    rows.push_back({{"triangles", step.triangles},
                    {"dofs", step.dofs},
                    {"stress_dofs", step.stress_dofs},
                    {"width", step.width},
                    {"seconds", step.seconds}});
  return rows;
}

/// chi as three vector fields, for ParaView.
void write_vtu(const UnitCell &cell, const Homogenization &result, const std::string &path)
{
  const auto in_space = [](const auto &columns)
  {
    meshes::FloatPoints points = meshes::FloatPoints::Zero(columns.rows(), 3);
    points.leftCols<2>()       = columns.template cast<float>();
    return points;
  };
  std::vector<meshes::VertexData> data;
  const std::array<const char *, 3> names = {"chi_11 [m]", "chi_22 [m]", "chi_12 [m]"};
  for (int a = 0; a < 3; ++a)
    data.push_back({names[static_cast<std::size_t>(a)], in_space(result.chi.middleCols<2>(2 * a))});
  meshes::write_vtu(path, in_space(cell.mesh.vertices), cell.mesh.triangles, data,
                    {{"material", cell.mesh.material.cast<float>()}});
}

ordered_json cell_json(const UnitCell &cell)
{
  ordered_json phases = ordered_json::array();
  for (const homogenization::Phase &phase : cell.phases)
    phases.push_back({{"name", phase.name},
                      {"E1", phase.E1},
                      {"E2", phase.E2},
                      {"nu12", phase.nu12},
                      {"G12", phase.G12},
                      {"angle", phase.angle},
                      {"thickness", phase.thickness},
                      {"density", phase.density},
                      {"C", json_matrix(homogenization::plane_stress_stiffness(phase))}});
  return {{"name", cell.name},
          {"file", cell.file},
          {"vertices", cell.mesh.n_vertices()},
          {"triangles", cell.mesh.n_triangles()},
          {"phases", phases}};
}

ordered_json homogenize_json(const UnitCell &cell, const AssessedCell &assessed,
                             const unsigned int n_ranks)
{
  const Homogenization &result = assessed.result;
  const auto engineering       = homogenization::engineering_constants(result.stiffness);
  ordered_json checks          = ordered_json::array();
  for (const Verdict &check : assessed.checks)
    checks.push_back({{"name", check.claim},
                      {"value", json_number(check.value)},
                      {"limit", check.limit},
                      {"verdict", name_of(check.outcome)},
                      {"kind", name_of(check.kind)},
                      {"derivation", check.derivation}});
  // Displacements alone still bound C^H from above.
  const bool is_bracketed     = assessed.bracket && assessed.bracket->bracket;
  const auto moduli_bars      = bars_of_moduli(assessed);
  const Eigen::Matrix3d upper = is_bracketed ? assessed.bracket->bracket->upper : result.stiffness;
  return {
    {"cell", cell.name},
    {"convention", "N/m; Voigt order 11, 22, 12 with engineering shear"},
    {"C", json_matrix(result.stiffness)},
    {"C_uncertainty", assessed.uncertainty ? json_matrix(*assessed.uncertainty) : ordered_json()},
    {"C_by_mean_stress", json_matrix(result.stiffness_by_flux)},
    {"C_lower", is_bracketed ? json_matrix(assessed.bracket->bracket->lower) : ordered_json()},
    {"C_upper", json_matrix(upper)},
    {"bracket_of", is_of_drawing(assessed) ? "drawing" : "mesh"},
    {"bracket", assessed.bracket ? bracket_json(assessed) : ordered_json()},
    {"history", assessed.bracket ? history_json(assessed.bracket->history) : ordered_json::array()},
    {"geometry", geometry_json(cell, result)},
    {"voigt", json_matrix(result.voigt)},
    {"reuss", json_matrix(result.reuss)},
    {"area", cell.lattice.area()},
    {"areal_density", cell.areal_density()},
    {"engineering", json_moduli(engineering)},
    {"engineering_bars", moduli_bars ? json_moduli(*moduli_bars) : ordered_json()},
    {"order", assessed.options.order},
    {"refine", assessed.options.refine},
    {"dofs", result.n_dofs},
    {"iterations", result.iterations},
    {"loads_taken_up", result.loads_taken_up},
    {"seconds",
     {{"setup", result.seconds.setup},
      {"assembly", result.seconds.assembly},
      {"preconditioner", result.seconds.preconditioner},
      {"solve", result.seconds.solve},
      {"evaluation", result.seconds.evaluation}}},
    {"peak_memory_of_rank", assessed.peak_memory_of_rank}, // bytes
    {"checks", checks},
    // Compared with coordinates at run time; a gap beyond the tolerance would have ended the run.
    {"constraint_audit",
     {{"constrained_dofs", result.audit.n_constrained},
      {"largest_gap_m", result.audit.largest_gap}}},
    {"provenance", provenance(n_ranks)}};
}
} // namespace

AssessedCell assess(const UnitCell &cell, const homogenization::HomogenizationOptions &options,
                    const unsigned long max_dofs_of_estimate, const MPI_Comm communicator)
{
  AssessedCell assessed;
  assessed.result  = homogenization::homogenize(cell, options, communicator);
  assessed.options = options;
  homogenization::HomogenizationOptions finer = options;
  finer.order                                 = 2;
  finer.checkpoint.clear();
  finer.pieces.clear();
  ++finer.refine;
  const unsigned long growth = options.order == 1 ? 16 : 4;
  if (growth * assessed.result.n_dofs <= max_dofs_of_estimate)
    assessed.uncertainty =
      (homogenization::homogenize(cell, finer, communicator).stiffness - assessed.result.stiffness)
        .cwiseAbs();
  assessed.checks = checks_of(cell, assessed.result);
  return assessed;
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
  assessed.result.stiffness            = found.stiffness;
  assessed.result.stiffness_by_flux    = found.stiffness_by_flux;
  assessed.result.chi                  = found.chi.topRows(cell.mesh.n_vertices());
  assessed.result.n_dofs               = found.n_displacement_dofs;
  assessed.result.iterations.fill(found.iterations);
  assessed.result.seconds       = {}; // those were of the given mesh
  assessed.result.seconds.solve = assessed.bracket->history.back().seconds;
  assessed.uncertainty.reset();
  assessed.checks = checks_of(cell, assessed.result);
  for (const std::vector<Verdict> &some :
       {of_bracket, checks_of_sampled_chi(cell, assessed.result, found)})
    assessed.checks.insert(assessed.checks.end(), some.begin(), some.end());
}

void write_cell_results(const UnitCell &cell, const AssessedCell &assessed,
                        const unsigned int n_ranks, const std::string &folder)
{
  meshes::write_cell(homogenization::homogenized_cell(cell, assessed.result, provenance_line()),
                     folder + "/cell.h5");
  write_vtu(cell, assessed.result, folder + "/characteristic-displacements.vtu");
  meshes::write_whole(folder + "/cell.json", json_text(cell_json(cell)));
  meshes::write_whole(folder + "/homogenize.json",
                      json_text(homogenize_json(cell, assessed, n_ranks)));
}

std::string summary(const UnitCell &cell, const AssessedCell &assessed)
{
  const Homogenization &result = assessed.result;
  const bool is_bracketed      = assessed.bracket && assessed.bracket->bracket;
  std::ostringstream text;
  char line[240];
  text << cell.name << ": "
       << (is_bracketed && !is_of_drawing(assessed)
             ? static_cast<int>(assessed.bracket->bracket->n_triangles)
             : cell.mesh.n_triangles())
       << " triangles, " << cell.phases.size() << " phases, P" << assessed.options.order << ", "
       << result.n_dofs << " DoFs, " << result.iterations[0] << "/" << result.iterations[1] << "/"
       << result.iterations[2] << " iterations\n";
  text << "C^H" << (is_of_drawing(assessed) ? " of the drawing" : "")
       << " [N/m], Voigt 11, 22, 12 with engineering shear";
  text << (is_of_drawing(assessed) ? ", middle of its bracket, +- guaranteed:\n"
           : is_bracketed          ? ", +- guaranteed by the bracket of the mesh:\n"
           : assessed.uncertainty  ? ", +- distance to P2 on the refined mesh:\n"
                                   : " (no error bar: left out, or its mesh too large):\n");
  const auto &[stiffness, bars, moduli_bars] = shown(assessed);
  // No more digits than round-off leaves.
  constexpr double digits_of_solvers = 1e-9;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      const double scale = stiffness.cwiseAbs().maxCoeff();
      if (bars)
        std::snprintf(
          line, sizeof(line), "  %26s",
          with_bar(stiffness(i, j), larger(digits_of_solvers * scale, (*bars)(i, j))).c_str());
      else
        std::snprintf(line, sizeof(line), "  %16.6g", stiffness(i, j));
      text << line;
    }
    text << "\n";
  }
  const auto moduli = homogenization::engineering_constants(stiffness);
  if (moduli_bars)
  {
    const auto modulus = [&](const double value, const double bar)
    { return with_bar(value, larger(digits_of_solvers * std::abs(value), bar)); };
    const auto ratio = [&](const double value, const double bar)
    { return with_bar(value, larger(digits_of_solvers, bar)); };
    text << "E1 " << modulus(moduli.E1, moduli_bars->E1) << ", E2 "
         << modulus(moduli.E2, moduli_bars->E2) << ", G12 " << modulus(moduli.G12, moduli_bars->G12)
         << " N/m, nu12 " << ratio(moduli.nu12, moduli_bars->nu12) << ", nu21 "
         << ratio(moduli.nu21, moduli_bars->nu21);
  }
  else
  {
    std::snprintf(
      line, sizeof(line),
      "E1 %.3g, E2 %.3g, G12 %.3g N/m, nu12 %.3g, nu21 %.3g (three digits: no error bar)",
      moduli.E1, moduli.E2, moduli.G12, moduli.nu12, moduli.nu21);
    text << line;
  }
  std::snprintf(line, sizeof(line), "; %.4g kg/m^2\n", cell.areal_density());
  text << line;
  if (assessed.bracket)
  {
    if (is_bracketed)
    {
      std::snprintf(line, sizeof(line),
                    "Bracket of the %s, C_lower <= C^H <= C_upper of relative width %.2g, ",
                    name_of_subject(*assessed.bracket->bracket), assessed.bracket->bracket->width);
      text << line;
    }
    else
      text << "Bracket: ";
    text << assessed.bracket->remark << "\n";
  }
  if (is_of_drawing(assessed))
  {
    std::snprintf(
      line, sizeof(line),
      "C of the straight triangles, which the files and all other studies hold, differs from it by %.2g of an "
      "energy\n",
      energy_difference(result.stiffness, stiffness));
    text << line;
  }
  text << geometry_text(cell, result);
  for (const Verdict &check : assessed.checks)
  {
    std::snprintf(line, sizeof(line), "%-4s %s: %.2g (%s)\n", name_of(check.outcome).c_str(),
                  check.claim.c_str(), check.value, check.limit.c_str());
    text << line;
  }
  return text.str();
}
} // namespace homespun::verification
