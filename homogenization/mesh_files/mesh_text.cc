// SPDX-License-Identifier: MIT
#include "homogenization/mesh_files/mesh_text.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace homespun::homogenization
{
namespace
{
std::string content_of(const std::string &file)
{
  std::ifstream input(file, std::ios::binary);
  if (!input)
    throw meshes::BadInput(unreadable(file) + "it cannot be opened; expected permission to read");
  std::ostringstream text;
  text << input.rdbuf();
  return std::move(text).str();
}

bool is_blank(const char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

/// A word for a message: short, printable.
std::string quoted(const std::string_view word)
{
  if (word.empty())
    return "the end of the file";
  std::string text = "`";
  for (const char c : word.substr(0, 40))
    text += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
  return text + (word.size() > 40 ? "...`" : "`");
}
} // namespace

std::string unreadable(const std::string &file)
{
  return file + ": cannot be read as a mesh: ";
}

std::string lower(const std::string_view text)
{
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](const unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

bool to_number(std::string_view word, double &value)
{
  if (!word.empty() && word[0] == '+')
    word.remove_prefix(1);
  const char *end   = word.data() + word.size();
  const auto parsed = std::from_chars(word.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

bool to_integer(std::string_view word, long &value)
{
  if (!word.empty() && word[0] == '+')
    word.remove_prefix(1);
  const char *end   = word.data() + word.size();
  const auto parsed = std::from_chars(word.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

void DecimalDigits::add(const std::string_view word)
{
  int digits = 0, after_point = 0;
  bool is_after = false;
  std::size_t k = 0;
  for (; k < word.size() && word[k] != 'e' && word[k] != 'E'; ++k)
    if (word[k] == '.')
      is_after = true;
    else if (word[k] >= '0' && word[k] <= '9')
    {
      digits += digits > 0 || word[k] != '0' ? 1 : 0;
      after_point += is_after ? 1 : 0;
    }
  long exponent = 0;
  if (k + 1 < word.size())
    to_integer(word.substr(k + 1), exponent);
  const int its = after_point - static_cast<int>(std::clamp(exponent, -400L, 400L));
  if (digits == 0 || digits < most)
    return;
  decimals = digits > most ? its : std::min(decimals, its);
  most     = digits;
}

double DecimalDigits::unit(const int at_most) const
{
  return most == 0 || most > at_most ? 0. : std::pow(10., -decimals);
}

MeshText::MeshText(const std::string &file)
    : MeshText(file, content_of(file))
{
}

MeshText::MeshText(std::string file, std::string content)
    : file(std::move(file))
    , content(std::move(content))
{
}

void MeshText::fail(const std::string &message) const
{
  throw meshes::BadInput(unreadable(file) + "line " + std::to_string(line_number) + ": " + message);
}

bool MeshText::line(std::string_view &rest)
{
  if (at_end())
    return false;
  rest = peek_line();
  // The last line may lack its end.
  position = std::min(position + rest.size() + 1, content.size());
  ++line_number;
  if (!rest.empty() && rest.back() == '\r')
    rest.remove_suffix(1);
  return true;
}

std::string_view MeshText::peek_line() const
{
  if (at_end())
    return {};
  const std::size_t end = content.find('\n', position);
  return std::string_view(content).substr(
    position, (end == std::string::npos ? content.size() : end) - position);
}

void MeshText::skip_blanks()
{
  for (; position < content.size() && is_blank(content[position]); ++position)
    if (content[position] == '\n')
      ++line_number;
}

std::string_view MeshText::word()
{
  skip_blanks();
  const std::size_t first = position;
  while (position < content.size() && !is_blank(content[position]))
    ++position;
  return std::string_view(content).substr(first, position - first);
}

template <typename Value>
Value MeshText::parsed(bool (*parse)(std::string_view, Value &), const char *what)
{
  const std::string_view found = word();
  Value value{};
  if (!parse(found, value))
    fail("found " + quoted(found) + "; expected " + what);
  return value;
}

double MeshText::number(const char *what)
{
  return parsed(to_number, what);
}

double MeshText::number(const char *what, DecimalDigits &digits)
{
  skip_blanks();
  const std::size_t first = position;
  const double value      = number(what);
  digits.add(std::string_view(content).substr(first, position - first));
  return value;
}

long MeshText::integer(const char *what)
{
  return parsed(to_integer, what);
}

long MeshText::count(const char *what)
{
  const long value = integer(what);
  // Each item takes a character and a blank.
  if (value < 0 || static_cast<std::size_t>(value) > (content.size() - position + 1) / 2)
    fail("found `" + std::to_string(value) + "` as the number of " + what +
         "; expected at most what the rest of the file can hold: it is cut off, write it again");
  return value;
}

void MeshText::skip(const long how_many, const char *what)
{
  for (long k = 0; k < how_many; ++k)
    if (word().empty())
      fail(std::string("found the end of the file; expected ") + what);
}
} // namespace homespun::homogenization
