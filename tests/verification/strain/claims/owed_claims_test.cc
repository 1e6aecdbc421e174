// SPDX-License-Identifier: MIT
// What vanishes from a strain study is noticed: made-up rows of a whole study, and faults in them.
#include "verification/strain/claims/study_claims.h"

#include "tests/homogenization/cell/cells.h"
#include "verification/strain/claims/force_verdicts.h"
#include "verification/strain/claims/strain_verdicts.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace homespun::verification;

namespace
{
/// A study of one cell under two loads, and its tables.
struct MadeUpStudy
{
  MadeUpStudy()
  {
    options.strains    = {1e-3, 1e-2, 0.1};
    options.loads      = {"periodic-11", "strip-1"};
    options.references = {"biot"};
    options.methods    = {"affine", "localized"};
    options.budget     = false;
    using namespace homespun::tests;
    cell      = cell_of(square_lattice(0.01), 2, 2, soft_and_hard(), halves);
    cell.name = "cell";
    for (const std::string &load : options.loads)
      for (const double strain : options.strains)
      {
        for (const std::string &method : options.methods)
        {
          StrainRow row   = {"cell", load, strain, "biot", method, 20, 800, 288000};
          row.mean        = 1e-4 * (method == "affine" ? strain : strain * strain);
          row.per_cell    = row.mean / 0.01;
          row.uncertainty = 1e-12;
          rows.push_back(row);
        }
        LevelRow step;
        step.cell      = "cell";
        step.load      = load;
        step.strain    = strain;
        step.reference = "biot";
        step.stability = "every triangle";
        levels.push_back(step);
      }
  }

  /// The claims that are owed of strain.csv and levels.csv, and were not judged.
  std::vector<std::string> missing() const
  {
    std::vector<Verdict> verdicts = strain_verdicts(rows, options.strains, levels, options.methods);
    for (const Verdict &verdict : stability_verdicts(levels))
      verdicts.push_back(verdict);
    for (const auto &some :
         {verdicts_of_travel({}, options, cell), verdicts_of_moments({}, options, cell)})
      verdicts.insert(verdicts.end(), some.begin(), some.end());
    std::vector<OwedClaim> owed;
    for (const OwedClaim &one : owed_of_strain(options, {cell}))
      if (one.of.count("load") != 0)
        owed.push_back(one);
    std::vector<std::string> claims;
    for (const Verdict &one : missing_claims(owed, verdicts))
      claims.push_back(one.of.at("owed") + " of " + one.of.at("subject"));
    return claims;
  }

  StrainStudyOptions options;
  homespun::homogenization::UnitCell cell;
  std::vector<StrainRow> rows;
  std::vector<LevelRow> levels;
};
} // namespace

TEST(exact_owed, a_study_that_is_whole_owes_nothing)
{
  EXPECT_EQ(MadeUpStudy().missing(), std::vector<std::string>());
}

TEST(tripwire_owed, a_law_that_counts_as_lost_from_rest_on_takes_no_claim_away)
{
  MadeUpStudy study;
  LevelRow at_rest;
  at_rest.cell      = "cell";
  at_rest.load      = "periodic-11";
  at_rest.reference = "biot";
  at_rest.strain    = 0.;
  at_rest.part      = "yarn";
  at_rest.lost      = 1;
  at_rest.least     = 0.;
  study.levels.push_back(at_rest);
  EXPECT_EQ(study.missing(),
            (std::vector<std::string>{"minimum of cell, periodic-11, biot",
                                      "strain-squared of cell, periodic-11, biot"}));
  // Lost at a strain, it leaves the claims open that have no levels before.
  study.levels.back().strain = 5e-3;
  study.levels.back().least  = -1.;
  EXPECT_EQ(study.missing(), std::vector<std::string>());
}

TEST(tripwire_owed, a_load_that_is_skipped_is_missed)
{
  MadeUpStudy study;
  const auto is_of_sheet = [](const auto &row) { return row.load == "strip-1"; };
  study.rows.erase(std::remove_if(study.rows.begin(), study.rows.end(), is_of_sheet),
                   study.rows.end());
  study.levels.erase(std::remove_if(study.levels.begin(), study.levels.end(), is_of_sheet),
                     study.levels.end());
  EXPECT_EQ(study.missing().size(), 4u);
}

TEST(tripwire_owed, a_table_that_is_not_written_is_missed)
{
  MadeUpStudy study;
  study.levels.clear();
  EXPECT_EQ(study.missing(), (std::vector<std::string>{"minimum of cell, periodic-11, biot",
                                                       "minimum of cell, strip-1, biot"}));
}

TEST(tripwire_owed, a_level_that_is_skipped_fails_the_claim_on_all_levels)
{
  MadeUpStudy study;
  study.rows.erase(std::remove_if(study.rows.begin(), study.rows.end(),
                                  [](const StrainRow &row)
                                  { return row.load == "strip-1" && row.strain == 1e-2; }),
                   study.rows.end());
  for (const Verdict &verdict : strain_verdicts(study.rows, study.options.strains))
    if (verdict.id == "equilibria")
    {
      EXPECT_EQ(verdict.outcome,
                verdict.of.at("load") == "strip-1" ? Outcome::fail : Outcome::pass);
    }
}
