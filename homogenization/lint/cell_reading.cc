// SPDX-License-Identifier: MIT
#include "homogenization/lint/cell_reading.h"

#include "homogenization/cell/cell_keys.h"
#include "homogenization/cell/torus_mesh.h"
#include "homogenization/lint/cell_frame.h"
#include "homogenization/lint/cell_lint.h"
#include "homogenization/lint/conformity.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/lattice.h"

#include <cmath>
#include <filesystem>
#include <ostream>
#include <set>
#include <sstream>

namespace homespun::homogenization
{
namespace
{
void add(std::vector<Finding> &findings, const std::string &kind,
         const std::vector<std::string> &messages)
{
  for (const std::string &message : messages)
    findings.push_back(finding_of(kind, message));
}

void add(std::vector<Finding> &findings, const std::string &kind,
         const std::vector<meshes::MeshFault> &faults)
{
  for (const meshes::MeshFault &fault : faults)
    findings.push_back(finding_of(kind, fault.message, fault.place));
}

/// Adds what was found in a file.
void append(std::vector<Finding> &findings, const std::string &file, std::vector<Finding> more)
{
  for (Finding &finding : more)
  {
    finding.what = file + ": " + finding.what;
    findings.push_back(std::move(finding));
  }
}

/// A part can only move where the mesh has a boundary other than its outline.
bool may_move(const meshes::TriangleMesh &mesh)
{
  return meshes::boundary_loops(mesh).size() > 1;
}

/// Pieces side by side: boundary loops other than the outline that reach beyond its box. What lies
/// inside is left to lint_mechanisms().
std::vector<meshes::MeshFault> piece_faults(const meshes::TriangleMesh &mesh,
                                            const std::string &name)
{
  const std::vector<int> outer = meshes::outline(mesh);
  Eigen::RowVector2d low = mesh.vertices.row(outer[0]), high = low;
  for (const int v : outer)
  {
    low  = low.cwiseMin(mesh.vertices.row(v));
    high = high.cwiseMax(mesh.vertices.row(v));
  }
  const double slack = 1e-6 * (high - low).norm();
  int n_pieces       = 1;
  meshes::Place place;
  for (const std::vector<int> &loop : meshes::boundary_loops(mesh))
    for (const int v : loop)
    {
      const Eigen::RowVector2d x = mesh.vertices.row(v);
      if (((low - x).array() < slack).all() && ((x - high).array() < slack).all())
        continue;
      ++n_pieces;
      place = {x, -1, v};
      break;
    }
  if (n_pieces == 1)
    return {};
  std::ostringstream text;
  text << name << ": the mesh falls into " << n_pieces
       << " pieces that share no edge, one with vertex " << place.vertex << " at (" << place.point
       << ") m; expected one outline: join parts that lie side by side so that they share points "
          "(Gmsh: BooleanFragments, or Coherence), or mesh what connects them";
  return {{text.str(), place}};
}

/// Where the outline cuts holes, and nothing else is wrong with it: cuts the cell anew, or leaves
/// it as it is drawn, without sheets, and says why.
void cut_anew_around_holes(CellReading &reading, const std::string &mesh_path)
{
  UnitCell &cell        = reading.cell;
  Eigen::VectorXi group = cell.mesh.material;
  if (!cell.phases.empty() && group.maxCoeff() < static_cast<int>(cell.phases.size()))
    for (int &its : group)
      its = cell.group_of_phase()[static_cast<std::size_t>(its)];
  CellCutAnew anew = cut_anew(cell.mesh, group, cell.curved_sides, cell.lattice);
  if (!anew.shift)
  {
    cell.lattice.cuts_holes = true;
    Finding finding         = finding_of("cut hole", mesh_path + ": " + anew.obstacle);
    finding.severity        = Severity::warning;
    reading.findings.insert(reading.findings.begin(), std::move(finding));
    return;
  }
  reading.findings.insert(reading.findings.begin(),
                          {Severity::warning, "shifted cell",
                           mesh_path + ": " + sentence_of(*anew.shift),
                           "expected holes inside: nothing is to be done where the place of the "
                           "cut does not matter; else "
                           "draw the cell from the place that is meant",
                           meshes::Place()});
  cell.mesh         = std::move(anew.mesh);
  cell.curved_sides = std::move(anew.curved_sides);
  cell.shift        = anew.shift;
}

/// Sides that match only because points within the tolerance are one, and other cloths that the
/// same outline may stand for.
void warn_of_matching(const MatchedCell &matched, const SideRules &rules,
                      const std::string &mesh_path, std::vector<Finding> &findings)
{
  const double unit = rules.metres_per_unit;
  if (matched.moved_vertex >= 0)
  {
    const Eigen::RowVector2d place = matched.mesh.vertices.row(matched.moved_vertex);
    std::ostringstream what;
    what.precision(6);
    what << mesh_path << ": opposite sides match only within the tolerance: images were moved onto "
         << "each other, vertex " << matched.moved_vertex << " at (" << place / unit
         << ") in the mesh's unit farthest, by " << matched.largest_move / unit << ", "
         << 100. * matched.largest_move / image_gap(rules, matched.lattice)
         << " % of the tolerance";
    findings.push_back({Severity::warning,
                        "nearly unmatched",
                        what.str(),
                        "expected images to agree to round-off: write coordinates in double "
                        "precision with 16 digits, and mesh opposite sides alike (Gmsh: Periodic "
                        "Curve)",
                        {place, -1, matched.moved_vertex}});
  }
  for (const meshes::Lattice &lattice : matched.alternatives)
    findings.push_back({Severity::warning, "two cloths",
                        mesh_path + ": the cell is taken as drawn in its frame, `" +
                          lattice_line(matched.lattice, unit) +
                          "`; its outline would also fill the plane otherwise",
                        "expected one cloth: set `Lattice vectors` to the first where it is meant, "
                        "else `" +
                          lattice_line(lattice, unit) + "`",
                        meshes::Place()});
}

/// The path of a file that a cell file names. It stays in the folder of the cell file, links
/// followed, so that a cell from elsewhere opens nothing but what came with it.
/// @throws BadInput where it leads out of the folder
std::string file_beside(const std::string &prm_file, const std::string &name)
{
  // Absolute, for of a file that is not there only then.
  const auto canonical = [](const std::filesystem::path &its)
  { return std::filesystem::weakly_canonical(std::filesystem::absolute(its)); };
  const std::filesystem::path folder = std::filesystem::path(prm_file).parent_path(),
                              path   = folder / name;
  const std::filesystem::path within =
    canonical(path).lexically_relative(canonical(folder.empty() ? "." : folder));
  if (within.empty() || *within.begin() == "..")
    throw meshes::BadInput(
      prm_file + ": key `Mesh`: found `" + name +
      "`, which lies outside of the folder of the cell file; expected a file in it or below: copy "
      "the mesh there");
  return path.string();
}

/// The keys, with the length unit [m]; faults become findings.
CellKeys read_keys(const std::string &prm_file, CellReading &reading)
{
  Faults faults;
  CellKeys keys;
  ParameterKeys declared;
  keys.declare(declared);
  const std::set<std::string> found = keys_set_in(prm_file);
  if (found.count("Terms") + found.count("Cells") > 0)
  {
    add(reading.findings, "key",
        {prm_file + ": is a scene; expected a cell file: `homespun drape " + prm_file +
         "` runs it, its key `Cells` names the cells"});
    return keys;
  }
  parse_parameters(prm_file, declared, faults);
  if (!faults.empty())
  {
    add(reading.findings, "key", faults);
    return keys;
  }
  const auto unit = numbers(keys.length_unit);
  if (found.count("Length unit") == 0)
    faults.push_back(prm_file + ": key `Length unit` is missing; expected metres per mesh unit, "
                                "such as `set Length unit = 0.01` of a mesh in centimetres");
  else if (unit && unit->size() == 1 && (*unit)[0] > 0. && std::isfinite((*unit)[0]))
    reading.metres_per_unit = (*unit)[0];
  else
    faults.push_back(prm_file + ": key `Length unit`: found `" + keys.length_unit +
                     "`; expected metres per mesh unit as one positive number like `0.01`" +
                     number_hint(keys.length_unit));
  if (trimmed(keys.mesh).empty())
    faults.push_back(prm_file + ": key `Mesh` is missing; expected the mesh of one cell");
  add(reading.findings, "key", faults);
  return keys;
}

/// Mesh and phases.
/// @param rounding is given that of the coordinates, in the file's unit
/// @return whether the mesh was read and is sound
bool read_mesh_and_phases(const CellKeys &keys, const MPI_Comm communicator, CellReading &reading,
                          std::string &mesh_path, double &rounding)
{
  UnitCell &cell                 = reading.cell;
  std::vector<Finding> &findings = reading.findings;
  CellMeshFile mesh_file;
  try
  {
    mesh_path = file_beside(cell.file, trimmed(keys.mesh));
    mesh_file = read_cell_mesh(mesh_path, communicator);
  }
  catch (const meshes::BadInput &bad)
  {
    add(findings, "mesh file", bad.faults());
    return false;
  }
  mesh_file.mesh.vertices *= reading.metres_per_unit;
  for (CurvedSide &side : mesh_file.curved_sides)
    side.sagitta *= reading.metres_per_unit;
  rounding         = mesh_file.rounding;
  reading.has_mesh = true;
  add(findings, "mesh", meshes::placed_faults_of(mesh_file.mesh, mesh_path));
  const bool is_sound = !has_errors(findings);
  Faults of_phases;
  const Eigen::VectorXi groups = mesh_file.mesh.material;
  cell.phases                  = assign_phases(cell.file, keys, mesh_file, of_phases);
  cell.mesh                    = std::move(mesh_file.mesh);
  cell.curved_sides            = std::move(mesh_file.curved_sides);
  if (!of_phases.empty())
    cell.mesh.material = groups;
  add(findings, "phases", of_phases);
  reading.has_phases = of_phases.empty();
  return is_sound;
}

/// Lattice, images, and what moves without energy.
/// @return whether the cell fits its images
bool read_geometry(const CellKeys &keys, const SideRules &rules, const std::string &mesh_path,
                   CellReading &reading)
{
  UnitCell &cell                 = reading.cell;
  std::vector<Finding> &findings = reading.findings;
  const auto not_joined =
    conformity_faults(cell.mesh, mesh_path, rules.slits, rules.metres_per_unit);
  add(findings, "conformity", not_joined);
  if (!not_joined.empty())
    return false;
  Faults of_lattice;
  const auto given = lattice_from(cell.file, keys, rules.metres_per_unit, of_lattice);
  add(findings, "lattice", of_lattice);
  if (!of_lattice.empty())
    return false;
  MatchedCell matched =
    match_given_or_drawn_sides(cell.mesh, cell.curved_sides, given, rules, mesh_path);
  cell.lattice = matched.lattice;
  if (!matched.faults.empty())
  {
    add(findings, "pieces", piece_faults(cell.mesh, mesh_path));
    add(findings, "periodicity", matched.faults);
    return false;
  }
  warn_of_matching(matched, rules, mesh_path, findings);
  cell.mesh         = std::move(matched.mesh);
  cell.curved_sides = std::move(matched.curved_sides);
  if (matched.cuts_holes)
    cut_anew_around_holes(reading, mesh_path);
  append(findings, mesh_path, lint_missing_triangles(cell.mesh, rules.metres_per_unit));
  if (cell.lattice.cuts_holes || may_move(cell.mesh))
    append(findings, mesh_path, lint_mechanisms(cell.mesh, cell.lattice, rules.metres_per_unit));
  return true;
}
} // namespace

CellReading read_unit_cell_with_findings(const std::string &prm_file, const MPI_Comm communicator)
{
  CellReading reading;
  UnitCell &cell                 = reading.cell;
  std::vector<Finding> &findings = reading.findings;
  cell.file                      = prm_file;
  cell.name                      = std::filesystem::path(prm_file).stem().string();
  if (!std::filesystem::is_regular_file(prm_file))
  {
    add(findings, "file",
        {prm_file + ": no such file; expected a cell file (.prm): `homespun cells` lists "
                    "the shipped ones"});
    return reading;
  }
  const CellKeys keys = read_keys(prm_file, reading);
  if (has_errors(findings))
    return reading;

  std::string mesh_path;
  double rounding          = 0.;
  const bool mesh_is_sound = read_mesh_and_phases(keys, communicator, reading, mesh_path, rounding);
  if (!reading.has_mesh)
    return reading;
  Faults of_rules;
  const SideRules rules = side_rules(prm_file, keys, reading.metres_per_unit, rounding, of_rules);
  add(findings, "key", of_rules);
  const bool fits  = mesh_is_sound && read_geometry(keys, rules, mesh_path, reading);
  reading.is_whole = fits && of_rules.empty() && reading.has_phases;
  if (reading.is_whole)
    append(findings, prm_file, lint_contrast(cell));
  if (reading.is_whole && !cell.curved_sides.empty())
    try
    {
      glued(cell.mesh, cell.lattice, cell.curved_sides);
    }
    catch (const meshes::BadInput &bad)
    {
      add(findings, "periodicity", {mesh_path + ": " + bad.what()});
      reading.is_whole = false;
    }
  return reading;
}

CellReading inspect_cell(const std::string &prm_file)
{
  CellReading reading  = read_unit_cell_with_findings(prm_file, MPI_COMM_NULL);
  const UnitCell &cell = reading.cell;
  if (!reading.has_mesh || !cell.mesh.vertices.allFinite())
    return reading;
  std::vector<Finding> &findings = reading.findings;
  append(findings, prm_file, lint_slivers(cell.mesh, reading.metres_per_unit));
  const Eigen::RowVector2d box =
    cell.mesh.vertices.colwise().maxCoeff() - cell.mesh.vertices.colwise().minCoeff();
  const double side = reading.is_whole ? std::sqrt(cell.lattice.area()) : std::sqrt(box.prod());
  append(findings, prm_file, lint_size(side, reading.metres_per_unit));
  if (reading.is_whole)
  {
    append(findings, prm_file, lint_phases(cell, side));
    append(findings, prm_file, lint_continuity(cell, reading.metres_per_unit));
    append(findings, prm_file, lint_thin_parts(cell, reading.metres_per_unit));
    append(findings, prm_file, lint_facets(cell, reading.metres_per_unit));
  }
  return reading;
}

UnitCell read_unit_cell(const std::string &prm_file, const MPI_Comm communicator,
                        std::ostream *const warnings)
{
  static const std::set<std::string> of_the_drawing = {"nearly unmatched", "two cloths",
                                                       "missing triangle", "cut hole"};
  CellReading reading = read_unit_cell_with_findings(prm_file, communicator);
  std::vector<std::string> faults;
  for (const Finding &finding : reading.findings)
    if (finding.severity == Severity::error)
      faults.push_back(text_of(finding));
  if (!faults.empty())
    throw meshes::BadInput(faults);
  for (const Finding &finding : reading.findings)
    if (warnings && of_the_drawing.count(finding.kind) > 0)
      *warnings << "warning: " << text_of(finding) << "\n";
  return std::move(reading.cell);
}
} // namespace homespun::homogenization
