// SPDX-License-Identifier: MIT
// Gains of the coarse cloth and of up-sampling, apart: placebos, cells on which up-sampling has
// nothing to gain, against the resolved sheet; then the base and the claims on synthetic rows.
#include "homogenization/edges/edge_layers.h"
#include "meshes/files/temporary_folder.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/strain/claims/strain_verdicts.h"
#include "verification/strain/gains.h"
#include "verification/strain/strain_comparison.h"
#include "verification/strain/validity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

using namespace homespun;
using namespace homespun::verification;

namespace
{
using Rows                     = std::vector<StrainRow>;
constexpr double of_comparison = 0.01, bar_of_placebo = 1e-9;

/// Rows of the default methods on sheets of a cell of two stripes, against their resolved sheets
/// under `biot` at 1 %.
Rows rows_of(const double contrast, const int n_cells)
{
  const meshes::TemporaryFolder folder(testing::TempDir());
  homogenization::UnitCell cell =
    tests::cell_of(tests::square_lattice(0.01), 4, 4,
                   {homogenization::isotropic("one", 1e6, 0.3, 5e-4, 1.),
                    homogenization::isotropic("other", contrast * 1e6, 0.3, 5e-4, 1.)},
                   tests::halves);
  std::filesystem::create_directory(folder.path + "/" + cell.name);
  StrainStudyOptions options = default_strain_study();
  options.references         = {"biot"};
  options.loads              = {"strip-1", "strip-2", "shear-frame"};
  options.strains            = {of_comparison};
  options.output             = folder.path;
  options.budget = options.run_time = false;
  StrainOutput output(options, [](const std::string &) {});
  homogenization::HomogenizationOptions of_cell;
  of_cell.order                             = 1;
  of_cell.tolerance                         = 1e-12;
  of_cell.second_order                      = {Law::biot};
  const meshes::HomogenizedCell homogenized = homogenization::homogenized_cell(
    cell, homogenization::homogenize(cell, of_cell, MPI_COMM_SELF), "test");
  const KnownEdges edges{homogenization::edges_of(cell, {}), ""};
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells);
  FineReference reference(sheet, cell.stiffness_of_phase(), {}, MPI_COMM_SELF);
  for (const std::string &name : options.loads)
  {
    const Load load(name);
    reference.start(load, Law::biot);
    const ReferenceStep fine = reference.advance(of_comparison);
    MethodsOnSheet methods   = methods_on_sheet(cell, homogenized, edges, sheet, load);
    std::map<std::string, ErrorBar> bars;
    for (const std::string &method : options.methods)
      bars[method] = {bar_of_placebo, 1.25};
    compare_methods(options, {cell.name, name, Law::biot, of_comparison},
                    {sheet,
                     fine,
                     reference.n_dofs(),
                     1,
                     {bar_of_placebo, bar_of_placebo, bar_of_placebo, bar_of_placebo},
                     Stability::every_triangle,
                     0.,
                     bars},
                    methods, output);
  }
  return output.strain.rows();
}

std::vector<GainRow> gains_of_full(const Rows &rows)
{
  std::vector<GainRow> gains;
  for (const GainRow &gain : gain_rows(rows))
    if (gain.method == "full")
      gains.push_back(gain);
  return gains;
}

Verdict claim_with(const std::vector<Verdict> &verdicts, const std::string &words)
{
  for (const Verdict &verdict : verdicts)
    if (verdict.claim.find(words) != std::string::npos)
      return verdict;
  ADD_FAILURE() << "no claim has the words " << words;
  return {};
}
} // namespace

