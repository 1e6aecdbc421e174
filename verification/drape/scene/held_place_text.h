// SPDX-License-Identifier: MIT
// How a scene file writes places that are held and how they move: `top left`, `waist`, `vertices 0
// 1 2`; `right: translate 0.02 0 0 during 1`.
#pragma once

#include "verification/drape/scene/held_place.h"

#include <functional>
#include <optional>
#include <string>

namespace homespun::verification
{
/// Receives what was found and what was expected.
using TextFault = std::function<void(const std::string &found, const std::string &expected)>;

/// A place that stays.
/// @param is_sheet whether the cloth has edges and corners with names
HeldPlace place_from(const std::string &text, bool is_sheet, const TextFault &fault);

/// A place that moves, `place: motion`; nothing, with a fault, where no place stands before a
/// colon.
std::optional<HeldPlace> handle_from(const std::string &text, bool is_sheet,
                                     const TextFault &fault);
} // namespace homespun::verification
