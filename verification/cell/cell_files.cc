// SPDX-License-Identifier: MIT
#include "verification/cell/cell_files.h"

#include "homogenization/lint/facets.h"
#include "meshes/files/cell_file.h"
#include "meshes/files/surface_files.h"
#include "meshes/files/write_whole.h"
#include "verification/cell/cell_bars.h"
#include "verification/cell/cell_edges.h"
#include "verification/cell/cell_summary.h"
#include "verification/cell/energy_order.h"
#include "verification/cell/phase_fields.h"
#include "verification/cell/shell_sections.h"
#include "verification/record/json_files.h"
#include "verification/record/provenance.h"

#include <array>
#include <filesystem>
#include <utility>

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

/// Of narrow strips along the axes, and of their twist [N m].
ordered_json json_bending_moduli(const homogenization::EngineeringConstants &moduli)
{
  return {{"strip_1", json_number(moduli.E1)},
          {"strip_2", json_number(moduli.E2)},
          {"twist", json_number(moduli.G12)},
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

/// chi as three vector fields, for ParaView, the deflections as vectors along the third axis, and
/// strains and stresses of the triangles per unit macro strain.
void write_vtu(const UnitCell &cell, const AssessedCell &assessed, const std::string &path)
{
  const Homogenization &result = assessed.result;
  const auto in_space          = [](const auto &columns)
  {
    meshes::FloatPoints points = meshes::FloatPoints::Zero(columns.rows(), 3);
    points.leftCols<2>()       = columns.template cast<float>();
    return points;
  };
  std::vector<meshes::VertexData> data;
  const std::array<const char *, 3> names = {"chi_11 [m]", "chi_22 [m]", "chi_12 [m]"};
  for (int a = 0; a < 3; ++a)
    data.push_back({names[static_cast<std::size_t>(a)], in_space(result.chi.middleCols<2>(2 * a))});
  if (assessed.bending && assessed.bending->bracket)
    for (int a = 0; a < 3; ++a)
    {
      const std::array<const char *, 3> modes = {"deflection_11 [m^2]", "deflection_22 [m^2]",
                                                 "deflection_12 [m^2]"};
      meshes::FloatPoints out = meshes::FloatPoints::Zero(cell.mesh.n_vertices(), 3);
      out.col(2)              = assessed.bending->bracket->deflection.col(a).cast<float>();
      data.push_back({modes[static_cast<std::size_t>(a)], out});
    }
  // A group whose angle differs from triangle to triangle is one material in many directions.
  const std::vector<int> group_of_phase = cell.group_of_phase();
  meshes::FloatPoints first_axes        = meshes::FloatPoints::Zero(cell.mesh.n_triangles(), 3);
  meshes::FloatPoints second_axes       = first_axes;
  Eigen::VectorXf material(cell.mesh.n_triangles());
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const auto phase   = static_cast<std::size_t>(cell.mesh.material(t));
    const double angle = cell.phases[phase].angle * M_PI / 180.;
    material(t)        = static_cast<float>(group_of_phase[phase]);
    first_axes.row(t) << static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
      0.f;
    second_axes.row(t) << -first_axes(t, 1), first_axes(t, 0), 0.f;
  }
  meshes::WordList groups{"material names", {}};
  for (const int phase : cell.phase_of_group())
    groups.words.push_back(cell.phases[static_cast<std::size_t>(phase)].name);
  std::vector<meshes::VertexData> on_triangles = {
    {"material", material}, {"material axis 1", first_axes}, {"material axis 2", second_axes}};
  for (meshes::VertexData &field : phase_field_data(cell, result.strains))
    on_triangles.push_back(std::move(field));
  meshes::write_vtu(path, in_space(cell.mesh.vertices), cell.mesh.triangles, data, on_triangles,
                    {groups});
}

/// What a homogenize.json says of bending, appended to it.
void add_bending_json(const CellBending &bending, ordered_json &json)
{
  const bool is_known  = bending.bracket.has_value();
  json["D"]            = is_known ? json_matrix(bending.bracket->stiffness) : ordered_json();
  json["D_lower"]      = is_known ? json_matrix(bending.bracket->lower) : ordered_json();
  json["D_upper"]      = is_known ? json_matrix(bending.bracket->upper) : ordered_json();
  json["D_convention"] = "N m; moments 11, 22, 12 of the curvatures kappa11, kappa22, 2 kappa12; "
                         "thin sheet, period much "
                         "longer than the thickness";
  ordered_json bracket = {{"remark", bending.remark}};
  if (is_known)
  {
    const homogenization::BendingBracket &found = *bending.bracket;
    bracket["of"]                               = found.is_of_drawing ? "drawing" : "mesh";
    bracket["width"]                            = found.width;
    bracket["round_off"]                        = found.round_off;
    bracket["solver_excess"]                    = found.excess;
    bracket["triangles"]                        = found.n_triangles;
    bracket["deflection_dofs"]                  = found.n_deflection_dofs;
    bracket["moment_dofs"]                      = found.n_moment_dofs;
    bracket["entry_bars"]                       = json_matrix(bars_of(found));
    json["bending_moduli"]                      = json_bending_moduli(bending_moduli(found));
    json["bending_moduli_bars"] = json_bending_moduli(bars_of_bending_moduli(found));
  }
  json["bending_bracket"] = bracket;
  json["rolled"]          = bending.roll ? json_rolled(*bending.roll) : ordered_json();
  json["bending_history"] = history_json(bending.history);
}

/// Null where the cell is cut from the cloth as it is drawn.
ordered_json shift_json(const UnitCell &cell)
{
  if (!cell.shift)
    return {};
  return {{"parts", {cell.shift->parts(0), cell.shift->parts(1)}},
          {"metres", {cell.shift->metres(0), cell.shift->metres(1)}},
          {"remark", homogenization::sentence_of(*cell.shift)}};
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
          {"shift", shift_json(cell)},
          {"phases", phases}};
}

