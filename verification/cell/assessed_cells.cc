// SPDX-License-Identifier: MIT
#include "verification/cell/assessed_cells.h"

#include "meshes/files/cell_file.h"
#include "meshes/plain/errors.h"
#include "verification/cell/study_inputs.h"
#include "verification/record/fields.h"
#include "verification/record/json_files.h"
#include "verification/record/on_root.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace homespun::verification
{
using homogenization::UnitCell;
using meshes::Law;

namespace
{
/// DoFs up to which the finer problem of the error bar is solved where a study finds no bracket.
constexpr unsigned long largest_error_bar_of_study = 300000;

/// Names are unique in a run; the same name may come with another mesh in another one.
std::string key_of(const UnitCell &cell)
{
  return cell.name + " " + fingerprint(cell);
}

AssessedCell by_p1(const UnitCell &cell, const std::vector<Law> &second_order,
                   const MPI_Comm communicator)
{
  homogenization::HomogenizationOptions p1;
  p1.order              = 1;
  p1.second_order       = second_order;
  AssessedCell assessed = assess(cell, p1, communicator);
  BracketOptions bracket;
  bracket.order = p1.order;
  on_root(communicator,
          [&]()
          {
            add_bracket(
              cell, bracket, [](const std::string &) {}, assessed);
          });
  add_estimate(cell, largest_error_bar_of_study, communicator, assessed);
  return assessed;
}

/// Gives the D^H of the first rank to all.
void share_bending(const UnitCell &cell, const MPI_Comm communicator, AssessedCell &assessed)
{
  if (!answer_of_root(assessed.bending && assessed.bending->bracket, communicator))
    return;
  homogenization::BendingBracket found;
  if (assessed.bending)
    found = *assessed.bending->bracket;
  found.deflection.conservativeResize(cell.mesh.n_vertices(), 3);
  for (Eigen::Matrix3d *const matrix : {&found.stiffness, &found.lower, &found.upper})
    MPI_Bcast(matrix->data(), 9, MPI_DOUBLE, 0, communicator);
  MPI_Bcast(found.deflection.data(), static_cast<int>(found.deflection.size()), MPI_DOUBLE, 0,
            communicator);
  if (!assessed.bending)
    assessed.bending = CellBending{found, "handed on by the first rank", false, {}};
}

Eigen::Matrix3d matrix_of(const nlohmann::json &rows)
{
  Eigen::Matrix3d matrix;
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      matrix(i, j) =
        rows.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j)).get<double>();
  return matrix;
}

std::vector<Verdict> checks_in(const nlohmann::json &list)
{
  std::vector<Verdict> checks;
  for (const nlohmann::json &one : list)
  {
    Verdict check{one.at("name"), Outcome::fail, std::nan(""), one.at("limit"),
                  one.at("derivation")};
    check.id = one.value("id", "");
    if (one.at("value").is_number())
      check.value = one.at("value");
    if (!read_field(one.at("verdict").get<std::string>(), check.outcome) ||
        !read_field(one.at("kind").get<std::string>(), check.kind))
      throw meshes::BadInput("check `" + check.claim + "` has an unknown verdict or kind");
    checks.push_back(check);
  }
  return checks;
}
} // namespace

const AssessedCell &AssessedCells::of(const UnitCell &cell, const CellNeeds &needs,
                                      const MPI_Comm communicator, std::vector<Verdict> &verdicts)
{
  const std::string key = key_of(cell);
  const auto found      = cells.find(key);
  const bool is_known =
    found != cells.end() &&
    std::all_of(needs.second_order.begin(), needs.second_order.end(),
                [&](const Law law)
                { return found->second.result.second_order.count(name_of(law)) != 0; });
  if (!is_known)
    cells[key] = by_p1(cell, needs.second_order, communicator);
  AssessedCell &its = cells[key];
  if (needs.edges && !its.edges)
    its.edges = known_edges(cell, its.options.order);
  if (needs.bending && !answer_of_root(its.bending.has_value(), communicator))
  {
    on_root(communicator,
            [&]()
            {
              const auto taken = bendings.find(key);
              its.bending      = taken != bendings.end()
                                   ? taken->second
                                   : bending_of(cell, {}, [](const std::string &) {});
            });
    share_bending(cell, communicator, its);
  }
  std::vector<Verdict> checks = its.checks;
  if (needs.bending && is_root(communicator))
    for (const Verdict &check : checks_of(*its.bending, {}))
      checks.push_back(check);
  for (Verdict &check : checks)
  {
    check.claim      = cell.name + ": " + check.claim;
    check.of["cell"] = cell.name;
    verdicts.push_back(check);
  }
  return its;
}

bool AssessedCells::read(const UnitCell &cell, const std::string &folder,
                         const MPI_Comm communicator)
{
  // homogenize.json is written last.
  const std::string file = folder + "/homogenize.json";
  if (cells.count(key_of(cell)) != 0 ||
      !answer_of_root(std::filesystem::exists(file), communicator))
    return false;
  AssessedCell its;
  its.options.order = 1;
  its.folder        = folder;
  try
  {
    const nlohmann::json json           = read_json(file);
    meshes::HomogenizedCell homogenized = meshes::read_cell(folder + "/cell.h5");
    its.result.stiffness                = homogenized.stiffness;
    its.result.chi                      = homogenized.chi;
    its.result.anchor                   = homogenized.anchor;
    its.result.second_order             = homogenized.second_order;
    its.result.stiffness_by_flux        = matrix_of(json.at("C_by_mean_stress"));
    its.result.voigt                    = matrix_of(json.at("voigt"));
    its.result.reuss                    = matrix_of(json.at("reuss"));
    // Edges that are not there were too dear for the file, or impossible: of() finds out.
    if (homogenized.edges)
      its.edges = KnownEdges{std::move(homogenized.edges), {}, 0.};
    its.checks = checks_in(json.at("checks"));
  }
  catch (const nlohmann::json::exception &damage)
  {
    throw meshes::BadInput(file + ": is damaged (" + damage.what() +
                           "); expected what homespun writes there: begin anew with --overwrite");
  }
  cells[key_of(cell)] = its;
  return true;
}

void AssessedCells::take_bending(const UnitCell &cell, const CellBending &bending)
{
  bendings[key_of(cell)] = bending;
}
} // namespace homespun::verification
