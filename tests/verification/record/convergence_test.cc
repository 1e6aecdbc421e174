// SPDX-License-Identifier: MIT
#include "verification/record/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace homespun::verification;

namespace
{
/// Sizes without a common ratio, as meshes of users have.
std::vector<double> sizes(const int n = 5)
{
  std::vector<double> h;
  for (int k = 0; k < n; ++k)
    h.push_back(0.3 * std::pow(k % 2 == 0 ? 0.5 : 0.55, k));
  return h;
}

template <typename Function>
std::vector<double> at(const std::vector<double> &h, const Function &function)
{
  std::vector<double> values;
  for (std::size_t k = 0; k < h.size(); ++k)
    values.push_back(function(h[k], k));
  return values;
}
} // namespace

TEST(exact_convergence, a_pure_power_gives_its_order_on_unequal_levels)
{
  for (const double p : {0.5, 1., 1.35, 2., 3., 4.})
  {
    const std::vector<double> h = sizes();
    const OrderJudgement found =
      judge_errors(h, at(h, [&](double s, auto) { return 7. * std::pow(s, p); }), about(p));
    EXPECT_EQ(found.outcome, Outcome::pass) << p << " " << found.why;
    EXPECT_NEAR(found.order, p, 1e-12);
    EXPECT_LT(found.spread, 1e-12);
    ASSERT_EQ(found.observed.size(), h.size());
    EXPECT_TRUE(std::isnan(found.observed[0]));
    for (std::size_t k = 1; k < h.size(); ++k)
      EXPECT_NEAR(found.observed[k], p, 1e-12);
  }
}

TEST(exact_convergence, richardson_finds_order_limit_and_error_bar_of_a_pure_power)
{
  for (const double p : {0.7, 1.35, 2., 4.})
  {
    const std::vector<double> h      = sizes();
    const std::vector<double> values = at(h, [&](double s, auto) { return 3. + std::pow(s, p); });
    const Richardson found           = extrapolated(h, values);
    ASSERT_TRUE(found.exists) << found.why;
    EXPECT_NEAR(found.order, p, 1e-8);
    EXPECT_NEAR(found.limit, 3., 1e-12);
    EXPECT_NEAR(found.gci, 1.25 * std::pow(h.back(), p), 1e-8 * found.gci);
    const OrderJudgement judged = judge_values(h, values, about(p));
    EXPECT_EQ(judged.outcome, Outcome::pass) << judged.why;
    EXPECT_NEAR(judged.order, p, 1e-8);
  }
}

TEST(bound_convergence, the_error_bar_covers_the_error_with_a_term_of_higher_order)
{
  for (const double a : {-0.5, 0.5})
  {
    const std::vector<double> h = sizes();
    const std::vector<double> values =
      at(h, [&](double s, auto) { return 3. + s * s + a * s * s * s; });
    const Richardson found = extrapolated(h, values);
    ASSERT_TRUE(found.exists);
    EXPECT_LE(std::abs(values.back() - 3.), found.gci);
    EXPECT_NEAR(found.order, 2., 0.1);
  }
}

TEST(exact_convergence,
     a_term_of_higher_order_fades_on_fine_levels_and_is_inconclusive_on_coarse_ones)
{
  const auto error               = [](double s, auto) { return s * s * (1. + 4. * s); };
  const std::vector<double> fine = {0.04, 0.02, 0.01, 0.005};
  EXPECT_EQ(judge_errors(fine, at(fine, error), about(2.)).outcome, Outcome::pass);
  const std::vector<double> coarse = {0.8, 0.4, 0.2, 0.1};
  const OrderJudgement found       = judge_errors(coarse, at(coarse, error), about(2.));
  EXPECT_EQ(found.outcome, Outcome::inconclusive);
  EXPECT_NE(found.why.find("asymptotic"), std::string::npos) << found.why;
}

TEST(exact_convergence, orders_that_slowly_drift_to_the_limit_are_not_called_a_failure)
{
  // The last step of 0.095 counts as settled, and still leads on to 1.91.
  const std::vector<double> h = {0.1, 0.05, 0.025, 0.0125};
  std::vector<double> errors  = {1.};
  for (const double order : {1.5, 1.65, 1.745})
    errors.push_back(errors.back() * std::pow(0.5, order));
  EXPECT_EQ(judge_errors(h, errors, about(2.)).outcome, Outcome::inconclusive);
}

