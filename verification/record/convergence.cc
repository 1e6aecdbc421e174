// SPDX-License-Identifier: MIT
#include "verification/record/convergence.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace homespun::verification
{
namespace
{
constexpr double none          = std::numeric_limits<double>::quiet_NaN();
constexpr double safety_factor = 1.25;
constexpr double lowest_order = 1e-2, highest_order = 20.; ///< of values that converge

std::string number(const double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

OrderJudgement judgement(const Outcome outcome, const std::string &why)
{
  OrderJudgement result;
  result.outcome = outcome;
  result.order   = none;
  result.spread  = none;
  result.why     = why;
  return result;
}

/// What makes levels unusable whatever their order is; empty where nothing does.
std::string fault_of(const std::vector<double> &h, const std::vector<double> &values)
{
  if (h.size() != values.size())
    return std::to_string(h.size()) + " sizes but " + std::to_string(values.size()) + " values";
  for (std::size_t k = 0; k < h.size(); ++k)
  {
    if (!std::isfinite(values[k]))
      return "level " + std::to_string(k) + " is not a number";
    if (!(h[k] > 0.) || !std::isfinite(h[k]) || (k > 0 && !(h[k] < h[k - 1])))
      return "level " + std::to_string(k) + " is not finer than the one before";
  }
  return "";
}

/// The slope on the levels [first, last).
double slope_of(const std::vector<double> &h, const std::vector<double> &errors,
                const std::size_t first, const std::size_t last)
{
  const auto of = [&](const std::vector<double> &values)
  {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(first),
                               values.begin() + static_cast<std::ptrdiff_t>(last));
  };
  return log_slope(of(h), of(errors));
}

/// How far orders may still go in the direction of their last change: a change that falls by a
/// common factor adds up to a geometric sum, else it may go on for as many levels as there are.
double reach_of(const std::vector<double> &orders)
{
  const std::size_t n = orders.size();
  const double drift  = orders[n - 1] - orders[n - 2];
  const double ratio  = n >= 3 ? drift / (orders[n - 2] - orders[n - 3]) : none;
  return ratio > 0. && ratio < 1. ? drift * ratio / (1. - ratio) : drift * static_cast<double>(n);
}

/// What orders say whose last one lies below the limit.
Outcome below(const std::vector<double> &orders, const OrderLimit &limit, std::string &why)
{
  const std::size_t n = orders.size();
  const double drift  = orders[n - 1] - orders[n - 2];
  if (drift > settled || (drift > 0. && orders[n - 1] + reach_of(orders) >= limit.lowest))
  {
    why = "not yet in the asymptotic range: the orders drift towards the limit";
    return Outcome::inconclusive;
  }
  // One that rose above the limit before it fell below swings, and its next step is not known.
  if (orders[n - 2] > limit.highest && (n < 3 || orders[n - 2] > orders[n - 3]))
  {
    why = "not in the asymptotic range: the orders swing across the limit";
    return Outcome::inconclusive;
  }
  why = drift < -settled ? "the error stops falling above its bar: the orders fall below the limit"
                         : "orders have settled outside of the limit";
  return Outcome::fail;
}

/// The same of a last one above the limit. Orders that rise there have terms that cancel, which
/// ends on finer levels; a plateau does not.
Outcome above(const std::vector<double> &orders, const OrderLimit &limit, std::string &why)
{
  const std::size_t n = orders.size();
  const double drift  = orders[n - 1] - orders[n - 2];
  if (!(std::abs(drift) <= settled) ||
      (drift < 0. && orders[n - 1] + reach_of(orders) <= limit.highest))
  {
    why = "not yet in the asymptotic range: the orders are above the limit and move";
    return Outcome::inconclusive;
  }
  why = "orders have settled outside of the limit";
  return Outcome::fail;
}

/// Judges two orders or more that follow one another, of which `result.order` is the measured one.
void conclude(const std::vector<double> &orders, const OrderLimit &limit, OrderJudgement &result)
{
  const double before = orders[orders.size() - 2], last = orders.back();
  std::string why;
  if (last < limit.lowest)
    result.outcome = below(orders, limit, why);
  else if (last > limit.highest)
    result.outcome = above(orders, limit, why);
  else if (std::abs(last - before) <= settled && limit.contains(result.order))
  {
    result.outcome = Outcome::pass;
    why            = "orders have settled";
  }
  else
  {
    result.outcome = Outcome::inconclusive;
    why = "not yet in the asymptotic range: the last order is within the limit and has not settled";
  }
  result.why = why + ": the last two are " + number(before) + " and " + number(last);
}
} // namespace

double log_slope(const std::vector<double> &x, const std::vector<double> &y)
{
  const auto n  = static_cast<double>(x.size());
  double mean_x = 0., mean_y = 0., covariance = 0., variance = 0.;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    mean_x += std::log(x[k]) / n;
    mean_y += std::log(y[k]) / n;
  }
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    covariance += (std::log(x[k]) - mean_x) * (std::log(y[k]) - mean_y);
    variance += (std::log(x[k]) - mean_x) * (std::log(x[k]) - mean_x);
  }
  return covariance / variance;
}

