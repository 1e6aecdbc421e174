// SPDX-License-Identifier: MIT
// Observed orders of convergence, and what may be concluded from them. A quantity is computed on
// levels of true size h (a mesh width, a cell per sheet, a strain, a time step), coarse to fine.
//
// Where the exact value is known, the error e obeys e = C h^p (1 + o(1)):
//   p_k = ln(e_k / e_(k+1)) / ln(h_k / h_(k+1)),
// and the order is the least-squares slope of ln e against ln h on the three finest levels. Where
// it is not known, three values f1 (finest), f2, f3 give order and limit at once,
//   (f3 − f2) / (f2 − f1) = (h3^p − h2^p) / (h2^p − h1^p)
//   f0 = f1 − (f2 − f1) h1^p / (h2^p − h1^p),
// with the grid convergence index 1.25 |f1 − f0| as error bar (Roache 1994; unequal ratios: Celik
// et al., J. Fluids Eng. 130, 2008).
//
// An order is judged against limits on both sides that were written down before. PASS: it has
// settled within them. FAIL: the last order lies below them and does not rise, or it has settled
// above: an error that ends on a plateau a has the order p C h^p / (a + C h^p), which falls, and no
// finer level mends that. INCONCLUSIVE: the orders still move towards the limits, or swing across
// them. A plateau that round-off or a solver explains is no finding: levels at such a floor are
// left out.
#pragma once

#include "verification/record/verdict.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What an order must lie in, both ends included.
struct OrderLimit
{
  double lowest, highest;

  bool contains(double order) const
  {
    return order >= lowest && order <= highest;
  }
};

/// Least-squares slope of log y against log x, for positive values.
double log_slope(const std::vector<double> &x, const std::vector<double> &y);

/// order ± tolerance.
OrderLimit about(double order, double tolerance = 0.1);

/// "2 +- 0.1" or "1 to 2".
std::string text_of(const OrderLimit &limit);

/// Two orders that follow one another have settled where they differ by no more than this.
constexpr double settled = 0.1;

/// Fewest levels on which an order is judged, and on which one of levels that do not grow evenly
/// is. A study whose settings make fewer claims no order.
constexpr std::size_t fewest_levels = 4, fewest_uneven_levels = 5;

/// A measured order and what follows from it.
struct OrderJudgement
{
  Outcome outcome = Outcome::inconclusive;
  /// On the three finest levels; not a number where there are fewer.
  double order = 0.;
  /// Largest distance of the orders on those levels from it.
  double spread = 0.;
  /// Per level: the order between the level before and this one; not a number where there is none.
  std::vector<double> observed;
  std::string why;              ///< one clause, without commas
  OrderLimit limits = {0., 0.}; ///< what it was judged against
  std::string limit;            ///< the same as text
};

/// Judges errors against a known value.
///
/// FAIL: an error that is not a number, levels that do not become finer, two levels with the same
/// error (a refinement that did nothing), errors that grow at every level, a last order below the
/// limit that does not rise, orders settled outside of the limit. INCONCLUSIVE: fewer than four
/// levels above the floor, orders that move towards the limit, swing across it, or rise above it,
/// orders outside of the limit that powers of h show together before the lowest one leads.
/// @param h (n) sizes, falling
/// @param errors (n) not negative
/// @param floor what round-off and solvers leave in an error; from the first error below it the
///   levels are left out, because they show the floor and no order
/// @param together what several powers may show, in the order and in the last one
OrderJudgement judge_errors(const std::vector<double> &h, const std::vector<double> &errors,
                            const OrderLimit &limit, double floor = 0.,
                            const std::optional<OrderLimit> &together = std::nullopt);

/// The order at h, in sheet sides, of the h^2 and h^(2 lambda) that a corner with the exponent
/// lambda leaves. Near lambda = 1 their coefficients are large and cancel, h^2 (1 − h^s) / s with
/// s = 2 lambda − 2, and they part slowly: 2 − s / (h^−s − 1).
double order_beside_a_corner(double exponent, double h);

/// Judges errors on levels that do not grow evenly, as adaptive meshes do, by the least-squares
/// slopes of the last five levels (which is the order) and of the last three.
/// PASS: both lie within the limit. Else the two are judged as orders that follow one another are
/// in judge_errors(); INCONCLUSIVE too: fewer than five levels.
OrderJudgement judge_uneven_errors(const std::vector<double> &h, const std::vector<double> &errors,
                                   const OrderLimit &limit);

/// Order and limit of three values.
struct Richardson
{
  bool exists  = false; ///< false: the differences grow, change sign, or lie at the floor
  double order = 0.;    ///< negative where the values run away
  double limit = 0.;    ///< f0, in the unit of the values
  double gci =
    0.; ///< 1.25 |f1 − f0| of an order no higher than that of the method [unit of the values]
  std::string why; ///< where it does not exist
};

/// Extrapolates the last three values.
/// @param h (n) sizes, falling; n >= 3
/// @param values (n)
/// @param floor differences up to this are what round-off and solvers leave
/// @param highest_order of the method: the grid convergence index is made with no higher one,
///   because an order seen above it is chance and would make the error bar too short
Richardson extrapolated(const std::vector<double> &h, const std::vector<double> &values,
                        double floor         = 0.,
                        double highest_order = std::numeric_limits<double>::infinity());

/// Judges values whose limit is not known, by the orders of each three that follow one another;
/// from the first two on that differ by no more than the floor the levels are left out.
/// FAIL and INCONCLUSIVE as in judge_errors().
OrderJudgement judge_values(const std::vector<double> &h, const std::vector<double> &values,
                            const OrderLimit &limit, double floor = 0.);
} // namespace homespun::verification
