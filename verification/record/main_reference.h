// SPDX-License-Identifier: MIT
// Which of several reference laws the claims, the budget and the pictures of a cell speak of: the
// one that the coarse cloth shares with its reference.
#pragma once

#include "meshes/plain/law.h"

#include <algorithm>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The first that the coarse cloth has too, `biot` before `yarn`; else the first.
/// @param references names of laws
/// @return empty where there are none
inline std::string main_reference(const std::vector<std::string> &references)
{
  for (const meshes::Law law : meshes::laws_with(&meshes::LawProperties::is_of_coarse_cloth))
    if (std::find(references.begin(), references.end(), name_of(law)) != references.end())
      return name_of(law);
  return references.empty() ? std::string() : references.front();
}

/// The same of the rows of one cell.
/// @param rows with the columns `cell` and `reference`
template <typename Row>
std::string main_reference(const std::vector<Row> &rows, const std::string &cell)
{
  std::vector<std::string> references;
  for (const Row &row : rows)
    if (row.cell == cell)
      references.push_back(row.reference);
  return main_reference(references);
}
} // namespace homespun::verification