TEST(exact_placebo, on_one_material_up_sampling_gains_nothing_and_no_claim_says_so)
{
  for (const int n_cells : {4, 10, 20})
  {
    const Rows rows                  = rows_of(1., n_cells);
    const std::vector<GainRow> gains = gains_of_full(rows);
    ASSERT_EQ(gains.size(), 3u);
    for (const GainRow &gain : gains)
    {
      EXPECT_NEAR(gain.of_upsampling, 1., 1e-6) << gain.load << n_cells;
      EXPECT_GT(gain.of_coarse_cloth, 1.5) << gain.load << n_cells; // that of six-node triangles
      EXPECT_NEAR(gain.total, gain.of_coarse_cloth, 1e-5) << gain.load << n_cells;
    }
    const std::vector<Verdict> verdicts = strain_verdicts(rows, {of_comparison});
    for (const std::string load : {"strip-1", "strip-2", "shear-frame"})
      for (const char *pair :
           {": full is closer to biot than its base", ": localized is closer to biot than affine"})
        EXPECT_EQ(claim_with(verdicts, load + pair).outcome, Outcome::inconclusive) << load << pair;
  }
}

TEST(exact_placebo, on_nearly_one_material_it_gains_nearly_nothing)
{
  for (const int n_cells : {4, 10, 20})
    for (const GainRow &gain : gains_of_full(rows_of(1.001, n_cells)))
      EXPECT_NEAR(gain.of_upsampling, 1., 1e-2) << gain.load << n_cells;
}

TEST(tripwire_placebo, on_stripes_up_sampling_gains_what_the_coarse_cloth_does_not)
{
  for (const GainRow &gain : gains_of_full(rows_of(10., 4)))
  {
    EXPECT_GT(gain.of_upsampling, 1.1) << gain.load; // ten times what a placebo may show
    EXPECT_NEAR(gain.total, gain.of_upsampling * gain.of_coarse_cloth, 1e-9 * gain.total);
  }
}

