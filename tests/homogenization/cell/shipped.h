// SPDX-License-Identifier: MIT
// The cells that come with homespun. For sources that are compiled with CELLS.
#pragma once

#include "homogenization/lint/cell_reading.h"

#include <string>

namespace homespun::tests
{
inline homogenization::UnitCell shipped(const std::string &name)
{
  return homogenization::read_unit_cell(std::string(CELLS) + name + ".prm");
}
} // namespace homespun::tests
