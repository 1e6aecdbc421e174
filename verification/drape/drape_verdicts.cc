// SPDX-License-Identifier: MIT
#include "verification/drape/drape_verdicts.h"

#include <cmath>

namespace homespun::verification
{
namespace
{
/// Means over the frames of one method [m].
struct OverTime
{
  int n_frames        = 0;
  double error        = 0.;
  double displacement = 0.;
  double bar          = 0.; ///< not a number where that of some frame is not known
};

OverTime over_time(const std::vector<DrapeRow> &rows, const JudgedCloth &cloth,
                   const std::string &reference, const std::string &method)
{
  OverTime mean;
  for (const DrapeRow &row : rows)
    if (row.cell == cloth.cell && row.reference == reference && row.method == method &&
        row.variant == cloth.variant && row.frame > 0)
    {
      ++mean.n_frames;
      mean.error += row.mean;
      mean.displacement += row.displacement;
      mean.bar += row.uncertainty + row.time_step;
    }
  for (double *const sum : {&mean.error, &mean.displacement, &mean.bar})
    *sum /= mean.n_frames;
  return mean;
}

/// Whether a value is below a limit, by more than its bar.
Outcome is_below(const double value, const double bar, const double limit)
{
  return value + bar <= limit  ? Outcome::pass
         : value - bar > limit ? Outcome::fail
                               : Outcome::inconclusive;
}

} // namespace

std::vector<Verdict> verdicts_of_accuracy(const std::vector<DrapeRow> &rows,
                                          const JudgedCloth &method, const std::string &reference)
{
  const OverTime localized = over_time(rows, method, reference, "localized"),
                 affine    = over_time(rows, method, reference, "affine");
  std::vector<Verdict> verdicts;
  if (localized.n_frames == 0)
    return verdicts;
  const auto judge = [&](const char *claim, Words words, const double unit, const double limit)
  {
    words.insert({{"cell", method.cell}, {"reference", reference}, {"bar", localized.bar / unit}});
    verdicts.push_back(judged(claim, words,
                              is_below(localized.error / unit, localized.bar / unit, limit),
                              localized.error / unit));
  };
  if (affine.n_frames == localized.n_frames)
    judge("closer-in-scene", {}, affine.error, 1.);
  const auto require = [&](const char *what, const double unit, const double limit) {
    judge("error-in-scene", {{"unit", what}, {"limit", limit}}, unit, limit);
  };
  require("mean displacement", localized.displacement, most_per_displacement);
  require("side of a cell", method.side, most_per_cell);
  return verdicts;
}
} // namespace homespun::verification
