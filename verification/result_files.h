// SPDX-License-Identifier: MIT
#pragma once

#include "verification/record/fields.h"

namespace homespun::verification
{
inline std::string csv_number(const double value)
{
  return short_text(value);
}
} // namespace homespun::verification
