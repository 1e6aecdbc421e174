// SPDX-License-Identifier: MIT
// The keys of a .prm file: which there are, what they mean by default, what a file says of them.
#pragma once

#include "homogenization/cell/parameter_text.h"

#include <map>
#include <string>

namespace homespun::homogenization
{
/// Keys with their documentation and the places where their values go. The texts are those of
/// deal.II's ParameterHandler, for files without subsections; this one is there without deal.II,
/// whose two hundred libraries take longer to load than a cell to be checked.
class ParameterKeys
{
public:
  struct Key
  {
    std::string *value; ///< its place
    std::string initial, documentation;
  };

  /// Adds a key.
  /// @param value holds the default, receives what a file says, and outlives this
  void add(const std::string &name, std::string &value, const std::string &documentation)
  {
    by_name[name] = {&value, value, documentation};
  }

  /// All keys in the order of their names.
  const std::map<std::string, Key> &all() const
  {
    return by_name;
  }

  /// A file of all keys with their present values, each below its documentation.
  std::string documented() const;

private:
  std::map<std::string, Key> by_name;
};

/// Parses a file into the keys. Lines that are no `set KEY = VALUE`, and unknown keys, become
/// faults with their line, and then no value changes; a file that holds no keys at all is one
/// fault. Of a key that is set twice the last value counts. A byte order mark at the beginning is
/// passed over.
void parse_parameters(const std::string &file, const ParameterKeys &keys, Faults &faults);
} // namespace homespun::homogenization
