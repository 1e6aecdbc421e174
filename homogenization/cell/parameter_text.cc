// SPDX-License-Identifier: MIT
#include "homogenization/cell/parameter_text.h"

#include <deal.II/base/parameter_handler.h>

#include <fstream>
#include <set>
#include <sstream>

namespace homespun::homogenization
{
std::string trimmed(const std::string &text)
{
  const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> split(const std::string &text, const char separator)
{
  std::vector<std::string> parts;
  std::istringstream input(text);
  std::string part;
  while (std::getline(input, part, separator))
    parts.push_back(trimmed(part));
  return parts;
}

std::optional<std::vector<double>> numbers(const std::string &text)
{
  std::istringstream input(text);
  std::string word;
  std::vector<double> values;
  while (input >> word)
  {
    std::size_t used = 0;
    try
    {
      values.push_back(std::stod(word, &used));
    }
    catch (const std::exception &)
    {
      return std::nullopt;
    }
    if (used != word.size())
      return std::nullopt;
  }
  return values;
}

namespace
{
/// The key of a line `set KEY = VALUE`, with single blanks; empty where the line is none.
std::string key_of(const std::string &line)
{
  const std::size_t equal = line.find('=');
  std::istringstream words(line.substr(0, equal));
  std::string word, key;
  words >> word;
  if (word != "set" || equal == std::string::npos)
    return "";
  while (words >> word)
    key += (key.empty() ? "" : " ") + word;
  return key;
}

/// deal.II stops at the first unknown key; this finds all, with their lines.
void find_unknown_keys(const std::string &file, const dealii::ParameterHandler &keys,
                       Faults &faults)
{
  std::stringstream declared;
  keys.print_parameters(declared, dealii::ParameterHandler::ShortPRM);
  std::set<std::string> known;
  std::string line, expected;
  while (std::getline(declared, line))
    if (!key_of(line).empty())
      known.insert(key_of(line));
  for (const std::string &key : known)
    expected += (expected.empty() ? "" : ", ") + key;

  std::ifstream input(file);
  for (int number = 1; std::getline(input, line); ++number)
  {
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty())
      continue;
    const std::string place = file + ":" + std::to_string(number) + ": ";
    const std::string key   = key_of(line);
    if (key.empty())
      faults.push_back(place + "found `" + line + "`; expected `set KEY = VALUE` or a # comment");
    else if (known.count(key) == 0)
      faults.push_back(place + "unknown key `" + key + "`; expected one of " + expected);
  }
}

/// The sentence of a deal.II exception, without its frame of dashes and source lines.
std::string reason_of(const std::exception &exception)
{
  std::istringstream text(exception.what());
  std::string line, reason;
  bool inside = false;
  while (std::getline(text, line))
  {
    if (line.find("Additional information") != std::string::npos)
      inside = true;
    else if (inside &&
             (line.empty() || line.find("Stacktrace") != std::string::npos || line[0] == '-'))
      break;
    else if (inside && !trimmed(line).empty())
      reason += (reason.empty() ? "" : " ") + trimmed(line);
  }
  return reason.empty() ? "no reason given" : reason;
}
} // namespace

void parse_parameters(const std::string &file, dealii::ParameterHandler &keys, Faults &faults)
{
  find_unknown_keys(file, keys, faults);
  if (faults.empty())
    try
    {
      keys.parse_input(file, "", true);
    }
    catch (const std::exception &exception)
    {
      faults.push_back(file + ": cannot be understood: " + reason_of(exception));
    }
}
} // namespace homespun::homogenization
