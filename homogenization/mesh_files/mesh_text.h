// SPDX-License-Identifier: MIT
// A mesh file as words and lines with their place, for its reader: whatever does not fit is refused
// with file, line, what was found and what was expected.
#pragma once

#include <string>
#include <string_view>

namespace homespun::homogenization
{
/// How finely decimal numbers are written.
struct DecimalDigits
{
  int most     = 0; ///< significant digits of any number
  int decimals = 0; ///< of the coarsest of the numbers that have so many

  /// @param word a decimal number; zeros tell nothing
  void add(std::string_view word);

  /// Half of the last digit of each number may be lost: the unit of that digit, for numbers with at
  /// most this many digits; 0 where there are more, as double precision has.
  double unit(int at_most) const;
};

/// Walks through the text of a file.
class MeshText
{
public:
  /// @throws BadInput where the file cannot be opened
  explicit MeshText(const std::string &file);

  /// A text that is already at hand.
  MeshText(std::string file, std::string content);

  /// The rest of the present line, without its end; the cursor moves to the next one. False at the
  /// end of the file.
  bool line(std::string_view &rest);

  /// The next line without moving.
  std::string_view peek_line() const;

  /// The next word between blanks, over line ends; empty at the end of the file.
  std::string_view word();

  /// @param what is expected, completes "found `x`; expected ..."
  double number(const char *what);

  /// The same, and how finely it is written.
  double number(const char *what, DecimalDigits &digits);
  long integer(const char *what);

  /// A number of items that are still to come.
  /// @param what items
  /// @throws BadInput where the rest of the file is too short for so many
  long count(const char *what);

  /// Passes over `how_many` words.
  void skip(long how_many, const char *what);

  bool at_end() const
  {
    return position >= content.size();
  }

  /// @throws BadInput always: file, line, the message
  [[noreturn]] void fail(const std::string &message) const;

  const std::string file;
  const std::string content;

private:
  void skip_blanks();

  template <typename Value>
  Value parsed(bool (*parse)(std::string_view, Value &), const char *what);

  std::size_t position    = 0;
  std::size_t line_number = 1;
};

/// What every refusal of an unreadable file begins with.
std::string unreadable(const std::string &file);

/// Lower case, for keywords that may be written either way.
std::string lower(std::string_view text);

/// A whole word as a number; false where it is none.
bool to_number(std::string_view word, double &value);
bool to_integer(std::string_view word, long &value);
} // namespace homespun::homogenization
