// SPDX-License-Identifier: MIT
// Claims as data: kind, sentence, limit and derivation of each stand in claims.json, by its id.
// What judges it gives the numbers and what it is about.
#pragma once

#include "verification/record/number_text.h"
#include "verification/record/verdict.h"

#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace homespun::verification
{
/// What stands in a sentence in the place of a name in braces: text, or a number in six digits.
struct Word : std::string
{
  Word() = default;
  Word(const char *text)
      : std::string(text)
  {
  }
  Word(std::string text)
      : std::string(std::move(text))
  {
  }
  template <typename Number, typename = std::enable_if_t<std::is_arithmetic_v<Number>>>
  Word(const Number number)
      : std::string(text_of(number))
  {
  }

private:
  template <typename Number>
  static std::string text_of(const Number number)
  {
    if constexpr (std::is_integral_v<Number>)
      return std::to_string(number);
    else
      return short_text(number);
  }
};

using Words = std::map<std::string, Word>;

/// A claim of claims.json, judged.
/// @param words for each name in braces of its texts; `shared` of claims.json has some for all
/// @throws std::logic_error of an id that is not there, of a name without a word and of a word
///   that is in no text
Verdict judged(const std::string &id, const Words &words, Outcome outcome, double value);

/// The claim that a value is not larger than a limit, which is the word `limit`. Where the claim
/// has no text of a limit, it is "<= {limit}".
Verdict at_most(const std::string &id, Words words, double value, double limit);

/// A verdict that is open where nothing was asked: that says nothing.
Verdict open_without(int n_asked, Verdict verdict);

/// A claim that the inputs of a study ask for, whatever its results are.
struct OwedClaim
{
  std::string id; ///< or what stands before a dot of it: one question with several answers
  Words of;       ///< what it is about: words that its verdict has, too
  /// Claims that say, where they do not hold, why there is none; about the same, as far as they
  /// have these words.
  std::vector<std::string> unless = {};
};

/// For each claim that is owed and has no verdict one that failed: what is not there hides what it
/// would have found.
std::vector<Verdict> missing_claims(const std::vector<OwedClaim> &owed,
                                    const std::vector<Verdict> &verdicts);

/// The text of claims.json.
extern const char *const claims_text;
} // namespace homespun::verification
