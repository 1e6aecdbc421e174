// SPDX-License-Identifier: MIT
// Cases of a strain study: the rows of one cell, load and reference.
#pragma once

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
} // namespace homespun::verification
