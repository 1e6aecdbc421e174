// SPDX-License-Identifier: MIT
#include "verification/record/fields.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

namespace homespun::verification
{
namespace
{
template <typename Number>
bool read_number(const std::string &field, Number &value)
{
  const char *const end = field.data() + field.size();
  const auto result     = std::from_chars(field.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

template <typename Number>
std::string text_of_number(const Number value)
{
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}
} // namespace

std::string name_of(const Domain domain)
{
  switch (domain)
  {
  case Domain::name:
    return "name";
  case Domain::text:
    return "text";
  case Domain::real:
    return "real";
  case Domain::not_negative:
    return "not negative";
  case Domain::positive:
    return "positive";
  case Domain::needed_not_negative:
    return "needed not negative";
  case Domain::flag:
    return "flag";
  default:
    return "outcome";
  }
}

std::string to_field(const double value)
{
  return std::isfinite(value) ? text_of_number(value) : std::string();
}

std::string to_field(const int value)
{
  return text_of_number(value);
}

std::string to_field(const long value)
{
  return text_of_number(value);
}

std::string to_field(const unsigned int value)
{
  return text_of_number(value);
}

std::string to_field(const unsigned long value)
{
  return text_of_number(value);
}

std::string to_field(const bool value)
{
  return value ? "true" : "false";
}

std::string to_field(const Outcome value)
{
  return name_of(value);
}

std::string to_field(const Kind value)
{
  return name_of(value);
}

std::string to_field(const std::string &value)
{
  const bool needs_quotes = value.find_first_of(",\"") != std::string::npos;
  std::string text;
  for (const char c : value)
    if (c == '\n' || c == '\r')
      text += ' ';
    else
      text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return needs_quotes ? "\"" + text + "\"" : text;
}

bool read_field(const std::string &field, double &value)
{
  value = std::numeric_limits<double>::quiet_NaN();
  return field.empty() || (read_number(field, value) && std::isfinite(value));
}

bool read_field(const std::string &field, int &value)
{
  return read_number(field, value);
}

bool read_field(const std::string &field, long &value)
{
  return read_number(field, value);
}

bool read_field(const std::string &field, unsigned int &value)
{
  return read_number(field, value);
}

bool read_field(const std::string &field, unsigned long &value)
{
  return read_number(field, value);
}

bool read_field(const std::string &field, bool &value)
{
  value = field == "true";
  return value || field == "false";
}

bool read_field(const std::string &field, Outcome &value)
{
  for (const Outcome one : {Outcome::pass, Outcome::fail, Outcome::inconclusive})
    if (field == name_of(one))
    {
      value = one;
      return true;
    }
  return false;
}

bool read_field(const std::string &field, Kind &value)
{
  for (const Kind one : {Kind::program, Kind::input, Kind::method})
    if (field == name_of(one))
    {
      value = one;
      return true;
    }
  return false;
}

bool read_field(const std::string &field, std::string &value)
{
  value = field;
  return true;
}

std::string fault_of(const std::string &field, const Domain domain)
{
  double number       = 0.;
  Outcome outcome     = Outcome::pass;
  bool flag           = false;
  const bool is_empty = field.empty(), is_number = read_field(field, number);
  switch (domain)
  {
  case Domain::name:
    return is_empty ? "a name" : "";
  case Domain::text:
    return "";
  case Domain::real:
    return is_number ? "" : "a number, or nothing";
  case Domain::not_negative:
    return is_number && !(number < 0.) ? "" : "a number, zero or above, or nothing";
  case Domain::positive:
    return is_number && number > 0. ? "" : "a number above zero";
  case Domain::needed_not_negative:
    return is_number && number >= 0. ? "" : "a number, zero or above";
  case Domain::flag:
    return read_field(field, flag) ? "" : "true or false";
  default:
    return is_empty || read_field(field, outcome) ? "" : "PASS, FAIL, INCONCLUSIVE, or nothing";
  }
}

std::vector<std::string> fields_of(const std::string &line)
{
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k)
    if (line[k] == '"' && is_quoted && k + 1 < line.size() && line[k + 1] == '"')
    {
      fields.back() += '"';
      ++k;
    }
    else if (line[k] == '"')
      is_quoted = !is_quoted;
    else if (line[k] == ',' && !is_quoted)
      fields.emplace_back();
    else
      fields.back() += line[k];
  return fields;
}
} // namespace homespun::verification
