// SPDX-License-Identifier: MIT
#include "verification/cell/cell_files.h"

#include "homogenization/lint/facets.h"
#include "meshes/files/cell_file.h"
#include "meshes/files/surface_files.h"
#include "meshes/files/write_whole.h"
#include "verification/cell/cell_bars.h"
#include "verification/cell/energy_order.h"
#include "verification/record/json_files.h"
#include "verification/record/provenance.h"

#include <array>

namespace homespun::verification
{
using homogenization::Homogenization;
using homogenization::UnitCell;
using nlohmann::ordered_json;

namespace
{
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
} // namespace homespun::verification