/// What the inputs are worth, appended to a homogenize.json.
void add_sensitivity_json(const UnitCell &cell, const AssessedCell &assessed,
                          const std::vector<UncertainInput> &uncertain, ordered_json &json)
{
  const std::vector<Sensitivity> all = sensitivities(cell, assessed);
  const bool bends                   = assessed.bending && assessed.bending->bracket;
  ordered_json rows                  = ordered_json::array();
  for (const Sensitivity &its : all)
    rows.push_back({{"phase", its.group},
                    {"constant", homogenization::name_of(its.constant)},
                    {"value", its.value},
                    {"unit", homogenization::unit_of(its.constant)},
                    {"C", json_matrix(its.of_C)},
                    {"D", bends ? json_matrix(its.of_D) : ordered_json()}});
  json["sensitivity"] = rows; // per unit of the constant
  if (uncertain.empty())
    return;
  ordered_json inputs = ordered_json::array();
  for (const UncertainInput &input : uncertain)
    inputs.push_back({{"phase", input.group},
                      {"constant", homogenization::name_of(input.constant)},
                      {"range", input.range},
                      {"unit", homogenization::unit_of(input.constant)}});
  const InputBars bars = input_bars(all, uncertain);
  json["input_bars"]   = {{"inputs", inputs},
                          {"C", all.empty() ? ordered_json() : json_matrix(bars.of_C)},
                          {"D", all.empty() || !bends ? ordered_json() : json_matrix(bars.of_D)}};
}

