// SPDX-License-Identifier: MIT
#include "verification/record/claim.h"

#include "verification/record/fields.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace homespun::verification
{
namespace
{
const nlohmann::ordered_json &all_claims()
{
  static const auto all = nlohmann::ordered_json::parse(claims_text);
  return all;
}

const nlohmann::ordered_json &claim_of(const std::string &id)
{
  for (const auto &[study, claims] : all_claims().items())
    if (study != "shared" && claims.contains(id))
      return claims[id];
  throw std::logic_error("claims.json has no claim `" + id + "`");
}

/// Puts words in the place of names in braces, also in those of words that are shared.
class Sentence
{
public:
  Sentence(std::string id, const Words &words)
      : id(std::move(id))
      , words(words)
  {
  }

  std::string filled(const std::string &text)
  {
    std::string result;
    std::size_t k = 0;
    for (std::size_t open; (open = text.find('{', k)) != std::string::npos;)
    {
      const std::size_t close = text.find('}', open);
      result += text.substr(k, open - k) + word(text.substr(open + 1, close - open - 1));
      k = close + 1;
    }
    return result + text.substr(k);
  }

  void check() const
  {
    for (const auto &one : words)
      if (used.count(one.first) == 0)
        throw std::logic_error("claim `" + id + "`: no {" + one.first + "} in its texts");
  }

private:
  std::string word(const std::string &name)
  {
    used.insert(name);
    if (const auto found = words.find(name); found != words.end())
      return found->second;
    const nlohmann::ordered_json &shared = all_claims().at("shared");
    if (!shared.contains(name))
      throw std::logic_error("claim `" + id + "`: nothing stands for {" + name + "}");
    return filled(shared[name]);
  }

  const std::string id;
  const Words &words;
  std::set<std::string> used;
};
} // namespace

Verdict open_without(const int n_asked, Verdict verdict)
{
  if (n_asked == 0)
    verdict.outcome = Outcome::inconclusive;
  return verdict;
}

std::vector<Verdict> missing_claims(const std::vector<OwedClaim> &owed,
                                    const std::vector<Verdict> &verdicts)
{
  std::vector<Verdict> missing;
  for (const OwedClaim &one : owed)
  {
    const auto is_about_it = [&](const Verdict &verdict, const bool has_all_words)
    {
      return std::all_of(one.of.begin(), one.of.end(),
                         [&](const auto &word)
                         {
                           const auto found = verdict.of.find(word.first);
                           return found == verdict.of.end() ? !has_all_words
                                                            : found->second == word.second;
                         });
    };
    const bool is_judged = std::any_of(
      verdicts.begin(), verdicts.end(),
      [&](const Verdict &verdict)
      {
        const bool answers = verdict.id == one.id || verdict.id.rfind(one.id + ".", 0) == 0,
                   excuses = verdict.outcome != Outcome::pass &&
                             std::count(one.unless.begin(), one.unless.end(), verdict.id) > 0;
        return (answers || excuses) && is_about_it(verdict, answers);
      });
    if (is_judged)
      continue;
    std::string subject;
    for (const auto &[name, word] : one.of)
      subject += (subject.empty() ? "" : ", ") + word;
    missing.push_back(judged(
      "owed", {{"owed", one.id}, {"subject", subject.empty() ? Word("this cell") : Word(subject)}},
      Outcome::fail, 1.));
  }
  return missing;
}

const char *const claims_text =
#include "verification/claims_text.h" // by the build
  ;

Verdict judged(const std::string &id, const Words &words, const Outcome outcome, const double value)
{
  const nlohmann::ordered_json &claim = claim_of(id);
  Sentence sentence(id, words);
  Verdict verdict;
  verdict.id         = id;
  verdict.claim      = sentence.filled(claim.at("claim"));
  verdict.outcome    = outcome;
  verdict.value      = value;
  verdict.limit      = sentence.filled(claim.value("limit", "<= {limit}"));
  verdict.derivation = sentence.filled(claim.at("derivation"));
  if (!read_field(claim.at("kind").get<std::string>(), verdict.kind))
    throw std::logic_error("claim `" + id + "` has an unknown kind");
  sentence.check();
  verdict.of.insert(words.begin(), words.end());
  return verdict;
}

Verdict at_most(const std::string &id, Words words, const double value, const double limit)
{
  if (const auto &claim = claim_of(id);
      claim.value("limit", "{limit}").find("{limit}") != std::string::npos)
    words.emplace("limit", limit);
  return judged(id, words, value <= limit ? Outcome::pass : Outcome::fail, value);
}
} // namespace homespun::verification
