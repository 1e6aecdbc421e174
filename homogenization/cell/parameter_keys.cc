// SPDX-License-Identifier: MIT
#include "homogenization/cell/parameter_keys.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace homespun::homogenization
{
namespace
{
/// A line of a file without its comment, its blanks at both ends, and tabs.
std::string without_comment(std::string line)
{
  line = line.substr(0, line.find('#'));
  std::replace_if(
    line.begin(), line.end(), [](const char c) { return c == '\t' || c == '\v' || c == '\f'; },
    ' ');
  return trimmed(line);
}

/// A text in lines of at most `width` letters, of the last fewer; words that are longer stay whole.
std::vector<std::string> broken(std::string text, const std::size_t width)
{
  std::vector<std::string> lines;
  while (text.size() >= width)
  {
    std::size_t end = text.rfind(' ', width);
    if (end == std::string::npos)
      end = text.find(' ', width);
    if (end == std::string::npos)
      break;
    lines.push_back(text.substr(0, end));
    text.erase(0, end + 1);
  }
  if (!text.empty())
    lines.push_back(text);
  return lines;
}
} // namespace

std::string ParameterKeys::documented() const
{
  constexpr std::size_t width = 76; // of a line of 78 behind `# `
  std::size_t longest         = 0;
  for (const auto &[name, key] : by_name)
    longest = std::max(longest, name.size());
  std::string text = "# Listing of Parameters\n# ---------------------\n";
  bool is_first    = true;
  for (const auto &[name, key] : by_name)
  {
    text += is_first ? "" : "\n";
    is_first = false;
    for (const std::string &line : broken(key.documentation, width))
      text += "# " + line + "\n";
    text += "set " + name + std::string(longest - name.size(), ' ') + " = " + *key.value + "\n";
  }
  return text;
}

void parse_parameters(const std::string &file, const ParameterKeys &keys, Faults &faults)
{
  if (const std::string kind = kind_of_other_file(file); !kind.empty())
  {
    faults.push_back(file + ": is " + kind +
                     "; expected a file of lines `set KEY = VALUE` (.prm): `homespun cells` lists "
                     "examples");
    return;
  }
  std::vector<std::string> names;
  std::string expected;
  for (const auto &[name, key] : keys.all())
  {
    names.push_back(name);
    expected += (expected.empty() ? "" : ", ") + name;
  }
  std::vector<std::pair<std::string *, std::string>> found;
  std::istringstream input(text_of_file(file));
  std::string line;
  for (int number = 1; std::getline(input, line); ++number)
  {
    line = without_comment(line);
    if (line.empty())
      continue;
    const std::string place = file + ":" + std::to_string(number) + ": ";
    const std::string name  = key_of(line);
    const auto key          = keys.all().find(name);
    if (name.empty())
      faults.push_back(place + "found `" + line + "`; expected `set KEY = VALUE` or a # comment");
    else if (key == keys.all().end())
      faults.push_back(place + "unknown key `" + name + "`; expected one of " + expected +
                       did_you_mean(name, names));
    else if (line.back() == '\\')
      faults.push_back(place + "found `" + line +
                       "`; expected the whole value in one line: no line goes on in the next");
    else if (std::any_of(found.begin(), found.end(),
                         [&](const auto &known) { return known.first == key->second.value; }))
      faults.push_back(place + "key `" + name + "` is given twice; expected once");
    else
      found.emplace_back(key->second.value, trimmed(line.substr(line.find('=') + 1)));
  }
  if (faults.empty())
    for (const auto &[value, text] : found)
      *value = text;
}
} // namespace homespun::homogenization
