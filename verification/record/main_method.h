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
/// The first of all errs least; `runtime.csv`, under the law of the study's main reference, says
/// what its step takes beside those of the others. These stand for it where it has no meaning, as
/// `quadratic` in an infinite cloth, which has no edges, or `first-order` under a law without a
/// second order.
inline constexpr std::array<const char *, 5> methods_by_rank = {"full", "first-order", "edges",
                                                                "quadratic", "localized"};

/// The same against the law `yarn`, under which second order gains in the first tenths of a per
/// cent alone, as its modes grow with the anisotropy of the phases: plain-weave, pulled along a
/// yarn in an infinite cloth, `localized` -> `quadratic`, mean error over mean fluctuation: 0.1 %
/// strain 0.052 -> 0.024, 0.3 % 0.101 -> 0.135, 1 % 0.158 -> 0.661. Its methods stand in the
/// tables, and no page speaks of them. Modes fitted over a box of strains do not end there.
inline constexpr std::array<const char *, 4> methods_by_rank_of_yarns = {
  "full-fitted", "first-order", "edges", "localized"};

/// The first of a rank that is among names; the last where none is.
template <std::size_t n>
std::string first_of(const std::array<const char *, n> &rank, const std::vector<std::string> &names)
{
  const auto found = std::find_if(
    rank.begin(), rank.end(),
    [&](const char *one) { return std::find(names.begin(), names.end(), one) != names.end(); });
  return found == rank.end() ? rank.back() : *found;
}

/// @param methods names
/// @param reference the law against which they are measured
inline std::string main_method(const std::vector<std::string> &methods,
                               const std::string &reference)
{
  return reference == "yarn" ? first_of(methods_by_rank_of_yarns, methods)
                             : first_of(methods_by_rank, methods);
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
  return main_method(methods, of_case.reference);
}
} // namespace homespun::verification
