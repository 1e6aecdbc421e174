// SPDX-License-Identifier: MIT
#include "verification/bend/bend_verdicts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace homespun::verification
{
namespace
{
/// Errors below this, in curvature x cell side² and curvature x cell side, are what solvers leave.
constexpr double bent_to = 1e-7;

struct Quantity
{
  const char *name;
  double BendRow::*error;
  double BendRow::*bar;
  int power; ///< of the cell side in its size
};

constexpr std::array<Quantity, 2> quantities = {{
  {"position", &BendRow::mean, &BendRow::bar, 2},
  {"normal", &BendRow::normal, &BendRow::normal_bar, 1},
}};

struct Pair
{
  const char *method;
  std::vector<const char *> others; ///< the better of them counts
  const char *id;
};

const std::vector<Pair> pairs = {{"full", {"affine", "affine+edges"}, "bent-closer.base"},
                                 {"full", {"affine"}, "bent-closer.affine"},
                                 {"localized", {"affine"}, "bent-closer.localized"}};

/// A load as claims name it.
std::string named(const std::string &load, const std::string &reference)
{
  return reference == "linear" ? load : load + " at large turns";
}

const BendRow *row_of(const std::vector<BendRow> &rows, const std::string &method)
{
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const BendRow &row) { return row.method == method; });
  return found == rows.end() ? nullptr : &*found;
}

Verdict verdict_on(const BendRow &of, const std::vector<BendRow> &rows, const Pair &pair,
                   const Quantity &what)
{
  const BendRow *const one = row_of(rows, pair.method);
  const BendRow *than      = nullptr;
  for (const char *other : pair.others)
    if (const BendRow *const row = row_of(rows, other))
      if (than == nullptr || row->*what.error < than->*what.error)
        than = row;
  Words words        = {{"cell", of.cell},
                        {"load", named(of.load, of.reference)},
                        {"what", what.name},
                        {"method", pair.method},
                        {"note", ""}};
  const auto verdict = [&](const Outcome outcome, const double value)
  { return judged(pair.id, words, outcome, value); };
  if (one == nullptr || than == nullptr)
  {
    words["note"] =
      rows.empty() ? "; open: no equilibrium was found" : "; open: no terms of edges are known";
    return verdict(Outcome::inconclusive, BendRow::none);
  }
  if (pair.others.size() > 1)
    words["note"] = "; base: " + than->method;
  const double error = one->*what.error, other = than->*what.error,
               bars = one->*what.bar + than->*what.bar, gain = other - error,
               size = one->bending * std::pow(one->side, what.power - 1);
  if (!(std::max(error, other) > bent_to * size))
  {
    words["note"] += "; open: there is nothing to restore";
    return verdict(Outcome::inconclusive, BendRow::none);
  }
  if (!std::isfinite(bars))
    words["note"] += "; open: an error bar is not known";
  return verdict(gain > bars    ? Outcome::pass
                 : gain < -bars ? Outcome::fail
                                : Outcome::inconclusive,
                 other > 0. ? error / other : BendRow::none);
}
} // namespace

std::vector<Verdict> verdicts_on_bending(const BendRow &of, const std::vector<BendRow> &rows)
{
  std::vector<Verdict> verdicts;
  for (const Pair &pair : pairs)
    for (const Quantity &what : quantities)
      verdicts.push_back(verdict_on(of, rows, pair, what));
  return verdicts;
}

void add_owed_of_bending(const std::string &cell, const std::string &load,
                         const std::string &reference, std::vector<OwedClaim> &owed)
{
  for (const Pair &pair : pairs)
    for (const Quantity &what : quantities)
      owed.push_back(
        {pair.id, {{"cell", cell}, {"load", named(load, reference)}, {"what", what.name}}});
}

Verdict verdict_on_wrinkles(const WrinkleRow &row)
{
  const double ratio  = row.compression / row.most_compression,
               limit  = 1. + row.compression_bar / row.most_compression;
  const bool is_known = std::isfinite(ratio) && std::isfinite(limit);
  return judged("wrinkle-bound",
                {{"cell", row.cell},
                 {"axis", row.axis},
                 {"cells", row.cells_per_wave},
                 {"limit", is_known ? limit : 1.},
                 {"note", is_known ? "" : "; open: no wave was found"}},
                !is_known        ? Outcome::inconclusive
                : ratio <= limit ? Outcome::pass
                                 : Outcome::fail,
                ratio);
}

void add_owed_of_wrinkles(const std::string &cell, const std::vector<int> &cells_per_wave,
                          std::vector<OwedClaim> &owed)
{
  for (const int axis : {1, 2})
    for (const int cells : cells_per_wave)
      owed.push_back({"wrinkle-bound", {{"cell", cell}, {"axis", axis}, {"cells", cells}}});
}
} // namespace homespun::verification
