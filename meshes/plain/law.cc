// SPDX-License-Identifier: MIT
#include "meshes/plain/law.h"

#include "meshes/plain/errors.h"

namespace homespun::meshes
{
const std::vector<Law> &all_laws()
{
  static const std::vector<Law> all = []()
  {
    std::vector<Law> laws;
    for (std::size_t k = 0; k < law_table.size(); ++k)
      laws.push_back(static_cast<Law>(k));
    return laws;
  }();
  return all;
}

std::vector<Law> laws_with(const LawProperty property)
{
  std::vector<Law> laws;
  for (const Law law : all_laws())
    if (properties_of(law).*property)
      laws.push_back(law);
  return laws;
}

std::string name_of(const Law law)
{
  return properties_of(law).name;
}

void refuse_removed_law(const std::string &name)
{
  if (name == "yarn-tension" || name == "woven-tension")
    throw BadInput("law `" + name + "` was removed in 0.2.0; use `yarn`: compression is marked");
}

Law law_of(const std::string &name)
{
  refuse_removed_law(name);
  std::vector<std::string> known;
  for (const Law law : all_laws())
  {
    if (name == name_of(law))
      return law;
    known.push_back(name_of(law));
  }
  throw BadInput("unknown reference `" + name + "`; expected " + one_of(known));
}
} // namespace homespun::meshes
