// SPDX-License-Identifier: MIT
#include "verification/drape/drape_verdicts.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace homespun::verification
{
namespace
{
double bar_of(const DrapeRow &row)
{
  return row.uncertainty + row.time_step;
}

/// Means over the frames of one method [m].
struct OverTime
{
  std::set<int> frames;
  double error        = 0.;
  double displacement = 0.;
  double bar          = 0.; ///< not a number where that of some frame is not known
};

/// @param method whose rows are those of its own cloth, if it has one
/// @param among these frames alone; empty: all after the beginning
OverTime over_time(const std::vector<DrapeRow> &rows, const JudgedErrors &of,
                   const std::string &method, const std::set<int> &among = {})
{
  OverTime mean;
  for (const DrapeRow &row : rows)
    if (row.cell == of.cell && row.reference == of.reference && row.method == method &&
        (row.variant == of.variant || row.variant == method) && row.frame > 0 &&
        (among.empty() || among.count(row.frame) > 0))
    {
      mean.frames.insert(row.frame);
      mean.error += row.mean;
      mean.displacement += row.displacement;
      mean.bar += bar_of(row);
    }
  for (double *const sum : {&mean.error, &mean.displacement, &mean.bar})
    *sum /= static_cast<double>(mean.frames.size());
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

Verdict verdict_of_closer(const std::vector<DrapeRow> &rows, const JudgedErrors &of,
                          const std::string &method, const std::string &other)
{
  const OverTime one = over_time(rows, of, method), than = over_time(rows, of, other, one.frames);
  const bool has_bars =
    std::any_of(rows.begin(), rows.end(),
                [&](const DrapeRow &row)
                { return row.reference == of.reference && std::isfinite(bar_of(row)); });
  const double ratio = one.error / than.error, bar = (one.bar + than.bar) / than.error;
  const std::string why = than.frames != one.frames ? "not among the methods of these frames"
                          : !has_bars ? "the reference has no error bar, and `left_out` in "
                                        "drape.json says why"
                          : !std::isfinite(bar) ? "of some frame an error bar is not known"
                                                : "";
  return judged("closer-in-scene",
                {{"cell", of.cell},
                 {"reference", of.reference},
                 {"method", method},
                 {"other", other},
                 {"note", why.empty() ? ", " + short_text(bar) : "; open: " + why}},
                why.empty() ? is_below(ratio, bar, 1.) : Outcome::inconclusive, ratio);
}

std::string judged_method(const std::vector<DrapeRow> &rows, const std::string &cell)
{
  std::string method = "affine";
  for (const DrapeRow &row : rows)
    if (row.cell == cell && row.method != "affine" && method != "localized")
      method = row.method;
  return method;
}

std::vector<Verdict> verdicts_of_accuracy(const std::vector<DrapeRow> &rows, const JudgedErrors &of,
                                          const double side)
{
  const std::string method = judged_method(rows, of.cell);
  const OverTime errors    = over_time(rows, of, method);
  std::vector<Verdict> verdicts;
  if (errors.frames.empty())
    return verdicts;
  if (method != "affine" && over_time(rows, of, "affine").frames == errors.frames)
    verdicts.push_back(verdict_of_closer(rows, of, method, "affine"));
  const auto require = [&](const char *what, const double unit, const double limit)
  {
    verdicts.push_back(judged("error-in-scene",
                              {{"cell", of.cell},
                               {"reference", of.reference},
                               {"method", method},
                               {"unit", what},
                               {"limit", limit},
                               {"bar", errors.bar / unit}},
                              is_below(errors.error / unit, errors.bar / unit, limit),
                              errors.error / unit));
  };
  require("mean displacement", errors.displacement, most_per_displacement);
  require("side of a cell", side, most_per_cell);
  return verdicts;
}
} // namespace homespun::verification
