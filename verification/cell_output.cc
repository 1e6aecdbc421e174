// SPDX-License-Identifier: MIT
#include "verification/cell_output.h"

#include "homogenization/discretization.h"
#include "meshes/cell_file.h"
#include "verification/provenance.h"
#include "verification/result_files.h"

#include <deal.II/numerics/data_out.h>

#include <Eigen/Eigenvalues>

#include <cstdio>
#include <sstream>

namespace homespun::verification
{
using homogenization::Homogenization;
using homogenization::UnitCell;
using nlohmann::ordered_json;

namespace
{
/// The smallest eigenvalue of upper − lower: not negative where lower <= upper as quadratic forms.
double smallest_difference(const Eigen::Matrix3d &lower, const Eigen::Matrix3d &upper)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(upper - lower).eigenvalues()(0);
}

Verdict at_most(const std::string &claim, const double value, const double limit)
{
  std::ostringstream text;
  text << "<= " << limit;
  return {claim, value <= limit ? Outcome::pass : Outcome::fail, value, text.str()};
}

std::vector<Verdict> checks_of(const Homogenization &result)
{
  const double size = result.stiffness.cwiseAbs().maxCoeff();
  const double gap  = (result.stiffness - result.stiffness_by_flux).cwiseAbs().maxCoeff() / size;
  return {
    at_most("Hill-Mandel: energy form and mean stress of C^H agree (relative gap)", gap, 1e-8),
    at_most("C^H <= Voigt bound (relative violation)",
            std::max(0., -smallest_difference(result.stiffness, result.voigt)) / size, 1e-9),
    at_most("C^H >= Reuss bound (relative violation)",
            std::max(0., -smallest_difference(result.reuss, result.stiffness)) / size, 1e-9)};
}

ordered_json json_matrix(const Eigen::Matrix3d &matrix)
{
  ordered_json rows = ordered_json::array();
  for (int i = 0; i < 3; ++i)
    rows.push_back({matrix(i, 0), matrix(i, 1), matrix(i, 2)});
  return rows;
}

ordered_json bracket_json(const CellBracket &bracket)
{
  ordered_json json = {{"remark", bracket.remark}};
  if (bracket.bracket)
  {
    const homogenization::Bracket &found = *bracket.bracket;
    json["width"]                        = found.width; // largest v.(upper - lower).v / v.upper.v
    json["round_off"]                    = found.round_off;
    json["solver_excess"]                = found.excess;
    json["triangles"]                    = found.n_triangles;
    json["dofs"]                         = found.n_displacement_dofs;
    json["stress_dofs"]                  = found.n_stress_dofs;
    json["entry_bars"]                   = json_matrix(bars_of(found));
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
  const homogenization::Discretization linear(cell.mesh, 1, MPI_COMM_SELF);
  const auto dofs = linear.vertex_dofs();
  std::array<dealii::Vector<double>, 3> chi;
  dealii::DataOut<2> output;
  output.attach_dof_handler(linear.dof_handler);
  const std::array<const char *, 3> names = {"chi_11", "chi_22", "chi_12"};
  for (int a = 0; a < 3; ++a)
  {
    chi[a].reinit(linear.dof_handler.n_dofs());
    for (int v = 0; v < cell.mesh.n_vertices(); ++v)
      for (int c = 0; c < 2; ++c)
        chi[a](dofs(v, c)) = result.chi(v, 2 * a + c);
    output.add_data_vector(chi[a], std::vector<std::string>(2, names[a]),
                           dealii::DataOut<2>::type_dof_data,
                           {2, dealii::DataComponentInterpretation::component_is_part_of_vector});
  }
  dealii::Vector<float> material(static_cast<unsigned int>(cell.mesh.n_triangles()));
  for (const auto &dealii_cell : linear.dof_handler.active_cell_iterators())
    material(dealii_cell->active_cell_index()) = static_cast<float>(
      cell.mesh.material(homogenization::Discretization::triangle_of(dealii_cell)));
  output.add_data_vector(material, "material");
  output.build_patches(linear.element.reference_cell().template get_default_linear_mapping<2>());
  std::ostringstream text;
  output.write_vtu(text);
  write_whole(path, text.str());
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
                      {"verdict", name_of(check.outcome)}});
  // Displacements alone still bound C^H from above.
  const bool is_bracketed     = assessed.bracket && assessed.bracket->bracket;
  const Eigen::Matrix3d upper = is_bracketed ? assessed.bracket->bracket->upper : result.stiffness;
  return {
    {"cell", cell.name},
    {"convention", "N/m; Voigt order 11, 22, 12 with engineering shear"},
    {"C", json_matrix(result.stiffness)},
    {"C_uncertainty", assessed.uncertainty ? json_matrix(*assessed.uncertainty) : ordered_json()},
    {"C_by_mean_stress", json_matrix(result.stiffness_by_flux)},
    {"C_lower", is_bracketed ? json_matrix(assessed.bracket->bracket->lower) : ordered_json()},
    {"C_upper", json_matrix(upper)},
    {"bracket", assessed.bracket ? bracket_json(*assessed.bracket) : ordered_json()},
    {"history", assessed.bracket ? history_json(assessed.bracket->history) : ordered_json::array()},
    {"voigt", json_matrix(result.voigt)},
    {"reuss", json_matrix(result.reuss)},
    {"area", cell.lattice.area()},
    {"areal_density", cell.areal_density()},
    {"engineering",
     {{"E1", engineering.E1},
      {"E2", engineering.E2},
      {"G12", engineering.G12},
      {"nu12", engineering.nu12},
      {"nu21", engineering.nu21}}},
    {"order", assessed.options.order},
    {"refine", assessed.options.refine},
    {"dofs", result.n_dofs},
    {"iterations", result.iterations},
    {"seconds",
     {{"setup", result.seconds.setup},
      {"assembly", result.seconds.assembly},
      {"preconditioner", result.seconds.preconditioner},
      {"solve", result.seconds.solve},
      {"evaluation", result.seconds.evaluation}}},
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
  AssessedCell assessed{homogenization::homogenize(cell, options, communicator), options, {}, {}};
  homogenization::HomogenizationOptions finer = options;
  finer.order                                 = 2;
  ++finer.refine;
  const unsigned long growth = options.order == 1 ? 16 : 4;
  if (growth * assessed.result.n_dofs <= max_dofs_of_estimate)
    assessed.uncertainty =
      (homogenization::homogenize(cell, finer, communicator).stiffness - assessed.result.stiffness)
        .cwiseAbs();
  assessed.checks = checks_of(assessed.result);
  return assessed;
}

void add_bracket(const UnitCell &cell, const BracketOptions &options,
                 const std::function<void(const std::string &)> &report, AssessedCell &assessed)
{
  assessed.bracket = bracket_of(cell, options, report);
  for (const Verdict &check : checks_of(*assessed.bracket, options, assessed.result.stiffness))
    assessed.checks.push_back(check);
  if (!options.tolerance || !assessed.bracket->bracket)
    return;
  const homogenization::Bracket &found = *assessed.bracket->bracket;
  assessed.result.stiffness            = found.stiffness;
  assessed.result.stiffness_by_flux    = found.stiffness_by_flux;
  assessed.result.chi                  = found.chi.topRows(cell.mesh.n_vertices());
  assessed.result.n_dofs               = found.n_displacement_dofs;
  assessed.result.iterations.fill(found.iterations);
  assessed.uncertainty.reset(); // that was of the given mesh
}

void write_cell_results(const UnitCell &cell, const AssessedCell &assessed,
                        const unsigned int n_ranks, const std::string &folder)
{
  meshes::write_cell(homogenization::homogenized_cell(cell, assessed.result, provenance_line()),
                     folder + "/cell.h5");
  write_vtu(cell, assessed.result, folder + "/characteristic-displacements.vtu");
  write_whole(folder + "/cell.json", json_text(cell_json(cell)));
  write_whole(folder + "/homogenize.json", json_text(homogenize_json(cell, assessed, n_ranks)));
}

std::string summary(const UnitCell &cell, const AssessedCell &assessed)
{
  const Homogenization &result = assessed.result;
  const bool is_bracketed      = assessed.bracket && assessed.bracket->bracket;
  std::ostringstream text;
  char line[240];
  text << cell.name << ": "
       << (is_bracketed ? static_cast<int>(assessed.bracket->bracket->n_triangles)
                        : cell.mesh.n_triangles())
       << " triangles, " << cell.phases.size() << " phases, P" << assessed.options.order << ", "
       << result.n_dofs << " DoFs, " << result.iterations[0] << "/" << result.iterations[1] << "/"
       << result.iterations[2] << " iterations\n";
  text << "C^H [N/m], Voigt 11, 22, 12 with engineering shear";
  text << (is_bracketed           ? ", +- guaranteed by the bracket:\n"
           : assessed.uncertainty ? ", +- distance to P2 on the refined mesh:\n"
                                  : " (no error bar: the finer mesh would be too large):\n");
  std::optional<Eigen::Matrix3d> bars = assessed.uncertainty;
  if (is_bracketed)
    bars = bars_of(*assessed.bracket->bracket);
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
      if (bars)
      {
        // Digits down to the error bar's first; round-off of the largest entry at most.
        const double scale = result.stiffness.cwiseAbs().maxCoeff();
        const double bar   = std::max((*bars)(i, j), 1e-9 * scale);
        const int decimals =
          std::min(9, std::max(0, static_cast<int>(std::ceil(-std::log10(bar)))));
        std::snprintf(line, sizeof(line), "  %16.*f +- %-8.1g", decimals, result.stiffness(i, j),
                      bar);
        text << line;
      }
      else
      {
        std::snprintf(line, sizeof(line), "  %16.6g", result.stiffness(i, j));
        text << line;
      }
    text << "\n";
  }
  // The moduli are energies too: they carry the relative width of the bracket.
  const auto engineering = homogenization::engineering_constants(result.stiffness);
  const double width     = is_bracketed ? assessed.bracket->bracket->width : 1e-6;
  const int digits = std::min(6, std::max(1, static_cast<int>(std::ceil(-std::log10(width)))));
  std::snprintf(line, sizeof(line),
                "E1 %.*g N/m, E2 %.*g N/m, G12 %.*g N/m, nu12 %.*f, nu21 %.*f; %.4g kg/m^2\n",
                digits, engineering.E1, digits, engineering.E2, digits, engineering.G12,
                std::min(4, digits), engineering.nu12, std::min(4, digits), engineering.nu21,
                cell.areal_density());
  text << line;
  if (assessed.bracket)
  {
    if (is_bracketed)
    {
      std::snprintf(line, sizeof(line),
                    "Bracket C_lower <= C^H <= C_upper of relative width %.2g, ", width);
      text << line;
    }
    else
      text << "Bracket: ";
    text << assessed.bracket->remark << "\n";
  }
  for (const Verdict &check : assessed.checks)
  {
    std::snprintf(line, sizeof(line), "%-4s %s: %.2g (%s)\n", name_of(check.outcome).c_str(),
                  check.claim.c_str(), check.value, check.limit.c_str());
    text << line;
  }
  return text.str();
}
} // namespace homespun::verification
