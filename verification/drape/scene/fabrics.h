// SPDX-License-Identifier: MIT
// Measured fabrics, whose bending a scene can take by name.
#pragma once

#include "shell/terms/bending.h"

#include <optional>
#include <string>

namespace homespun::verification
{
/// The plate of a measured fabric [N m]: of narrow strips along 0, 45 and 90 degrees, B0, B45, B90,
/// follows D11 = B0, D22 = B90 and D12/2 + D66 = B45 − (B0 + B90)/4. Three directions leave it open
/// how that sum is shared, and a sheet that does not stretch feels the sum alone: D12 = 0 here.
/// Source: Wang, O'Brien, Ramamoorthi, Data-driven elastic models for cloth, SIGGRAPH 2011.
/// @return nothing where no fabric is called so
std::optional<shell::PlateStiffness> bending_of_fabric(const std::string &name);

/// Their names, comma-separated.
std::string names_of_fabrics();
} // namespace homespun::verification