OrderLimit about(const double order, const double tolerance)
{
  return {order - tolerance, order + tolerance};
}

std::string text_of(const OrderLimit &limit)
{
  const double middle = 0.5 * (limit.lowest + limit.highest);
  const double half   = 0.5 * (limit.highest - limit.lowest);
  return half < 0.35 ? number(middle) + " +- " + number(half)
                     : number(limit.lowest) + " to " + number(limit.highest);
}

double order_beside_a_corner(const double exponent, const double h)
{
  const double difference = 2. * exponent - 2., cells = -std::log(h);
  return 2. - (difference == 0. ? 1. / cells : difference / std::expm1(difference * cells));
}

OrderJudgement judge_errors(const std::vector<double> &h, const std::vector<double> &errors,
                            const OrderLimit &limit, const double floor,
                            const std::optional<OrderLimit> &together)
{
  const auto finished = [&](OrderJudgement result)
  {
    result.limits = limit;
    result.limit  = text_of(limit);
    result.observed.resize(errors.size(), none);
    return result;
  };
  if (const std::string fault = fault_of(h, errors); !fault.empty())
    return finished(judgement(Outcome::fail, fault));
  if (std::any_of(errors.begin(), errors.end(), [](const double e) { return e < 0.; }))
    return finished(judgement(Outcome::fail, "an error is negative"));

  const auto n = static_cast<std::size_t>(
    std::find_if(errors.begin(), errors.end(), [&](const double e) { return !(e > floor); }) -
    errors.begin());
  std::vector<double> observed(errors.size(), none), orders;
  bool grows = n >= 2;
  for (std::size_t k = 1; k < n; ++k)
  {
    observed[k] = std::log(errors[k - 1] / errors[k]) / std::log(h[k - 1] / h[k]);
    orders.push_back(observed[k]);
    grows = grows && errors[k] > errors[k - 1];
  }
  OrderJudgement result = judgement(Outcome::inconclusive, "");
  result.observed       = observed;
  for (std::size_t k = 1; k < n; ++k)
    if (std::abs(errors[k] - errors[k - 1]) <= 1e-12 * errors[k])
    {
      result.outcome = Outcome::fail;
      result.why     = "levels " + std::to_string(k - 1) + " and " + std::to_string(k) +
                   " have the same error: the refinement did nothing";
      return finished(result);
    }
  if (n >= 3)
  {
    result.order  = slope_of(h, errors, n - 3, n);
    result.spread = std::max(std::abs(orders[orders.size() - 1] - result.order),
                             std::abs(orders[orders.size() - 2] - result.order));
  }
  if (grows)
  {
    result.outcome = Outcome::fail;
    result.why     = "the error grows at every level";
  }
  else if (n < fewest_levels)
    result.why = std::to_string(n) + " levels above the floor of " + number(floor) +
                 "; an order needs " + std::to_string(fewest_levels);
  else
    conclude(orders, limit, result);
  // Only orders that were concluded lie in a range of positive ones.
  if (result.outcome == Outcome::fail && together && together->contains(result.order) &&
      orders.back() >= together->lowest) // a last one below is no power's
  {
    result.outcome = Outcome::inconclusive;
    result.why     = "not yet in the asymptotic range: several powers show together at " +
                 number(together->lowest) + " to " + number(together->highest) +
                 result.why.substr(result.why.rfind(": "));
  }
  return finished(result);
}

OrderJudgement judge_uneven_errors(const std::vector<double> &h, const std::vector<double> &errors,
                                   const OrderLimit &limit)
{
  constexpr std::size_t n_fitted = fewest_uneven_levels, n_last = 3;
  OrderJudgement result = judgement(Outcome::inconclusive, "");
  result.limits         = limit;
  result.limit          = text_of(limit);
  result.observed.assign(errors.size(), none);
  const std::size_t n = errors.size();
  std::string fault   = fault_of(h, errors);
  if (fault.empty() &&
      std::any_of(errors.begin(), errors.end(), [](const double e) { return !(e > 0.); }))
    fault = "an error is not positive";
  if (!fault.empty())
  {
    result.outcome = Outcome::fail;
    result.why     = fault;
    return result;
  }
  for (std::size_t k = 1; k < n; ++k)
    result.observed[k] = slope_of(h, errors, k - 1, k + 1);
  if (n < n_fitted)
  {
    result.why = std::to_string(n) + " levels; this order needs " + std::to_string(n_fitted);
    return result;
  }
  result.order      = slope_of(h, errors, n - n_fitted, n);
  const double last = slope_of(h, errors, n - n_last, n);
  result.spread     = std::abs(result.order - last);
  if (limit.contains(result.order) && limit.contains(last))
    result.outcome = Outcome::pass;
  else
    conclude({result.order, last}, limit, result);
  result.why = (result.why.empty() ? "" : result.why.substr(0, result.why.rfind(": ")) + ": ") +
               "the slope of the last five levels is " + number(result.order) +
               " and of the last three " + number(last);
  return result;
}

