// SPDX-License-Identifier: MIT
// What a strain study says of itself in words: what it left out and why, and how its numbers came to be.
#pragma once

#include <nlohmann/json.hpp>

namespace homespun::verification
{
/// [{what, why}]
nlohmann::ordered_json what_was_left_out();

/// Sentences that a reader of the numbers needs.
nlohmann::ordered_json notes_on_the_method();
} // namespace homespun::verification
