// SPDX-License-Identifier: MIT
#include "verification/upsample/valid_strain.h"

#include "meshes/files/cell_file.h"
#include "meshes/plain/errors.h"
#include "verification/record/main_reference.h"
#include "verification/record/number_text.h"
#include "verification/record/run_folder.h"
#include "verification/record/validity_table.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace homespun::verification
{
namespace fs = std::filesystem;

namespace
{
/// The table that belongs to a cell; empty where there is none.
std::string table_of(const fs::path &cell_file)
{
  const fs::path folder = fs::absolute(cell_file).parent_path();
  for (const fs::path &place : {folder, folder.parent_path()})
    if (fs::exists(place / ValidityRow::file))
      return (place / ValidityRow::file).string();
  return "";
}

std::string joined(const std::set<std::string> &names)
{
  std::string text;
  for (const std::string &name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

/// The largest principal strain of a load at its strain.
double principal_strain(const std::string &load, const double strain)
{
  Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
  if (load == "periodic-all")
    F += strain * (Eigen::Matrix2d() << 1., 1., 0., 0.5).finished();
  else if (load.find("shear") != std::string::npos || load.find("12") != std::string::npos)
    F(0, 1) = strain;
  else
    return strain;
  return F.jacobiSvd().singularValues()(0) - 1.;
}

std::string cell_of(const std::vector<ValidityRow> &rows, const std::string &file,
                    const fs::path &cell_file)
{
  std::set<std::string> names;
  for (const ValidityRow &row : rows)
    names.insert(row.cell);
  const std::string wanted = fs::absolute(cell_file).parent_path().filename();
  if (names.count(wanted) != 0)
    return wanted;
  if (names.size() == 1)
    return *names.begin();
  throw meshes::BadInput(file + ": holds the cells " + joined(names) +
                         "; expected one cell, or one that is named as the folder of " +
                         cell_file.string());
}

/// Why the cell that the run of a table has left beside it is another one; empty where it is not,
/// or where it left none.
std::string other_cell(const meshes::HomogenizedCell &cell, const std::string &file,
                       const std::string &name)
{
  const fs::path tried = fs::absolute(file).parent_path() / name / "cell.h5";
  if (!fs::exists(tried))
    return "";
  const meshes::HomogenizedCell other = meshes::read_cell(tried);
  const auto differs                  = [](const auto &one, const auto &two, const double tolerance)
  { return (one - two).norm() > tolerance * two.norm(); };
  const auto sentence = [&](const std::string &what)
  { return file + ": is of the cell " + tried.string() + ", whose " + what + " is another one"; };
  if (differs(cell.lattice.vectors, other.lattice.vectors, 1e-6))
    return sentence("lattice");
  return differs(cell.stiffness, other.stiffness, 0.05) ? sentence("C^H") : "";
}
} // namespace

bool are_alike_in_a_plane(const localization::Method &one, const localization::Method &other)
{
  constexpr localization::Term curved = localization::Term::curved;
  return one.without(curved).has_terms_of(other.without(curved));
}

std::optional<ValidStrain> valid_strain(const meshes::HomogenizedCell &cell,
                                        const std::string &cell_file,
                                        const std::string &validity_file, const double limit,
                                        const localization::GivenMethod &given)
{
  const std::string file = validity_file.empty() ? table_of(cell_file) : validity_file;
  if (file.empty())
    return {};
  check_format(fs::absolute(file).parent_path());
  const std::vector<ValidityRow> rows = read_table<ValidityRow>(file);
  ValidStrain valid;
  valid.file  = file;
  valid.limit = limit;
  valid.cell  = cell_of(rows, file, cell_file);
  if (const std::string why = other_cell(cell, file, valid.cell); !why.empty())
  {
    if (validity_file.empty())
      return {};
    throw meshes::BadInput(why + "; expected the table of " + cell_file +
                           ": run `homespun strain` with this cell");
  }
  const std::string main = main_reference(rows, valid.cell);
  valid.law              = main.rfind("yarn", 0) == 0 ? main : "biot";
  const auto is_of_cell  = [&](const ValidityRow &row)
  {
    return row.cell == valid.cell && row.reference == valid.law && row.measure == "cell side" &&
           row.method != "base";
  };
  std::map<std::string, std::set<std::string>> loads_of;
  for (const ValidityRow &row : rows)
    if (is_of_cell(row))
      loads_of[row.method].insert(row.load);
  const bool is_studied =
    meshes::name_of(given.law) == valid.law && (!given.used.has(localization::Term::edges) ||
                                                given.options.slip == localization::Slip::of_cloth);
  valid.method = "localized";
  for (const auto &[method, loads] : loads_of)
    if (is_studied && loads == loads_of["localized"] &&
        are_alike_in_a_plane(localization::Method(method), given.used))
      valid.method = method;
  bool is_told = false;
  std::set<std::string> limits;
  for (const ValidityRow &row : rows)
  {
    // The motion may be anybody's: nothing is known of what moved the coarse cloth.
    if (!is_of_cell(row) || row.method != valid.method)
      continue;
    const bool is_unknown = row.relation == "?";
    if (row.relation != "-" && !is_unknown && !std::isfinite(row.largest))
      throw meshes::BadInput(file + ": the row of cell " + row.cell + ", load " + row.load +
                             " has no largest strain; expected a number beside `" + row.relation +
                             "`: run `homespun strain` again");
    limits.insert(short_text(row.limit));
    if (std::abs(row.limit - limit) > 1e-9 * limit)
      continue;
    if (is_unknown)
    {
      valid.unknown += ", of " + row.load + " no range is known (" + row.note + ")";
      continue;
    }
    const bool is_none  = row.relation == "-";
    const double strain = is_none ? 0. : principal_strain(row.load, row.largest);
    if (is_told && strain >= valid.strain)
      continue;
    is_told       = true;
    valid.strain  = strain;
    valid.load    = row.load;
    valid.is_open = row.relation == ">";
  }
  if (!is_told && !valid.unknown.empty())
    return {};
  if (!is_told)
    throw meshes::BadInput(file + ": has no row of cell " + valid.cell + ", reference " +
                           valid.law + ", measure `cell side` and limit " + short_text(limit) +
                           "; found the limits " + joined(limits) +
                           ": choose one of them with --limit, or run `homespun strain` with "
                           "--references " +
                           valid.law);
  return valid;
}
} // namespace homespun::verification