TEST(tripwire_convergence, an_error_that_ends_on_a_plateau_fails_however_much_of_it_still_falls)
{
  // e = a + C h^p; the plateau a is 48 to 99 % of what is left on the finest level.
  for (const double p : {1., 2., 3., 4.})
    for (const double share : {0.48, 0.6, 0.75, 0.9, 0.99})
      for (const int n : {4, 5, 7})
      {
        const std::vector<double> h = sizes(n);
        const double C              = (1. - share) / share * std::pow(h.back(), -p);
        const auto errors          = at(h, [&](double s, auto) { return 1. + C * std::pow(s, p); });
        const OrderJudgement found = judge_errors(h, errors, about(p));
        EXPECT_EQ(found.outcome, Outcome::fail)
          << "order " << p << ", " << n << " levels, plateau " << share << ": " << found.why;
        // A bar well above the plateau takes those levels away that show it and no order.
        const OrderJudgement known = judge_errors(h, errors, about(p), 20.);
        EXPECT_NE(known.outcome, Outcome::fail) << known.why;
      }
}

TEST(tripwire_convergence, errors_that_stall_fail_where_several_powers_may_show_together)
{
  const std::vector<double> h = {0.1, 0.05, 0.025, 0.0125};
  const auto outcome          = [&](const double last)
  {
    std::vector<double> errors = {1.};
    for (const double order : {2., 1.9, last})
      errors.push_back(errors.back() * std::pow(0.5, order));
    const OrderJudgement found = judge_errors(h, errors, about(1.), 0., OrderLimit{1.1, 2.1});
    EXPECT_TRUE(found.order > 1.1 && found.order < 2.1);
    return found.outcome;
  };
  EXPECT_EQ(outcome(0.5), Outcome::fail);
  EXPECT_EQ(outcome(1.85), Outcome::inconclusive);
}

TEST(exact_convergence, every_order_is_in_its_band_or_fails)
{
  const std::vector<double> h = sizes();
  for (int tenths = 3; tenths <= 60; ++tenths)
    for (const OrderLimit band : {OrderLimit{0.9, 1.1}, OrderLimit{1.9, 2.1}, OrderLimit{0.9, 2.1}})
    {
      const double p          = 0.1 * tenths + 0.05; // never at the end of a band
      const Outcome expected  = band.contains(p) ? Outcome::pass : Outcome::fail;
      const auto power        = [&](double s, auto) { return 3. * std::pow(s, p); };
      const auto raised_power = [&](double s, auto) { return 1. + 3. * std::pow(s, p); };
      EXPECT_EQ(judge_errors(h, at(h, power), band).outcome, expected) << p;
      EXPECT_EQ(judge_values(h, at(h, raised_power), band, 1e-14).outcome, expected) << p;
      EXPECT_EQ(judge_uneven_errors(h, at(h, power), band).outcome, expected) << p;
    }
}

TEST(exact_convergence, orders_that_come_nearer_to_the_band_are_open_from_either_side)
{
  const std::vector<double> h = {0.1, 0.05, 0.025, 0.0125, 0.00625};
  const auto errors_of        = [&](const std::vector<double> &orders)
  {
    std::vector<double> errors = {1.};
    for (const double order : orders)
      errors.push_back(errors.back() * std::pow(0.5, order));
    return errors;
  };
  const auto outcome = [&](const std::vector<double> &orders)
  { return judge_errors(h, errors_of(orders), about(2.)).outcome; };
  EXPECT_EQ(outcome({0.5, 0.9, 1.3, 1.6}), Outcome::inconclusive); // rises fast
  EXPECT_EQ(outcome({1.5, 1.6, 1.69, 1.77}), Outcome::inconclusive);
  EXPECT_EQ(outcome({1.2, 1.25, 1.27, 1.28}), Outcome::fail);     // rises, to 1.3
  EXPECT_EQ(outcome({1.95, 1.95, 1.94, 1.8}), Outcome::fail);     // falls out of the band
  EXPECT_EQ(outcome({1.95, 1.95, 1.92, 1.88}), Outcome::fail);    // slowly
  EXPECT_EQ(outcome({1.95, 1.95, 1.94, 0.3}), Outcome::fail);     // at once
  EXPECT_EQ(outcome({3., 2.7, 2.5, 2.3}), Outcome::inconclusive); // falls towards the band
  EXPECT_EQ(outcome({2.5, 2.4, 2.31, 2.23}), Outcome::inconclusive);
  EXPECT_EQ(outcome({2.5, 2.46, 2.45, 2.45}), Outcome::fail);
  // Above and rising: terms cancel, which ends on finer levels.
  EXPECT_EQ(outcome({2., 2.1, 2.4, 3.}), Outcome::inconclusive);
}

