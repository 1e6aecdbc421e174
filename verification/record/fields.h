// SPDX-License-Identifier: MIT
// Values as fields of a CSV file and back: what is read is what was written, to the last bit.
#pragma once

#include "verification/record/verdict.h"

#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What a column may hold.
enum class Domain
{
  name,                ///< a text that is not empty
  text,                ///< any text
  real,                ///< a finite number, or nothing
  not_negative,        ///< a finite number not below zero, or nothing
  positive,            ///< a finite number above zero
  needed_not_negative, ///< a finite number not below zero
  flag,                ///< true or false
  outcome              ///< PASS, FAIL or INCONCLUSIVE, or nothing
};

/// The name of a domain in the schema of the tables.
std::string name_of(Domain domain);

/// The shortest text that reads back as the same number; empty where the value is not finite.
std::string to_field(double value);
std::string to_field(int value);
std::string to_field(long value);
std::string to_field(unsigned int value);
std::string to_field(unsigned long value);
std::string to_field(bool value);
std::string to_field(Outcome value);
std::string to_field(Kind value);

/// As CSV has it: in quotes where it holds a comma or a quote; line breaks become spaces, because a
/// row that was cut by a kill is recognised by its missing line break.
std::string to_field(const std::string &value);

template <typename Value>
std::string to_field(const std::optional<Value> &value)
{
  return value ? to_field(*value) : std::string();
}

/// Reads a field whose quotes are gone.
/// @return whether it could be read; an empty field is a double that is not a number
bool read_field(const std::string &field, double &value);
bool read_field(const std::string &field, int &value);
bool read_field(const std::string &field, long &value);
bool read_field(const std::string &field, unsigned int &value);
bool read_field(const std::string &field, unsigned long &value);
bool read_field(const std::string &field, bool &value);
bool read_field(const std::string &field, Outcome &value);
bool read_field(const std::string &field, Kind &value);
bool read_field(const std::string &field, std::string &value);

template <typename Value>
bool read_field(const std::string &field, std::optional<Value> &value)
{
  if (field.empty())
  {
    value.reset();
    return true;
  }
  return read_field(field, value.emplace());
}

/// What a field of this domain should have been, where it is not: "a number above zero"; else
/// empty.
std::string fault_of(const std::string &field, Domain domain);

/// The fields of a line of a CSV file.
std::vector<std::string> fields_of(const std::string &line);
} // namespace homespun::verification
