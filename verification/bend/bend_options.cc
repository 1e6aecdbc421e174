// SPDX-License-Identifier: MIT
#include "verification/bend/bend_study.h"
#include "verification/bend/plate_sheet.h"

namespace homespun::verification
{
std::vector<std::string> names_of_bending_loads()
{
  std::vector<std::string> names;
  for (const BendingLoad &load : bending_loads)
    names.emplace_back(load.name);
  return names;
}

void make_quick(BendStudyOptions &options)
{
  options.n_cells = 5;
}
} // namespace homespun::verification