TEST(exact_convergence, powers_that_part_slowly_are_open_and_a_rest_of_lower_order_fails)
{
  const std::vector<double> h = {1. / 4, 1. / 6, 1. / 8, 1. / 12};
  for (const double exponent : {0.9, 1., 1.06, 1.3})
  {
    const double s         = 2. * exponent - 2.;
    const auto errors_with = [&](const double rest)
    {
      std::vector<double> errors;
      for (const double one : h)
        errors.push_back(
          one * one *
          ((s == 0. ? -std::log(one) : -std::expm1(s * std::log(one)) / s) + rest / one));
      return errors;
    };
    const auto judged = [&](const double rest)
    {
      const double lowest = std::min(2., order_beside_a_corner(exponent, h.back())) - 0.1;
      return judge_errors(h, errors_with(rest), about(2.), 0., OrderLimit{lowest, 3.1});
    };
    // The order at a point is the slope of the errors there.
    const double step = 1e-4, at = h.back();
    const auto error = [&](const double one)
    { return one * one * (s == 0. ? -std::log(one) : -std::expm1(s * std::log(one)) / s); };
    EXPECT_NEAR(order_beside_a_corner(exponent, at),
                std::log(error(at * (1. + step)) / error(at * (1. - step))) /
                  std::log((1. + step) / (1. - step)),
                1e-6);
    EXPECT_NE(judged(0.).outcome, Outcome::fail) << exponent << ": " << judged(0.).why;
    EXPECT_EQ(judged(1.).outcome, Outcome::fail) << exponent << ": " << judged(1.).why;
  }
}

TEST(exact_convergence, orders_that_swing_are_open_where_they_swing_across_the_band)
{
  const std::vector<double> h = {0.1, 0.05, 0.025, 0.0125};
  const auto outcome          = [&](const double a, const double b, const double c)
  {
    const std::vector<double> errors = {1., std::pow(0.5, a), std::pow(0.5, a + b),
                                        std::pow(0.5, a + b + c)};
    return judge_errors(h, errors, about(2.)).outcome;
  };
  EXPECT_EQ(outcome(1., 3.5, 0.8), Outcome::inconclusive);
  EXPECT_EQ(outcome(0.2, 0.9, 0.1), Outcome::fail); // never near the band
  EXPECT_EQ(outcome(2.6, 2.3, 1.2), Outcome::fail); // no swing: it falls, through the band
}

TEST(exact_convergence, oscillating_levels_are_inconclusive)
{
  const std::vector<double> h = sizes();
  EXPECT_EQ(
    judge_errors(h, at(h, [](double s, std::size_t k) { return s * s * (k % 2 == 0 ? 1. : 0.4); }),
                 about(2.))
      .outcome,
    Outcome::inconclusive);
  const std::vector<double> values =
    at(h, [](double s, std::size_t k) { return 1. + (k % 2 == 0 ? 1. : -1.) * s * s; });
  const Richardson found = extrapolated(h, values);
  EXPECT_FALSE(found.exists);
  EXPECT_NE(found.why.find("oscillate"), std::string::npos);
  EXPECT_EQ(judge_values(h, values, about(2.)).outcome, Outcome::inconclusive);
}

