// SPDX-License-Identifier: MIT
// Forces on the vertices that are known where a step begins and stay over it: of first order in the
// step, like all that terms freeze.
#pragma once

#include "shell/terms/term.h"

#include <functional>
#include <memory>
#include <string>

namespace homespun::shell
{
/// @param name as reports call it
/// @param forces on the vertices at positions (n,3), as many rows [N]
/// @throws BadInput without a function
std::unique_ptr<Term> lagged_load_term(std::string name,
                                       std::function<Vectors(const Vectors &positions)> forces);
} // namespace homespun::shell
