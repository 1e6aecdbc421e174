// SPDX-License-Identifier: MIT
#include "verification/drape/scene/fabrics.h"

#include <array>
#include <map>

namespace homespun::verification
{
namespace
{
/// Along 0, 45 and 90 degrees [1e-6 N m].
const std::map<std::string, std::array<double, 3>> measured = {
  {"gray-interlock", {23.2, 24.7, 14.3}},     {"11oz-black-denim", {64.2, 73.4, 97.0}},
  {"camel-ponte-roma", {36.3, 33.0, 37.2}},   {"ivory-rib-knit", {46.2, 30.0, 32.2}},
  {"pink-ribbon-brown", {117.0, 87.5, 59.8}}, {"royal-target", {125.0, 108.0, 125.0}},
  {"white-dots-on-blk", {51.7, 40.7, 31.3}},  {"navy-sparkle-sweat", {59.5, 40.1, 45.6}},
  {"white-swim-solid", {60.2, 58.8, 51.0}},   {"tango-red-jet-set", {14.3, 22.0, 20.3}}};
} // namespace

std::optional<shell::PlateStiffness> bending_of_fabric(const std::string &name)
{
  const auto found = measured.find(name);
  if (found == measured.end())
    return std::nullopt;
  const auto &[along, diagonal, across] = found->second;
  return shell::PlateStiffness{1e-6 * along, 1e-6 * across, 0.,
                               1e-6 * (diagonal - 0.25 * (along + across))};
}

std::string names_of_fabrics()
{
  std::string names;
  for (const auto &fabric : measured)
    names += (names.empty() ? "" : ", ") + fabric.first;
  return names;
}
} // namespace homespun::verification