/// All but bending and what the inputs are worth.
ordered_json membrane_json(const UnitCell &cell, const AssessedCell &assessed,
                           const unsigned int n_ranks)
{
  const Homogenization &result = assessed.result;
  const auto engineering       = homogenization::engineering_constants(result.stiffness);
  ordered_json checks          = ordered_json::array();
  for (const Verdict &check : assessed.checks)
    checks.push_back({{"id", check.id},
                      {"name", check.claim},
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
    {"C_bar", is_bracketed           ? "bracket"
              : assessed.uncertainty ? "distance to P2 on the refined mesh, C_uncertainty"
                                     : "none"},
    {"C_by_mean_stress", json_matrix(result.stiffness_by_flux)},
    {"C_lower", is_bracketed ? json_matrix(assessed.bracket->bracket->lower) : ordered_json()},
    {"C_upper", json_matrix(upper)},
    {"bracket_of", is_of_drawing(assessed) ? "drawing" : "mesh"},
    {"bracket", assessed.bracket ? bracket_json(assessed) : ordered_json()},
    {"history", assessed.bracket ? history_json(assessed.bracket->history) : ordered_json::array()},
    {"geometry", geometry_json(cell, result)},
    {"voigt", json_matrix(result.voigt)},
    {"reuss", json_matrix(result.reuss)},
    {"shift", shift_json(cell)},
    {"area", cell.lattice.area()},
    {"areal_density", areal_density(cell, assessed)}, // of the same as the bracket
    {"engineering", json_moduli(engineering)},
    {"engineering_bars", moduli_bars ? json_moduli(*moduli_bars) : ordered_json()},
    {"order", assessed.options.order},
    {"refine", assessed.options.refine},
    {"dofs", result.n_dofs},
    {"solver", homogenization::name_of(result.solver)},
    {"iterations", result.iterations},
    {"abandoned_residuals", result.abandoned}, // of conjugate gradients, where `direct` took over
    {"seconds",
     {{"setup", result.seconds.setup},
      {"assembly", result.seconds.assembly},
      {"preconditioner", result.seconds.preconditioner},
      {"solve", result.seconds.solve},
      {"evaluation", result.seconds.evaluation},
      {"second_order", result.seconds.second_order}}},
    {"peak_memory_of_rank", assessed.peak_memory_of_rank}, // bytes
    {"checks", checks},
    // Compared with coordinates at run time; a gap beyond the tolerance would have ended the run.
    {"constraint_audit",
     {{"constrained_dofs", result.audit.n_constrained},
      {"largest_gap_m", result.audit.largest_gap}}},
    {"provenance", provenance(n_ranks)}};
}

ordered_json homogenize_json(const UnitCell &cell, const AssessedCell &assessed,
                             const std::vector<UncertainInput> &uncertain,
                             const unsigned int n_ranks)
{
  ordered_json json = membrane_json(cell, assessed, n_ranks);
  if (assessed.bending)
    add_bending_json(*assessed.bending, json);
  add_sensitivity_json(cell, assessed, uncertain, json);
  return json;
}

/// What /chi_quadratic of cell.h5 holds, in short.
ordered_json second_order_json(const UnitCell &cell, const AssessedCell &assessed)
{
  ordered_json laws = ordered_json::array();
  for (const auto &[law, its] : assessed.result.second_order)
    laws.push_back(law);
  ordered_json json = {{"laws", laws}};
  if (laws.empty() && assessed.options.second_order.empty())
    json["why_not"] = too_dear_second_order(cell, assessed.options);
  return json;
}

/// What /edges of cell.h5 holds, in short.
ordered_json edges_json(const KnownEdges &known)
{
  if (!known.edges)
    return {{"stored", false}, {"why_not", known.why_not}};
  ordered_json sides = ordered_json::array();
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    const meshes::CellEdge &edge = known.edges->sides[static_cast<std::size_t>(side)];
    ordered_json slip            = ordered_json::array();
    for (int c = 0; c < 2; ++c)
      slip.push_back({edge.slip(c, 0), edge.slip(c, 1), edge.slip(c, 2)}); // m
    sides.push_back({{"lattice_coordinate", meshes::axis_of_side(side) + 1},
                     {"end", meshes::is_far_side(side) ? "largest" : "smallest"},
                     {"slip", slip},
                     {"tension", {edge.tension(0), edge.tension(1), edge.tension(2)}}, // N
                     {"decay", edge.decay},
                     {"cells", edge.n_cells}});
  }
  return {{"stored", true}, {"sides", sides}, {"seconds", known.seconds}};
}

ShellSection section_of(const UnitCell &cell, const AssessedCell &assessed)
{
  const Eigen::VectorXd areas = meshes::signed_areas(cell.mesh);
  double volume               = 0.;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    volume += areas(t) * cell.phases[static_cast<std::size_t>(cell.mesh.material(t))].thickness;
  return {cell.name, assessed.result.stiffness, assessed.bending->bracket->stiffness,
          cell.areal_density(), volume / areas.sum()};
}

/// The files of write_cell_results(), and no others that a study has put there.
void copy_cell_results(const std::string &from, const std::string &to)
{
  if (std::filesystem::equivalent(from, to))
    return;
  for (const char *name :
       {"cell.h5", "characteristic-displacements.vtu", "cell.json", "shell-section-abaqus.inp",
        "shell-section-code_aster.comm", "homogenize.json"}) // the last one says that all are there
    if (const std::string file = from + "/" + name; std::filesystem::exists(file))
      std::filesystem::copy_file(file, to + "/" + name,
                                 std::filesystem::copy_options::overwrite_existing);
}
} // namespace

void write_cell_results(const UnitCell &cell, const AssessedCell &assessed,
                        const std::vector<UncertainInput> &uncertain, const unsigned int n_ranks,
                        const std::string &folder)
{
  std::filesystem::create_directories(folder);
  if (!assessed.folder.empty())
  {
    copy_cell_results(assessed.folder, folder);
    return;
  }
  meshes::HomogenizedCell homogenized = homogenized_cell(cell, assessed, provenance_line());
  const KnownEdges known              = edges_beside(cell, assessed);
  homogenized.edges                   = known.edges;
  meshes::write_cell(homogenized, folder + "/cell.h5");
  write_vtu(cell, assessed, folder + "/characteristic-displacements.vtu");
  write_json(folder + "/cell.json", cell_json(cell));
  if (assessed.bending && assessed.bending->bracket)
  {
    const ShellSection section = section_of(cell, assessed);
    meshes::write_whole(folder + "/shell-section-abaqus.inp", abaqus_section(section));
    meshes::write_whole(folder + "/shell-section-code_aster.comm", aster_section(section));
  }
  ordered_json json    = homogenize_json(cell, assessed, uncertain, n_ranks);
  json["edges"]        = edges_json(known);
  json["second_order"] = second_order_json(cell, assessed);
  write_json(folder + "/homogenize.json", json);
}
} // namespace homespun::verification
