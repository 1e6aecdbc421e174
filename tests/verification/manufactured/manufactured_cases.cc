// SPDX-License-Identifier: MIT
#include "tests/verification/manufactured/manufactured_cases.h"

#include "verification/record/number_text.h"

#include <utility>

namespace homespun::verification
{
ManufacturedCase of_elements(const std::string &name, const unsigned int order,
                             std::vector<int> sizes)
{
  ManufacturedCase result;
  result.name     = name;
  result.order    = order;
  result.h_unit   = "side";
  result.sizes    = std::move(sizes);
  result.extent   = 1.;
  result.L2       = about(order + 1.);
  result.L2_claim = "the L2 error has order p + 1";
  result.H1       = about(order);
  result.theory   = "interpolation with elements of degree p";
  return result;
}

ManufacturedCase of_time_steps(const std::string &name, const double order, std::vector<int> sizes,
                               const double duration)
{
  ManufacturedCase result;
  result.name     = name;
  result.order    = 1;
  result.h_unit   = "s";
  result.sizes    = std::move(sizes);
  result.extent   = duration;
  result.L2       = about(order);
  result.L2_claim = "the L2 error has order " + short_text(order);
  result.has_H1   = false;
  result.theory   = "the order of the integrator";
  return result;
}

const std::vector<ManufacturedCase> &manufactured_cases()
{
  static const std::vector<ManufacturedCase> all = []()
  {
    std::vector<ManufacturedCase> cases;
    for (const auto &some :
         {reference_cases(), shell_cases(), homogenizer_cases(), upsampler_cases()})
      cases.insert(cases.end(), some.begin(), some.end());
    return cases;
  }();
  return all;
}
} // namespace homespun::verification
