// SPDX-License-Identifier: MIT
// Collects the faults of a mesh, so that a user mends all at once, and not a thousand of one kind.
#pragma once

#include "meshes/plain/mesh_fault.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace homespun::meshes
{
/// Keeps the first three messages of a kind and counts the rest.
class FaultList
{
public:
  /// @param name put before each message, usually the file
  explicit FaultList(std::string name)
      : name(std::move(name))
  {
  }

  /// @param kind plural, completes "and 5 more ..."
  /// @param message what was found, what was expected, what to do
  void add(const std::string &kind, const std::string &message, const Place &place = Place())
  {
    const int n = ++count[kind];
    if (n <= 3)
      faults.push_back({name + ": " + message, place});
  }

  bool empty() const
  {
    return faults.empty();
  }

  /// All messages, the counts at the end; the list is empty afterwards.
  std::vector<std::string> take()
  {
    return messages_of(take_placed());
  }

  std::vector<MeshFault> take_placed()
  {
    for (const auto &[kind, n] : count)
      if (n > 3)
        faults.push_back({name + ": and " + std::to_string(n - 3) + " more " + kind, Place()});
    count.clear();
    return std::exchange(faults, {});
  }

private:
  std::string name;
  std::map<std::string, int> count;
  std::vector<MeshFault> faults;
};
} // namespace homespun::meshes