namespace
{
StrainRow row_of_strip(const double strain, const std::string &method, const double error)
{
  StrainRow one  = {"cell", "strip-1", strain, "biot", method, 20, 800, 288000};
  one.mean       = error;
  one.per_cell   = error / 0.01;
  one.bar        = 1e-7;
  one.bar_safety = 1.25;
  return one;
}

Rows level_with(const double strain, const double full, const double full_micro = 4e-5,
                const double affine_p2 = 3e-5, const double localized = 2e-5)
{
  return {
    row_of_strip(strain, "affine", 6e-5),         row_of_strip(strain, "affine+p2", affine_p2),
    row_of_strip(strain, "localized", localized), row_of_strip(strain, "full-micro", full_micro),
    row_of_strip(strain, "localized+p2", 0.9e-5), row_of_strip(strain, "full", full)};
}

Rows operator+(Rows one, const Rows &other)
{
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

LevelRow lost_at(const double strain)
{
  LevelRow lost;
  lost.cell      = "cell";
  lost.load      = "strip-1";
  lost.reference = "biot";
  lost.part      = "yarn";
  lost.strain    = 2. * strain;
  lost.triangles = 10;
  lost.lost      = 1;
  lost.least     = -1.; // from 1 at rest
  return lost;
}

const std::string over_base  = "full is closer to biot than its base",
                  over_mesh  = "localized is closer to biot than affine",
                  over_paper = "full is closer to biot than localized";
} // namespace

TEST(exact_gains, the_base_is_the_better_of_the_two_row_by_row)
{
  const Rows rows  = level_with(0.01, 1e-5) + level_with(0.1, 1e-5, 2e-5);
  const auto gains = gains_of_full(rows);
  ASSERT_EQ(gains.size(), 2u);
  EXPECT_EQ(gains[0].base, "affine+p2");
  EXPECT_NEAR(gains[0].of_coarse_cloth, 2., 1e-12);
  EXPECT_NEAR(gains[0].of_upsampling, 3., 1e-12);
  EXPECT_EQ(gains[1].base, "full-micro");
  EXPECT_NEAR(gains[1].of_coarse_cloth, 3., 1e-12);
  EXPECT_NEAR(gains[1].of_upsampling, 2., 1e-12);
  for (const GainRow &gain : gain_rows(rows))
    EXPECT_EQ(gain.base, gain.method == "localized"      ? "affine"
                         : gain.method == "localized+p2" ? "affine+p2"
                                                         : gain.base);
  // One of them alone, or none.
  Rows less = level_with(0.01, 1e-5, 4e-5, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(gains_of_full(less).at(0).base, "full-micro");
  less = {less[0], less[2], less[5]};
  EXPECT_TRUE(gains_of_full(less).empty());
}

TEST(exact_gains, the_range_of_validity_of_the_base_stands_beside_that_of_its_method)
{
  for (const ValidityRow &valid : validity_rows(level_with(0.01, 1e-5)))
    EXPECT_TRUE(valid.method == "localized" || valid.method == "full" || valid.method == "base");
  const Rows rows = level_with(0.01, 1e-5) + level_with(0.1, 1e-5, 2e-4, 2e-4);
  for (const ValidityRow &valid : validity_rows(rows))
    if (valid.measure == "cell side" && valid.limit == 0.01 && valid.method != "localized")
    {
      EXPECT_EQ(valid.relation, valid.method == "base" ? "=" : ">");
    }
}

TEST(tripwire_gains, a_gain_of_the_coarse_cloth_is_none_of_up_sampling)
{
  EXPECT_EQ(claim_with(strain_verdicts(level_with(0.01, 1e-5), {0.01}), over_base).outcome,
            Outcome::pass);
  EXPECT_NEAR(claim_with(strain_verdicts(level_with(0.01, 1e-5), {0.01}), over_base).value, 1. / 3.,
              1e-12);
  EXPECT_NE(
    claim_with(strain_verdicts(level_with(0.01, 1e-5), {0.01}), over_base).limit.find("affine+p2"),
    std::string::npos);
  // Far closer than `affine`, and no closer than affine+p2.
  EXPECT_EQ(claim_with(strain_verdicts(level_with(0.01, 3e-5), {0.01}), over_base).outcome,
            Outcome::inconclusive);
  EXPECT_EQ(claim_with(strain_verdicts(level_with(0.01, 3.5e-5), {0.01}), over_base).outcome,
            Outcome::fail);
}

TEST(tripwire_gains, each_pair_fails_where_the_first_is_farther)
{
  const Rows worse             = level_with(0.01, 2.5e-5),
             worse_than_affine = level_with(0.01, 1e-5, 4e-5, 3e-5, 7e-5);
  EXPECT_EQ(claim_with(strain_verdicts(worse, {0.01}), over_paper).outcome, Outcome::fail);
  EXPECT_EQ(claim_with(strain_verdicts(worse, {0.01}), over_base).outcome, Outcome::pass);
  EXPECT_EQ(claim_with(strain_verdicts(worse_than_affine, {0.01}), over_mesh).outcome,
            Outcome::fail);
  EXPECT_EQ(status_of(strain_verdicts(worse_than_affine, {0.01})), exit_status::claim_failed);
  const Rows unknown = level_with(0.01, std::numeric_limits<double>::quiet_NaN());
  for (const std::string &pair : {over_base, over_paper})
    EXPECT_EQ(claim_with(strain_verdicts(unknown, {0.01}), pair).outcome, Outcome::inconclusive);
}

TEST(tripwire_gains, methods_are_judged_near_one_per_cent_and_at_the_largest_level_up_to_ten)
{
  const std::vector<double> asked = {0.001, 0.008, 0.011, 0.05, 0.1, 0.2};
  Rows rows;
  for (const double strain : asked)
    rows = rows + level_with(strain, strain == 0.1 ? 3.5e-5 : 1e-5);
  const std::vector<Verdict> verdicts = strain_verdicts(rows, asked);
  EXPECT_EQ(claim_with(verdicts, over_base + " at strain 0.011").outcome, Outcome::pass);
  EXPECT_EQ(claim_with(verdicts, over_base + " at strain 0.1").outcome, Outcome::fail);
  int n_closer = 0;
  for (const Verdict &verdict : verdicts)
    n_closer += verdict.claim.find("closer") != std::string::npos;
  EXPECT_EQ(n_closer, 6);
  // A level at 10 % alone has claims.
  for (const std::string &pair : {over_base, over_mesh, over_paper})
    EXPECT_EQ(claim_with(strain_verdicts(level_with(0.1, 1e-5), {0.1}), pair).outcome,
              Outcome::pass);
}

TEST(tripwire_gains, a_level_without_an_equilibrium_or_beyond_its_law_is_open)
{
  const Rows rows = level_with(0.01, 1e-5) + Rows{row_of_strip(0.1, unreached, 0.)};
  for (const std::string &pair : {over_base, over_mesh, over_paper})
  {
    const Verdict open = claim_with(strain_verdicts(rows, {0.01, 0.1}), pair + " at strain 0.1");
    EXPECT_EQ(open.outcome, Outcome::inconclusive);
    EXPECT_EQ(open.value, 0.01); // the last level that was reached
    EXPECT_NE(open.limit.find("not reached"), std::string::npos);
    for (const Rows &level_there : {rows, level_with(0.01, 1e-5) + level_with(0.1, 1e-5)})
    {
      const Verdict lost = claim_with(strain_verdicts(level_there, {0.01, 0.1}, {lost_at(0.04)}),
                                      pair + " at strain 0.1");
      EXPECT_EQ(lost.outcome, Outcome::inconclusive);
      EXPECT_NEAR(lost.value, 0.04, 1e-12);
    }
    EXPECT_EQ(claim_with(strain_verdicts(rows, {0.01, 0.1}), pair + " at strain 0.01").outcome,
              Outcome::pass);
  }
  // No level at all: the methods that were asked for.
  const Rows none = {row_of_strip(0.1, unreached, 0.)};
  for (const std::string &pair : {over_base, over_mesh, over_paper})
    EXPECT_EQ(claim_with(strain_verdicts(none, {0.1}, {}, Method::defaults()), pair).outcome,
              Outcome::inconclusive);
}

TEST(tripwire_gains, without_a_base_among_the_methods_the_claim_is_open)
{
  const Rows all     = level_with(0.01, 1e-5);
  const Verdict open = claim_with(strain_verdicts({all[0], all[2], all[5]}, {0.01}), over_base);
  EXPECT_EQ(open.outcome, Outcome::inconclusive);
  EXPECT_NE(open.limit.find("full-micro and affine+p2"), std::string::npos) << open.limit;
}

// What the solvers leave decides nothing, however small the bar.
TEST(tripwire_gains, errors_that_are_zero_to_round_off_are_no_gain)
{
  Rows rows = level_with(0.01, 1e-14, 2e-14, 2e-14, 2e-14);
  for (StrainRow &one : rows)
    one.bar = 0.;
  EXPECT_EQ(claim_with(strain_verdicts(rows, {0.01}), over_base).outcome, Outcome::inconclusive);
  EXPECT_TRUE(std::isnan(gains_of_full(rows).at(0).of_upsampling));
}

// 3e-5 and 1e-5: apart by more than either bar, and by less than both.
TEST(tripwire_gains, the_bars_of_both_errors_count)
{
  const auto with_bars = [](const double of_base, const double of_full, const double safety)
  {
    Rows rows                = level_with(0.01, 1e-5);
    rows[1].bar              = of_base; // affine+p2, the base
    rows.back().bar          = of_full;
    rows.back().bar_safety   = safety;
    rows.front().uncertainty = rows.back().uncertainty = 1.; // the reference's own decides nothing
    return claim_with(strain_verdicts(rows, {0.01}), over_base);
  };
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(with_bars(0.9e-5, 0.9e-5, 1.25).outcome, Outcome::pass);
  EXPECT_EQ(with_bars(1.1e-5, 1.1e-5, 1.25).outcome, Outcome::inconclusive);
  EXPECT_EQ(with_bars(0.9e-5, 0.9e-5, 3.).outcome, Outcome::inconclusive);
  EXPECT_NE(with_bars(0.9e-5, 0.9e-5, 3.).limit.find("come together"), std::string::npos);
  EXPECT_EQ(with_bars(unknown, 0.9e-5, 1.25).outcome, Outcome::inconclusive);
  EXPECT_EQ(with_bars(0.9e-5, unknown, unknown).outcome, Outcome::inconclusive);
}
