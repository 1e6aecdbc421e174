// SPDX-License-Identifier: MIT
#include "verification/strain/strain_options.h"

#include "verification/law/laws.h"
#include "verification/method/method.h"
#include "verification/record/main_reference.h"

#include <algorithm>

namespace homespun::verification
{
StrainStudyOptions default_strain_study()
{
  StrainStudyOptions options;
  options.strains = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2};
  options.loads   = Load::names();
  options.methods = Method::defaults();
  return options;
}

bool has_budget(const StrainStudyOptions &options, const Load &load)
{
  return options.budget && !load.has_free_sides() &&
         !(load.is_periodic() && has_supercell(options));
}

bool has_sheet(const StrainStudyOptions &options)
{
  return std::any_of(options.loads.begin(), options.loads.end(),
                     [](const std::string &load) { return !Load(load).is_periodic(); });
}

bool has_run_times(const StrainStudyOptions &options)
{
  const Law law = law_of(main_reference(options.references));
  return options.run_time && has_sheet(options) && (law == Law::biot || is_of_yarns(law));
}

void make_quick(StrainStudyOptions &options)
{
  options.is_quick             = true;
  options.n_cells              = 4;
  options.strains              = {0.001, 0.01, 0.1};
  options.n_cells_of_error_bar = 2;
}
} // namespace homespun::verification
