// SPDX-License-Identifier: MIT
// What the linter says of a cell, as data.
#pragma once

#include "meshes/plain/mesh_fault.h"

#include <string>
#include <vector>

namespace homespun::homogenization
{
/// A cell with an error cannot be used; one with a warning can, and the result may not be what was
/// meant.
enum class Severity
{
  warning,
  error
};

struct Finding
{
  Severity severity = Severity::error;
  std::string kind;    ///< one or two words: `sliver`, `floating part`
  std::string what;    ///< what was found, with numbers and units
  std::string remedy;  ///< what was expected, and what to do
  meshes::Place place; ///< [m]; not known where it concerns the whole cell
};

/// Both parts in one line.
inline std::string text_of(const Finding &finding)
{
  return finding.remedy.empty() ? finding.what : finding.what + "; " + finding.remedy;
}

inline bool has_errors(const std::vector<Finding> &findings)
{
  for (const Finding &finding : findings)
    if (finding.severity == Severity::error)
      return true;
  return false;
}

/// A message of the form `what; expected ...`, in its two parts.
inline Finding finding_of(const std::string &kind, const std::string &message,
                          const meshes::Place &place = {})
{
  const std::size_t cut = message.find("; expected");
  if (cut == std::string::npos)
    return {Severity::error, kind, message, "", place};
  return {Severity::error, kind, message.substr(0, cut), message.substr(cut + 2), place};
}
} // namespace homespun::homogenization
