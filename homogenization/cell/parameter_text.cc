// SPDX-License-Identifier: MIT
#include "homogenization/cell/parameter_text.h"

#include <algorithm>
#include <cctype>
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

std::string number_hint(const std::string &text)
{
  const auto reads = [](const std::string &word)
  {
    const auto values = numbers(word);
    return values && values->size() == 1;
  };
  const std::string word = trimmed(text);
  if (std::string with_point = word; std::count(word.begin(), word.end(), ',') == 1)
  {
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    if (reads(with_point))
      return "; numbers have a decimal point: `" + with_point + "`";
  }
  if (!word.empty() && word.back() == '%' && reads(word.substr(0, word.size() - 1)))
  {
    std::ostringstream fraction;
    fraction << (*numbers(word.substr(0, word.size() - 1)))[0] / 100.;
    return "; a percentage is written as a fraction: `" + fraction.str() + "`";
  }
  return "";
}

std::string did_you_mean(const std::string &found, const std::vector<std::string> &names)
{
  // Letters to change, insert, remove or exchange with their neighbour.
  const auto distance = [](const std::string &a, const std::string &b)
  {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
      for (std::size_t j = 0; j <= b.size(); ++j)
      {
        d[i][j] = i == 0 ? j : j == 0 ? i : d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
        if (i > 0 && j > 0)
          d[i][j] = std::min({d[i][j], d[i - 1][j] + 1, d[i][j - 1] + 1});
        if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
          d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    return d[a.size()][b.size()];
  };
  const auto lower = [](std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](const unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  std::string best;
  std::size_t least = 1 + found.size() / 3; // a third of its letters and one
  for (const std::string &name : names)
    if (const std::size_t its = distance(lower(found), lower(name));
        its < least || (its == least && best.empty() && its < name.size()))
    {
      best  = name;
      least = its;
    }
  return best.empty() ? "" : "; did you mean `" + best + "`?";
}

std::string text_of_file(const std::string &file)
{
  std::ifstream input(file, std::ios::binary);
  std::ostringstream text;
  text << input.rdbuf();
  std::string content = text.str();
  if (content.rfind("\xEF\xBB\xBF", 0) == 0) // a byte order mark
    content.erase(0, 3);
  return content;
}

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

std::string kind_of_other_file(const std::string &file)
{
  const std::string content = text_of_file(file), start = content.substr(0, 4096);
  const auto begins = [&](const std::string &words) { return start.rfind(words, 0) == 0; };
  if (begins("\x89HDF"))
    return "an HDF5 file, like cell.h5 of a run";
  if (begins("$MeshFormat") || begins("$NOD"))
    return "a Gmsh mesh";
  if (begins("# vtk DataFile") || begins("<?xml") || begins("<VTKFile"))
    return "a VTK file";
  if (begins("\x7f"
             "ELF") ||
      begins("PK") || begins("\x1f\x8b") || begins("%PDF"))
    return "no text";
  if (begins("\xff\xfe") || begins("\xfe\xff"))
    return "text in UTF-16; save it as UTF-8";
  if (std::any_of(start.begin(), start.end(),
                  [](const unsigned char c)
                  { return c < 32 && c != '\t' && c != '\n' && c != '\r' && c != '\f'; }))
    return "no text";
  if (begins("{") || begins("["))
    return "a JSON file";
  std::istringstream lines(content);
  std::string line;
  bool is_empty = true, is_drawing = false;
  while (std::getline(lines, line))
  {
    if (!key_of(trimmed(line.substr(0, line.find('#')))).empty())
      return "";
    is_empty = is_empty && trimmed(line).empty();
    // Commands of Gmsh, which end so but for a comment.
    const std::string command = trimmed(line.substr(0, line.find("//")));
    is_drawing                = is_drawing || (command.size() > 1 && command.back() == ';' &&
                                command.find_first_of("(=") != std::string::npos);
  }
  if (is_drawing)
    return "a drawing of Gmsh (.geo), which `gmsh -2` makes a mesh of";
  // A line or two that are no keys are named one by one.
  return is_empty                                                ? ""
         : std::count(content.begin(), content.end(), '\n') > 40 ? "no list of keys"
                                                                 : "";
}

std::set<std::string> keys_set_in(const std::string &file)
{
  std::set<std::string> keys;
  std::istringstream lines(text_of_file(file));
  std::string line;
  while (std::getline(lines, line))
    if (const std::string key = key_of(trimmed(line.substr(0, line.find('#')))); !key.empty())
      keys.insert(key);
  return keys;
}
} // namespace homespun::homogenization
