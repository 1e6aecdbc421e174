// SPDX-License-Identifier: MIT
// Which of several methods the claims, the range of validity and the sentences of a page speak of.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The first of them that has a meaning under a law and load is the method that a study speaks of.
/// The first of all errs least; `runtime.csv` says what its step takes beside those of the others.
/// These stand for it where it has no meaning, as `quadratic` in an infinite cloth, which has no
/// edges, or `edges` under a law without a second order.
inline constexpr std::array<const char *, 4> methods_by_rank = {"full", "edges", "quadratic",
                                                                "localized"};

/// @param methods names
/// @return `localized` where none of the rank is among them
inline std::string main_method(const std::vector<std::string> &methods)
{
  const auto *const found =
    std::find_if(methods_by_rank.begin(), methods_by_rank.end(),
                 [&](const char *one)
                 { return std::find(methods.begin(), methods.end(), one) != methods.end(); });
  return found == methods_by_rank.end() ? methods_by_rank.back() : *found;
}

/// The same of the rows of one case.
/// @param rows with the columns `cell`, `load`, `reference` and `method`
template <typename Row>
std::string main_method(const std::vector<Row> &rows, const Row &of_case)
{
  std::vector<std::string> methods;
  for (const Row &row : rows)
    if (row.cell == of_case.cell && row.load == of_case.load && row.reference == of_case.reference)
      methods.push_back(row.method);
  return main_method(methods);
}
} // namespace homespun::verification
