// SPDX-License-Identifier: MIT
// Cases of a strain study: the rows of one cell, load and reference.
#pragma once

#include "verification/law/laws.h"
#include "verification/reference/loads.h"

#include <algorithm>
#include <vector>

namespace homespun::verification
{
/// Whether two rows, of one table or of two, are of one case.
template <typename Row, typename Other>
bool is_of_case(const Row &row, const Other &of_case)
{
  return row.cell == of_case.cell && row.load == of_case.load && row.reference == of_case.reference;
}

/// The first row of every case.
template <typename Row>
std::vector<Row> cases_of(const std::vector<Row> &rows)
{
  std::vector<Row> cases;
  for (const Row &row : rows)
    if (std::none_of(cases.begin(), cases.end(),
                     [&](const Row &known) { return is_of_case(row, known); }))
      cases.push_back(row);
  return cases;
}

/// The first row of every case in linear theory on a sheet.
template <typename Row>
std::vector<Row> linear_sheets_of(const std::vector<Row> &rows)
{
  std::vector<Row> all = cases_of(rows);
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const Row &row) {
                             return row.reference != name_of(Law::linear) ||
                                    Load(row.load).is_periodic();
                           }),
            all.end());
  return all;
}
} // namespace homespun::verification