TEST(exact_convergence, levels_at_the_floor_are_left_out)
{
  const std::vector<double> h = {0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125};
  const auto error            = [](double s, std::size_t k)
  { return std::max(s * s * s * s, (k % 2 == 0 ? 1.1 : 0.8) * 1e-7); };
  EXPECT_EQ(judge_errors(h, at(h, error), about(4.)).outcome, Outcome::inconclusive);
  const OrderJudgement known = judge_errors(h, at(h, error), about(4.), 2e-7);
  EXPECT_EQ(known.outcome, Outcome::inconclusive); // three levels are above it
  EXPECT_NE(known.why.find("3 levels above the floor"), std::string::npos) << known.why;
  const auto later = [&](double s, std::size_t k)
  { return std::max(s * s * s * s, (k % 2 == 0 ? 1.1 : 0.8) * 2e-9); };
  const OrderJudgement four = judge_errors(h, at(h, later), about(4.), 4e-9);
  EXPECT_EQ(four.outcome, Outcome::pass) << four.why;
  EXPECT_TRUE(std::isnan(four.observed.back()));
  // All at the floor: nothing is measured, least of all an order.
  EXPECT_EQ(judge_errors(h, std::vector<double>(6, 1e-15), about(4.), 1e-13).outcome,
            Outcome::inconclusive);
  EXPECT_FALSE(extrapolated(h, {1., 1., 1., 1., 1., 1. + 1e-15}, 1e-12).exists);
}

TEST(exact_convergence, two_or_three_levels_conclude_nothing)
{
  for (const int n : {0, 1, 2, 3})
  {
    const std::vector<double> h      = sizes(n);
    const std::vector<double> errors = at(h, [](double s, auto) { return s * s; });
    EXPECT_EQ(judge_errors(h, errors, about(2.)).outcome, Outcome::inconclusive) << n;
    EXPECT_EQ(judge_values(h, errors, about(2.)).outcome, Outcome::inconclusive) << n;
  }
  EXPECT_FALSE(extrapolated({0.2, 0.1}, {1., 2.}).exists);
}

TEST(exact_convergence, a_band_is_a_limit_on_both_sides)
{
  const std::vector<double> h = sizes();
  for (const auto &[p, outcome] : {std::pair(0.5, Outcome::fail), std::pair(1.4, Outcome::pass),
                                   std::pair(2.5, Outcome::fail)})
    EXPECT_EQ(
      judge_errors(h, at(h, [p = p](double s, auto) { return std::pow(s, p); }), {1., 2.}).outcome,
      outcome);
  EXPECT_EQ(text_of({1., 2.}), "1 to 2");
  EXPECT_EQ(text_of(about(2.)), "2 +- 0.1");
}

TEST(tripwire_convergence, an_l2_error_without_its_root_has_twice_the_order_and_fails)
{
  const std::vector<double> h = sizes();
  for (const double p : {1., 2., 3.})
    EXPECT_EQ(
      judge_errors(h, at(h, [&](double s, auto) { return std::pow(s, 2. * p); }), about(p)).outcome,
      Outcome::fail);
}

TEST(tripwire_convergence, an_order_that_is_one_too_low_fails)
{
  const std::vector<double> h = sizes();
  for (const double p : {2., 3.})
  {
    EXPECT_EQ(
      judge_errors(h, at(h, [&](double s, auto) { return std::pow(s, p - 1.); }), about(p)).outcome,
      Outcome::fail);
    EXPECT_EQ(
      judge_values(h, at(h, [&](double s, auto) { return 1. + std::pow(s, p - 1.); }), about(p))
        .outcome,
      Outcome::fail);
  }
}

TEST(tripwire_convergence, a_refinement_that_does_nothing_on_half_of_the_levels_fails)
{
  const std::vector<double> h      = {0.4, 0.2, 0.1, 0.05, 0.025, 0.0125};
  const std::vector<double> halved = {0.4, 0.4, 0.1, 0.1, 0.025, 0.025};
  const std::vector<double> errors = at(halved, [](double s, auto) { return s * s; });
  const OrderJudgement found       = judge_errors(h, errors, about(2.));
  EXPECT_EQ(found.outcome, Outcome::fail);
  EXPECT_NE(found.why.find("did nothing"), std::string::npos) << found.why;
  EXPECT_EQ(judge_values(h, errors, about(2.)).outcome, Outcome::fail);
  // Told with the sizes that the levels really had, the fault lies there.
  EXPECT_EQ(judge_errors(halved, errors, about(2.)).outcome, Outcome::fail);
}

