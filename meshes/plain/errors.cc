// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"

#include <sstream>

namespace homespun::meshes
{
namespace
{
std::string joined(const std::vector<std::string> &lines)
{
  std::string text;
  for (const std::string &line : lines)
    text += (text.empty() ? "" : "\n") + line;
  return text;
}

std::string with_history(const std::string &what, const std::vector<double> &residuals)
{
  if (residuals.empty())
    return what;
  std::ostringstream text;
  text << what << "; residual norms:";
  const std::size_t n = residuals.size();
  for (std::size_t i = 0; i < n; ++i)
    if (i < 5 || i + 5 >= n)
      text << ' ' << residuals[i];
    else if (i == 5)
      text << " ...";
  return text.str();
}
} // namespace

BadInput::BadInput(std::vector<std::string> faults)
    : std::runtime_error(joined(faults))
    , all_faults(std::move(faults))
{
}

BadInput::BadInput(const std::string &fault)
    : BadInput(std::vector<std::string>{fault})
{
}

NotConverged::NotConverged(const std::string &what, std::vector<double> residuals)
    : std::runtime_error(with_history(what, residuals))
    , residuals(std::move(residuals))
{
}

std::string one_of(const std::vector<std::string> &names)
{
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " or " : ", ") + names[k];
  return text;
}
} // namespace homespun::meshes
