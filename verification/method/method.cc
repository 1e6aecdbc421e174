// SPDX-License-Identifier: MIT
#include "verification/method/method.h"

#include <algorithm>
#include <set>
#include <utility>

namespace homespun::verification
{
Method under(const Method &method, const Law law, const Load &load)
{
  Method left = method.under(law).without(Term::curved);
  if (!load.is_periodic())
    return left;
  left = left.without(Term::p2).without(Term::edges);
  return left.has(Term::micro) ? left : left.without(Term::cubic).without(Term::modes);
}

std::vector<std::string> distinct_methods(const std::vector<std::string> &names, const Law law,
                                          const Load &load)
{
  const std::vector<std::string> presets = Method::presets();
  const auto place_of                    = [&](const std::string &name)
  {
    const auto preset = std::find(presets.begin(), presets.end(), name);
    return preset - presets.begin() +
           (preset == presets.end() ? std::find(names.begin(), names.end(), name) - names.begin()
                                    : 0);
  };
  std::vector<std::string> distinct;
  for (const std::string &name : names)
  {
    const Method method = under(Method(name), law, load);
    if (std::none_of(names.begin(), names.end(),
                     [&](const std::string &other)
                     {
                       return place_of(other) < place_of(name) &&
                              under(Method(other), law, load).has_terms_of(method);
                     }))
      distinct.push_back(name);
  }
  return distinct;
}

std::vector<std::string> distinct_methods(const std::vector<std::string> &names,
                                          const std::vector<Law> &laws, const Load &load)
{
  std::vector<std::string> of_any;
  for (const Law law : laws)
    for (const std::string &name : distinct_methods(names, law, load))
      if (std::find(of_any.begin(), of_any.end(), name) == of_any.end())
        of_any.push_back(name);
  return of_any;
}

std::string main_method(const std::vector<std::string> &names)
{
  std::string main = "localized";
  std::pair<int, std::set<Term>> highest;
  for (const std::string &name : names)
  {
    const Method method(name);
    const std::pair<int, std::set<Term>> its(method.rank(), method.own_terms());
    if (its.first > 0 && its > highest)
    {
      highest = its;
      main    = name;
    }
  }
  return main;
}
} // namespace homespun::verification