TEST(tripwire_convergence, an_error_that_stagnates_or_grows_fails)
{
  const std::vector<double> h = sizes();
  EXPECT_EQ(
    judge_errors(h, at(h, [](double s, auto) { return 0.01 + 1e-4 * s; }), about(2.)).outcome,
    Outcome::fail);
  EXPECT_EQ(
    judge_errors(h, at(h, [](double s, auto) { return std::exp(1. / s); }), about(2.)).outcome,
    Outcome::fail);
  EXPECT_FALSE(extrapolated(h, at(h, [](double s, auto) { return 1. / s; })).exists);
  EXPECT_EQ(judge_values(h, at(h, [](double s, auto) { return 1. / s; }), about(2.)).outcome,
            Outcome::fail);
}

TEST(tripwire_convergence, an_error_that_is_not_a_number_never_passes)
{
  const std::vector<double> h = sizes();
  for (std::size_t bad = 0; bad < h.size(); ++bad)
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.})
    {
      std::vector<double> errors = at(h, [](double s, auto) { return s * s; });
      errors[bad]                = value;
      const OrderJudgement found = judge_errors(h, errors, about(2.));
      EXPECT_EQ(found.outcome, Outcome::fail) << bad << " " << value;
      EXPECT_FALSE(found.why.empty());
      if (!std::isfinite(value))
      {
        EXPECT_EQ(judge_values(h, errors, about(2.)).outcome, Outcome::fail);
      }
    }
}

TEST(exact_convergence, uneven_levels_are_judged_by_two_fits_that_must_agree)
{
  // Adaptive meshes: sizes that fall by factors of their own.
  const std::vector<double> h = {1., 0.8, 0.5, 0.42, 0.3, 0.17, 0.12};
  const auto judged           = [&](const double p)
  {
    return judge_uneven_errors(h, at(h, [&](double s, auto) { return std::pow(s, p); }),
                               about(2., 0.4));
  };
  EXPECT_EQ(judged(2.).outcome, Outcome::pass);
  EXPECT_NEAR(judged(2.).order, 2., 1e-12);
  EXPECT_EQ(judged(1.5).outcome, Outcome::fail);
  EXPECT_EQ(judged(2.5).outcome, Outcome::fail);
  // A plateau of half of what is left.
  const auto flat = at(h, [](double s, auto) { return 0.0144 + std::pow(s, 2.); });
  EXPECT_EQ(judge_uneven_errors(h, flat, about(2., 0.1)).outcome, Outcome::fail);
  // On the way to order 2, and not there yet.
  const auto late = at(h, [](double s, auto) { return std::pow(s, 4.) / std::pow(s + 0.3, 3.); });
  EXPECT_EQ(judge_uneven_errors(h, late, about(2., 0.4)).outcome, Outcome::inconclusive);
  EXPECT_EQ(judge_uneven_errors({1., 0.5, 0.2, 0.1}, {1., 0.25, 0.04, 0.01}, about(2.)).outcome,
            Outcome::inconclusive);
  std::vector<double> bad = at(h, [](double s, auto) { return s * s; });
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), 0., -1.})
  {
    bad[3] = value;
    EXPECT_EQ(judge_uneven_errors(h, bad, about(2., 0.4)).outcome, Outcome::fail);
  }
}

TEST(bound_convergence, an_order_above_that_of_the_method_does_not_shorten_the_error_bar)
{
  const std::vector<double> h      = sizes();
  const std::vector<double> values = at(h, [](double s, auto) { return 1. + std::pow(s, 5.); });
  const Richardson free = extrapolated(h, values), capped = extrapolated(h, values, 0., 2.);
  EXPECT_NEAR(free.order, 5., 1e-6);
  EXPECT_EQ(capped.limit, free.limit);
  const double fine  = values[values.size() - 2] - values.back();
  const double ratio = std::pow(h[h.size() - 2] / h.back(), 2.);
  EXPECT_NEAR(capped.gci, 1.25 * fine / (ratio - 1.), 1e-12 * capped.gci + 1e-16);
  EXPECT_GT(capped.gci, 5. * free.gci);
}
