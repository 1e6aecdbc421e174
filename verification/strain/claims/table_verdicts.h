// SPDX-License-Identifier: MIT
// Claims that the tables of a strain study must fulfil whatever the cell: norms and their
// parts, forces of nested discretizations, and that a file gives back what was written.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/record/table.h"
#include "verification/record/verdict.h"
#include "verification/reference/loads.h"
#include "verification/strain/strain_tables.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// strain.csv: mean <= root mean square <= largest distance, in every row.
Verdict verdict_of_norms(const std::vector<StrainRow> &rows);

/// strain.csv: the mean over all vertices is made of its two parts, `interior` and `edge`, as many
/// vertices as the triangles of cells at edges have and as the others; none where no sheet of the
/// cell has an interior. All sheets of a study are of one size.
std::vector<Verdict> verdicts_of_parts(const std::vector<StrainRow> &rows,
                                       const homogenization::UnitCell &cell);

/// In linear theory the errors of strain.csv and the forces of forces.csv are proportional to the
/// strain, under every load: of errors over strain and side of the sheet the largest difference, of
/// forces the largest relative one. A claim per cell; none without two strains of one case.
/// @param left what the references leave, left_in_stress()
std::vector<Verdict> verdicts_of_proportions(const std::vector<StrainRow> &rows,
                                             const std::vector<ForceRow> &forces,
                                             const homogenization::UnitCell &cell, double left);

/// uncertainty.csv: of three discretizations none lies farther from another than the way through
/// the third one, in the mean and at the worst vertex.
Verdict verdict_of_triangles(const std::vector<UncertaintyRow> &rows);

/// Whether all strains of an infinite cloth are given: its coarse motion is known beforehand.
bool prescribes_motion(const Load &load);

/// uncertainty.csv: where the coarse motion is prescribed, what moves the error of the coarse mesh
/// alone is the reference: its distances are the reference's, over the side of the cell.
Verdict verdict_of_prescribed_motion(const std::vector<UncertaintyRow> &rows,
                                     const homogenization::UnitCell &cell);

/// gains.csv: the error of a row's base is not larger than that of its method without microscopic
/// displacement or, where it has six-node coarse triangles, of `affine+p2`.
Verdict verdict_of_bases(const std::vector<GainRow> &gains, const std::vector<StrainRow> &rows);

/// uncertainty.csv, for every cell and sheet load in linear theory: the force, twice the energy
/// over the way of the clamp and width, falls from P1 to P2 to refined P2, whose spaces contain
/// each other; none for a sheet whose P1 is exact.
std::vector<Verdict> verdicts_of_nested_forces(const std::vector<UncertaintyRow> &rows);

/// How many of the rows a file gives back otherwise, to the last bit, or not at all.
/// @throws BadInput as read_table()
template <typename Row>
int n_rows_read_otherwise(const std::vector<Row> &rows, const std::string &folder)
{
  const auto is_same = [](const Row &one, const Row &other)
  {
    bool same = true;
    Row::columns(
      [&](const char *, const auto member, const Domain)
      {
        const auto &a = one.*member, &b = other.*member;
        same = same && (a == b || (a != a && b != b)); // what is not a number stands for itself
      });
    return same;
  };
  std::map<std::vector<std::string>, Row> found; // of rows with the same keys the last one
  for (const Row &row : read_table<Row>(folder + "/" + Row::file))
    found[keys_of_row(row)] = row;
  int n = 0;
  for (const Row &row : rows)
  {
    const auto known = found.find(keys_of_row(row));
    n += known == found.end() || !is_same(row, known->second);
  }
  return n;
}

/// strain.csv gives back every number to the last bit.
/// @throws BadInput as read_table()
Verdict verdict_of_reading(const std::vector<StrainRow> &rows, const std::string &folder);
} // namespace homespun::verification
