// SPDX-License-Identifier: MIT
// Claims as data: every one of claims.json can be judged, and what is owed and not there fails.
#include "verification/record/claim.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

using namespace homespun::verification;

namespace
{
/// A word for each name in braces that is not shared.
Words words_in(const std::string &text, const nlohmann::json &shared)
{
  Words words;
  for (std::size_t k = text.find('{'); k != std::string::npos; k = text.find('{', k + 1))
  {
    const std::string name = text.substr(k + 1, text.find('}', k) - k - 1);
    if (shared.contains(name))
      words.merge(words_in(shared[name], shared));
    else
      words[name] = "<" + name + ">";
  }
  return words;
}
} // namespace

TEST(exact_claim, every_claim_of_the_file_is_judged_with_all_its_words)
{
  const nlohmann::json all = nlohmann::json::parse(claims_text);
  std::set<std::string> ids;
  for (const auto &[study, claims] : all.items())
    if (study != "shared")
      for (const auto &[id, claim] : claims.items())
      {
        EXPECT_TRUE(ids.insert(id).second) << id;
        std::string text;
        for (const char *key : {"claim", "limit", "derivation"})
          text += claim.value(key, key == std::string("limit") ? "{limit}" : "");
        const Verdict verdict = judged(id, words_in(text, all["shared"]), Outcome::fail, 2.);
        EXPECT_EQ(verdict.id, id);
        EXPECT_EQ(verdict.value, 2.);
        EXPECT_EQ(name_of(verdict.kind), claim["kind"]) << id;
        for (const std::string &one : {verdict.claim, verdict.limit, verdict.derivation})
        {
          EXPECT_FALSE(one.empty()) << id;
          EXPECT_EQ(one.find('{'), std::string::npos) << one;
        }
      }
}

TEST(exact_claim, words_stand_where_their_names_are)
{
  const Verdict one = at_most("sheet-at-rest", {{"cell", "a"}}, 2e-12, 1e-12);
  EXPECT_EQ(one.claim, "a: the homogenized sheet at rest puts each vertex of a cell where it is "
                       "(largest distance over the side of the cell)");
  EXPECT_EQ(one.limit, "<= 1e-12");
  EXPECT_EQ(one.outcome, Outcome::fail);
  EXPECT_EQ(one.of.at("cell"), "a");
  const Verdict count = at_most("norms", {{"rows", 3}}, 0., 0.);
  EXPECT_EQ(count.claim,
            "strain.csv: mean <= root mean square <= largest error in each of 3 rows (rows where "
            "not)");
  EXPECT_EQ(count.limit, "0");
  EXPECT_EQ(count.outcome, Outcome::pass);
}

TEST(tripwire_claim, an_id_or_a_word_that_is_not_known_is_a_fault_of_the_program)
{
  EXPECT_THROW(judged("no-such-claim", {}, Outcome::pass, 0.), std::logic_error);
  EXPECT_THROW(at_most("norms", {}, 0., 0.), std::logic_error);
  EXPECT_THROW(at_most("norms", {{"rows", 3}, {"row", 3}}, 0., 0.), std::logic_error);
}

TEST(tripwire_claim, what_is_owed_and_was_not_judged_fails)
{
  const Words a = {{"cell", "a"}}, b = {{"cell", "b"}};
  const std::vector<OwedClaim> owed = {{"sheet-at-rest", a}, {"sheet-at-rest", b}};
  std::vector<Verdict> verdicts     = {at_most("sheet-at-rest", a, 0., 1.),
                                       at_most("sheet-at-rest", b, 0., 1.)};
  EXPECT_TRUE(missing_claims(owed, verdicts).empty());
  verdicts.pop_back();
  const std::vector<Verdict> missing = missing_claims(owed, verdicts);
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(status_of(missing), exit_status::claim_failed);
  EXPECT_EQ(missing[0].kind, Kind::program);
  EXPECT_EQ(missing[0].claim,
            "the study owes the claim `sheet-at-rest` of b, and did not judge it");
}

TEST(tripwire_claim, one_answer_of_several_is_enough_and_another_claim_may_say_why_there_is_none)
{
  const Words level                 = {{"cell", "a"}, {"load", "strip-1"}};
  const std::vector<OwedClaim> owed = {{"strain-squared", level, {"equilibria"}}};
  Words words                       = level;
  words.insert({{"reference", "biot"}, {"note", ""}});
  const auto n_missing = [&](const Verdict &verdict)
  { return missing_claims(owed, {verdict}).size(); };
  EXPECT_EQ(n_missing(judged("strain-squared.slope", words, Outcome::pass, 2.)), 0u);
  words["levels"] = 3;
  EXPECT_EQ(n_missing(judged("equilibria", words, Outcome::pass, 0.)), 1u);
  EXPECT_EQ(n_missing(judged("equilibria", words, Outcome::inconclusive, 1.)), 0u);
  words["load"] = "strip-2";
  EXPECT_EQ(n_missing(judged("equilibria", words, Outcome::inconclusive, 1.)), 1u);
  // That a cell has no bracket does not say of which stiffness.
  const std::vector<OwedClaim> scaling = {
    {"scaling", {{"stiffness", "D^H"}}, {"bracket.exists", "bending-bracket.exists"}}};
  for (const char *id : {"bracket.exists", "bending-bracket.exists"})
    EXPECT_TRUE(
      missing_claims(scaling, {judged(id, {{"why", ""}}, Outcome::inconclusive, 0.)}).empty());
}
