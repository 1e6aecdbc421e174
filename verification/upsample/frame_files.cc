// SPDX-License-Identifier: MIT
#include "verification/upsample/frame_files.h"

#include "meshes/plain/errors.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>

#include <glob.h>

namespace homespun::verification
{
namespace
{
std::vector<std::string> files_of_pattern(const std::string &pattern)
{
  glob_t found;
  std::vector<std::string> files;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  std::sort(files.begin(), files.end(), comes_before);
  return files;
}

std::string text_of(const meshes::Polygon &face)
{
  std::string text;
  for (const int corner : face)
    if (corner >= 0)
      text += (text.empty() ? "" : " ") + std::to_string(corner);
  return text;
}
} // namespace

bool comes_before(const std::string &one, const std::string &other)
{
  const auto is_digit = [](const char c)
  { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0, j = 0;
  while (i < one.size() && j < other.size())
  {
    if (!is_digit(one[i]) || !is_digit(other[j]))
    {
      if (one[i] != other[j])
        return one[i] < other[j];
      ++i;
      ++j;
      continue;
    }
    const auto number = [&](const std::string &text, std::size_t &at)
    {
      while (at < text.size() && text[at] == '0')
        ++at;
      const std::size_t begin = at;
      while (at < text.size() && is_digit(text[at]))
        ++at;
      return text.substr(begin, at - begin);
    };
    const std::string a = number(one, i), b = number(other, j);
    if (a.size() != b.size())
      return a.size() < b.size();
    if (a != b)
      return a < b;
  }
  return one.size() - i < other.size() - j || (one.size() - i == other.size() - j && one < other);
}

std::vector<FrameFile> frames_of(const std::vector<std::string> &files_and_patterns)
{
  std::vector<FrameFile> frames;
  std::vector<std::string> faults;
  std::map<std::string, std::string> file_of_name;
  const auto add = [&](const std::string &file)
  {
    const std::string name       = std::filesystem::path(file).stem();
    const auto [earlier, is_new] = file_of_name.emplace(name, file);
    if (!is_new)
      faults.push_back(file + ": has the name of " + earlier->second +
                       "; expected a name of its own, after which its result is named: take one "
                       "folder and one format of frames at a time");
    frames.push_back({file, name});
  };
  for (const std::string &one : files_and_patterns)
  {
    const bool is_pattern =
      one.find_first_of("*?[") != std::string::npos && !std::filesystem::exists(one);
    const std::vector<std::string> files =
      is_pattern ? files_of_pattern(one) : std::vector<std::string>{one};
    if (files.empty())
      faults.push_back(one + ": no file fits this pattern; expected frames, .obj or .ply");
    for (const std::string &file : files)
      add(file);
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return frames;
}

std::string fault_of_frame(const meshes::Polygons &frame, const std::string &name,
                           const meshes::Polygons &rest, const std::string &rest_name)
{
  const std::string remedy = ": export all frames from the one mesh that " + rest_name + " is";
  if (frame.positions.rows() != rest.positions.rows())
    return name + ": has " + std::to_string(frame.positions.rows()) + " vertices; expected " +
           std::to_string(rest.positions.rows()) + ", those of " + rest_name + remedy;
  if (frame.faces.size() != rest.faces.size())
    return name + ": has " + std::to_string(frame.faces.size()) + " faces; expected " +
           std::to_string(rest.faces.size()) + ", those of " + rest_name + remedy;
  for (std::size_t f = 0; f < rest.faces.size(); ++f)
    if (frame.faces[f] != rest.faces[f])
      return name + ": face " + std::to_string(f) + " has the vertices " + text_of(frame.faces[f]) +
             " (from 0); expected " + text_of(rest.faces[f]) + ", those of " + rest_name + remedy;
  return "";
}

std::string note_on_place(const double farthest, const double side)
{
  const double apart = farthest * std::numeric_limits<float>::epsilon();
  if (!(apart > 1e-4 * side))
    return "";
  return "frames: the cloth is up to " + short_text(farthest) +
         " m from the origin, where single precision tells places " + short_text(apart) +
         " m apart, " + percent_text(apart / side) + " of a cell's side: move it to the origin";
}

std::string note_on_keywords(const std::set<std::string> &passed_over)
{
  std::string keywords;
  for (const std::string &word : passed_over)
    keywords += (keywords.empty() ? "frames: lines of ARCSim were passed over: " : ", ") + word;
  return keywords;
}
} // namespace homespun::verification