Richardson extrapolated(const std::vector<double> &h, const std::vector<double> &values,
                        const double floor, const double formal_order)
{
  Richardson result;
  result.order = result.limit = result.gci = none;
  const std::size_t n                      = values.size();
  if (const std::string fault = fault_of(h, values); !fault.empty() || n < 3)
  {
    result.why = fault.empty() ? "fewer than three levels" : fault;
    return result;
  }
  const double h3 = h[n - 3], h2 = h[n - 2], h1 = h[n - 1];
  const double coarse = values[n - 3] - values[n - 2], fine = values[n - 2] - values[n - 1];
  if (!(std::abs(coarse) > floor) || !(std::abs(fine) > floor))
  {
    result.why = "the values differ by no more than the floor of " + number(floor);
    return result;
  }
  if (coarse / fine < 0.)
  {
    result.why = "the values oscillate";
    return result;
  }
  // Grows with p, from negative orders (values that run away) to positive ones.
  const auto ratio_at = [&](const double p)
  {
    return (std::pow(h3, p) - std::pow(h2, p)) / (std::pow(h2, p) - std::pow(h1, p)) -
           coarse / fine;
  };
  double lower = -highest_order, upper = highest_order;
  if (!(ratio_at(lower) < 0.) || !(ratio_at(upper) > 0.))
  {
    result.why = "the values follow no power of h";
    return result;
  }
  // 100 halvings end between two neighbouring numbers, never on p = 0, where the ratio is not
  // defined.
  for (int k = 0; k < 100; ++k)
  {
    const double middle = 0.5 * (lower + upper) + (lower + upper == 0. ? 1e-3 : 0.);
    (ratio_at(middle) < 0. ? lower : upper) = middle;
  }
  result.order = 0.5 * (lower + upper);
  if (result.order < lowest_order)
  {
    result.why = "the values run away: their differences do not fall";
    return result;
  }
  result.exists         = true;
  const auto correction = [&](const double p)
  { return fine * std::pow(h1, p) / (std::pow(h2, p) - std::pow(h1, p)); };
  result.limit = values[n - 1] - correction(result.order);
  result.gci   = safety_factor * std::abs(correction(std::min(result.order, formal_order)));
  return result;
}

OrderJudgement judge_values(const std::vector<double> &h, const std::vector<double> &values,
                            const OrderLimit &limit, const double floor)
{
  OrderJudgement result = judgement(Outcome::inconclusive, "");
  result.limits         = limit;
  result.limit          = text_of(limit);
  result.observed.assign(values.size(), none);
  if (const std::string fault = fault_of(h, values); !fault.empty())
  {
    result.outcome = Outcome::fail;
    result.why     = fault;
    return result;
  }
  std::size_t n_levels = values.size();
  for (std::size_t k = 1; k < n_levels; ++k)
  {
    const double difference = std::abs(values[k] - values[k - 1]);
    if (difference == 0. && floor == 0.)
    {
      result.outcome = Outcome::fail;
      result.why     = "levels " + std::to_string(k - 1) + " and " + std::to_string(k) +
                   " have the same value: the refinement did nothing";
      return result;
    }
    if (!(difference > floor))
      n_levels = k;
  }
  if (n_levels < fewest_levels)
  {
    result.why = std::to_string(n_levels) + " levels above the floor of " + number(floor) +
                 "; an order needs " + std::to_string(fewest_levels);
    return result;
  }
  std::vector<double> orders;
  for (std::size_t n = 3; n <= n_levels; ++n)
  {
    const Richardson three =
      extrapolated({h.begin(), h.begin() + static_cast<long>(n)},
                   {values.begin(), values.begin() + static_cast<long>(n)}, floor);
    result.observed[n - 1] = three.order;
    if (std::isfinite(three.order))
      orders.push_back(three.order);
    else
    {
      orders.clear();
      result.why = "not in the asymptotic range: " + three.why;
    }
  }
  if (orders.size() < 2)
    return result;
  result.order  = orders.back();
  result.spread = std::abs(orders.back() - orders[orders.size() - 2]);
  conclude(orders, limit, result);
  return result;
}
} // namespace homespun::verification
