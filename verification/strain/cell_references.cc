// SPDX-License-Identifier: MIT
#include "verification/strain/cell_references.h"

#include "verification/ellipticity/default_law.h"

#include <algorithm>

namespace homespun::verification
{
using homogenization::UnitCell;

StrainStudyOptions options_of(const StrainStudyOptions &asked, const UnitCell &cell)
{
  StrainStudyOptions options = asked;
  if (asked.references.empty())
    options.references = default_references(cell);
  return options;
}

StrainStudyOptions options_of(const StrainStudyOptions &asked, const std::vector<UnitCell> &cells)
{
  StrainStudyOptions options = asked;
  for (const UnitCell &cell : cells)
    for (const std::string &name : options_of(asked, cell).references)
      if (std::find(options.references.begin(), options.references.end(), name) ==
          options.references.end())
        options.references.push_back(name);
  return options;
}

std::size_t references_per_cell(const StrainStudyOptions &asked)
{
  return asked.references.empty() ? n_default_references : asked.references.size();
}

std::vector<Law> laws_of(const StrainStudyOptions &options)
{
  std::vector<Law> laws;
  for (const std::string &name : options.references)
    laws.push_back(law_of(name));
  return laws;
}

std::vector<std::string> notes_on_references(const StrainStudyOptions &asked,
                                             const std::vector<UnitCell> &cells)
{
  std::vector<std::string> notes;
  if (!asked.references.empty())
    return notes;
  for (const UnitCell &cell : cells)
    notes.push_back(note_on_default_references(cell));
  return notes;
}
} // namespace homespun::verification
