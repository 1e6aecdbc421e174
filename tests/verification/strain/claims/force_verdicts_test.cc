// SPDX-License-Identifier: MIT
// Claims on forces, on rows by hand: what theory says passes, and each planted fault fails.
#include "verification/strain/claims/force_verdicts.h"

#include "tests/homogenization/cell/cells.h"
#include "verification/reference/fine_reference.h"

#include <gtest/gtest.h>

#include <limits>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<ForceRow> pulls_of(const double resolved, const double affine)
{
  std::vector<ForceRow> rows;
  for (const auto &[method, force] : {std::pair("resolved", resolved), std::pair("affine", affine)})
  {
    rows.push_back({"cell", "strip-1", 0.01, "linear", method});
    rows.back().per_width = force;
  }
  return rows;
}

homogenization::UnitCell oblique()
{
  homogenization::UnitCell cell =
    tests::cell_of(tests::skewed_lattice(), 4, 4, tests::soft_and_hard(), tests::halves);
  cell.name = "cell";
  return cell;
}

/// What is said of forces 1000 s (1 + slope s + curvature s²) of the affine motion, times a factor;
/// those of the two cloths have no term beyond the first.
Outcome judged(const double slope, const double curvature, const double factor,
               const std::vector<LevelRow> &levels = {}, const double softest = 1.,
               const double reached = 0.1)
{
  StrainStudyOptions options;
  options.strains    = {0.001, 0.0015, 0.01, 0.1};
  options.loads      = {"strip-1"};
  options.references = {"linear", "biot"};
  std::vector<ForceRow> rows;
  for (const double s : options.strains)
    for (const std::string &reference : options.references)
      for (const std::string method : {"resolved", "coarse", "affine"})
      {
        const bool has_terms = reference == "biot" && method == "affine";
        if (reference == "biot" && s > reached)
          continue;
        rows.push_back({"cell", "strip-1", s, reference, method});
        rows.back().per_width =
          1000. * s * (has_terms ? factor * (1. + slope * s + curvature * s * s) : 1.);
      }
  const std::vector<Verdict> verdicts = verdicts_of_laws(
    rows, levels, options, oblique(), Eigen::Vector3d(1., 1., softest).asDiagonal());
  EXPECT_EQ(verdicts.size(), 1u); // none of linear theory itself
  return verdicts.at(0).outcome;
}
} // namespace

TEST(bound_force_verdicts, a_sheet_pulls_back_no_harder_than_the_affine_motion)
{
  const auto outcome = [](const double resolved, const double affine)
  { return verdicts_of_forces(pulls_of(resolved, affine)).at(0).outcome; };
  EXPECT_EQ(outcome(8., 10.), Outcome::pass);
  EXPECT_EQ(outcome(10., 10.), Outcome::pass);
  EXPECT_EQ(outcome(-8., 10.), Outcome::fail); // the clamps are exchanged
  EXPECT_EQ(outcome(10.1, 10.), Outcome::fail);
  EXPECT_TRUE(verdicts_of_forces(pulls_of(8., none)).empty());
}

TEST(bound_force_verdicts, laws_agree_at_rest)
{
  for (const double slope : {0., 2., -10.})
    for (const double curvature : {0., 30., -300.})
    {
      EXPECT_EQ(judged(slope, curvature, 1.), Outcome::pass) << slope << ' ' << curvature;
      EXPECT_EQ(judged(slope, curvature, 2.), Outcome::fail) << slope << ' ' << curvature;
      EXPECT_EQ(judged(slope, curvature, 0.9), Outcome::fail) << slope << ' ' << curvature;
    }
  EXPECT_EQ(judged(100., 0., 2.), Outcome::inconclusive); // these strains are not small
  EXPECT_EQ(judged(none, 0., 1.), Outcome::inconclusive);
  for (const double reached : {0.0005, 0.0012}) // none, one of the two strains
    EXPECT_EQ(judged(0., 0., 1., {}, 1., reached), Outcome::inconclusive) << reached;
  EXPECT_EQ(judged(0., 0., 2., {}, 1e-3), Outcome::inconclusive);
  LevelRow lost = {"cell", "strip-1", "biot", 0.01, "soft", 8, 1, -0.1};
  EXPECT_EQ(judged(0., 0., 2., {lost}), Outcome::inconclusive);
  LevelRow left;
  left.cell = "cell", left.load = "strip-1", left.reference = "biot", left.strain = 0.001;
  left.stability = name_of(Stability::left);
  EXPECT_EQ(judged(0., 0., 2., {left}), Outcome::inconclusive);
  EXPECT_FALSE(has_claim_on_laws({}, Law::biot));
}

TEST(exact_force_verdicts, nothing_turns_infinite_cloth)
{
  StrainStudyOptions options;
  options.loads = {"periodic-12", "uniaxial-1", "strip-1"};
  const auto of = [&](const char *reference, const Eigen::Matrix2d &P)
  {
    ForceRow row  = {"cell", "periodic-12", 0.1, reference, "coarse"};
    row.stress_11 = P(0, 0), row.stress_12 = P(0, 1);
    row.stress_21 = P(1, 0), row.stress_22 = P(1, 1);
    const std::vector<Verdict> claims = verdicts_of_moments({row}, options, oblique());
    EXPECT_EQ(claims.size(), 1u);
    return claims.at(0).outcome;
  };
  const Eigen::Matrix2d S{{3., 1.}, {1., -2.}}, F{{1., 0.1}, {0., 1.}}, P = F * S;
  EXPECT_EQ(of("green", P), Outcome::pass);
  EXPECT_EQ(of("green", P.transpose()), Outcome::fail);
  EXPECT_EQ(of("linear", S), Outcome::pass);
  EXPECT_EQ(of("linear", P), Outcome::fail);
}

TEST(exact_force_verdicts, the_clamp_moves_by_strain_times_the_distance)
{
  StrainStudyOptions options;
  options.loads   = {"periodic-11", "shear-frame"};
  options.n_cells = 5;
  ForceRow row    = {"cell", "shear-frame", 0.01, "biot", "resolved"};
  const auto of   = [&](const double travel)
  {
    row.travel = travel;
    return verdicts_of_travel({row}, options, oblique()).at(0).outcome;
  };
  const double apart = 5. * Eigen::Vector2d(0.004, 0.012).norm();
  EXPECT_EQ(of(0.01 * apart), Outcome::pass);
  EXPECT_EQ(of(0.005 * apart), Outcome::fail);
  EXPECT_EQ(of(none), Outcome::fail);
  EXPECT_EQ(verdicts_of_travel({}, options, oblique()).at(0).outcome, Outcome::inconclusive);
}
