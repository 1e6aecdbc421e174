// SPDX-License-Identifier: MIT
// What a strain study says of itself: how it was made, what it left out and why, how its numbers came to be.
#pragma once

#include "verification/strain_study.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace homespun::verification
{
struct StudyCost
{
  double seconds          = 0.;
  double peak_memory      = 0.; ///< of all ranks together [B]
  double largest_residual = 0.; ///< of the references, relative
  unsigned int ranks      = 1;
};

/// study.json.
/// @param notes on levels, beside those on the method
nlohmann::ordered_json describe(const StrainStudyOptions &options,
                                const std::vector<std::string> &notes, const StudyCost &cost);
} // namespace homespun::verification
