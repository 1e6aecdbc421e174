// SPDX-License-Identifier: MIT
#include "verification/drape/scene/held_place_text.h"

#include "homogenization/cell/parameter_text.h"

#include <cmath>
#include <set>
#include <sstream>

namespace homespun::verification
{
using homogenization::numbers;
using homogenization::trimmed;

HeldPlace place_from(const std::string &text, const bool is_sheet, const TextFault &fault)
{
  HeldPlace place;
  std::istringstream words(text);
  std::string first, second;
  words >> first;
  const std::set<std::string> rows = {"bottom", "top"}, columns = {"left", "right"};
  if (first == "vertices")
  {
    const auto values = numbers(text.substr(8));
    if (!values || values->empty())
      fault(text, "`vertices` and their indices");
    else
      for (const double value : *values)
      {
        if (value < 0. || value != std::floor(value) || value > 1e9)
          fault(text, "indices from 0");
        place.vertices.push_back(static_cast<int>(value));
      }
    place.place = "vertices";
    return place;
  }
  words >> second;
  std::string rest;
  words >> rest;
  const bool edge   = (rows.count(first) || columns.count(first)) && second.empty();
  const bool corner = rows.count(first) && columns.count(second) && rest.empty();
  const bool waist  = first == "waist" && second.empty();
  if (is_sheet && !edge && !corner)
    fault(text, "left, right, bottom, top, a corner such as `top left`, or `vertices 0 1 2`" +
                  std::string(waist ? ": a sheet has no waist" : ""));
  if (!is_sheet && !waist)
    fault(text, "`waist` or `vertices 0 1 2`" +
                  std::string(edge || corner ? ": a garment has no edges by name" : ""));
  place.place = corner ? first + " " + second : first;
  return place;
}

std::optional<HeldPlace> handle_from(const std::string &text, const bool is_sheet,
                                     const TextFault &fault)
{
  const std::string expected = "`place: translate dx dy dz during s` or `place: rotate degrees "
                               "about ax ay az during s`";
  const std::size_t colon    = text.find(':');
  if (colon == std::string::npos)
  {
    fault(text, expected);
    return std::nullopt;
  }
  HeldPlace place = place_from(trimmed(text.substr(0, colon)), is_sheet, fault);
  std::istringstream words(text.substr(colon + 1));
  std::string kind, about, during, rest;
  Motion &motion = place.motion;
  words >> kind;
  bool good = false;
  if (kind == "translate")
  {
    motion.kind = Motion::Kind::translate;
    good = static_cast<bool>(words >> motion.along(0) >> motion.along(1) >> motion.along(2) >>
                             during >> motion.seconds) &&
           during == "during";
  }
  else if (kind == "rotate")
  {
    motion.kind = Motion::Kind::rotate;
    good = static_cast<bool>(words >> motion.angle >> about >> motion.along(0) >> motion.along(1) >>
                             motion.along(2) >> during >> motion.seconds) &&
           about == "about" && during == "during" && motion.along.norm() > 0.;
    motion.angle *= std::acos(-1.) / 180.;
    if (good)
      motion.along.normalize();
  }
  if (!good || (words >> rest) || !(motion.seconds > 0.))
    fault(text, expected);
  return place;
}
} // namespace homespun::verification
