// SPDX-License-Identifier: MIT
#include "verification/drape/drape_verdicts.h"

#include "verification/record/number_text.h"

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

const char *const derivation_of_bar =
  "P1, P2 and refined P2, and half of the time step, on a small sheet of the same run";
} // namespace

std::vector<Verdict> verdicts_of_accuracy(const std::vector<DrapeRow> &rows,
                                          const JudgedCloth &method, const std::string &reference)
{
  const OverTime localized = over_time(rows, method, reference, "localized"),
                 affine    = over_time(rows, method, reference, "affine");
  std::vector<Verdict> verdicts;
  if (localized.n_frames == 0)
    return verdicts;
  const std::string title = method.cell + " against " + reference + ": ";
  if (affine.n_frames == localized.n_frames)
    verdicts.push_back({title + "localized is closer than affine (ratio of mean errors)",
                        is_below(localized.error, localized.bar, affine.error),
                        localized.error / affine.error,
                        "< 1 by more than the bar, " + short_text(localized.bar / affine.error),
                        derivation_of_bar, Kind::method});
  const auto require = [&](const std::string &what, const double unit, const double limit)
  {
    verdicts.push_back({title + "mean error over " + what,
                        is_below(localized.error / unit, localized.bar / unit, limit),
                        localized.error / unit,
                        "<= " + short_text(limit) + ", and further away than the bar, " +
                          short_text(localized.bar / unit),
                        std::string("requirement: places in the fabric to a twentieth of the way "
                                    "that they went and to a tenth of a cell. Bar: ") +
                          derivation_of_bar,
                        Kind::method});
  };
  require("mean displacement", localized.displacement, most_per_displacement);
  require("side of a cell", method.side, most_per_cell);
  return verdicts;
}
} // namespace homespun::verification
