// SPDX-License-Identifier: MIT
// What a scene run claims: that each of its cloths comes to the end of the scene.
#pragma once

#include "verification/record/verdict.h"

#include <string>

namespace homespun::verification
{
/// @param n_found frames, with that of the beginning
/// @param if_not outcome where the cloth did not come to the end
inline Verdict reaches_the_end(const std::string &claim, const int n_found, const int n_wanted,
                               const Outcome if_not, const Kind kind)
{
  return {claim + " (frames reached)",
          n_found == n_wanted ? Outcome::pass : if_not,
          static_cast<double>(n_found),
          std::to_string(n_wanted),
          "requirement: the frames of the duration that was asked for",
          kind};
}

/// The claim of a coarse cloth. That of a variant that is not the method is open where it stops: it
/// is there to be compared, and what it would have been is not known.
inline Verdict verdict_of_cloth(const std::string &title, const bool is_method, const int n_found,
                                const int n_wanted)
{
  return reaches_the_end(title + ": the scene runs to its end", n_found, n_wanted,
                         is_method ? Outcome::fail : Outcome::inconclusive,
                         is_method ? Kind::program : Kind::method);
}

/// The claim of a reference. One without a single frame after the beginning says nothing at all; of
/// one that stops later it is open how far the method is from it then.
inline Verdict verdict_of_reference(const std::string &title, const int n_found, const int n_wanted)
{
  return reaches_the_end(title + ": the reference runs to its end", n_found, n_wanted,
                         n_found <= 1 ? Outcome::fail : Outcome::inconclusive, Kind::program);
}
} // namespace homespun::verification
