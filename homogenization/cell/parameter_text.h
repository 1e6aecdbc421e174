// SPDX-License-Identifier: MIT
// The text of .prm files: words, numbers, lines `set KEY = VALUE`, and what else a file may be.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace homespun::homogenization
{
using Faults = std::vector<std::string>;

/// Without blanks at both ends.
std::string trimmed(const std::string &text);

/// Parts between separators, trimmed.
std::vector<std::string> split(const std::string &text, char separator);

/// Numbers between blanks; nothing where a word is none.
std::optional<std::vector<double>> numbers(const std::string &text);

/// What a text that is no number seems to mean, in words for a message: a decimal comma, a
/// percentage; empty where it is neither.
std::string number_hint(const std::string &text);

/// `; did you mean `NAME`?` of the name that is nearest in letters; empty where none is near.
std::string did_you_mean(const std::string &found, const std::vector<std::string> &names);

/// The whole file, without a byte order mark at its beginning.
std::string text_of_file(const std::string &file);

/// The key of a line `set KEY = VALUE`, with single blanks; empty where the line is none.
std::string key_of(const std::string &line);

/// What a file is that holds no keys, in words: a Gmsh mesh, an HDF5 file, ...; empty where it may
/// hold some.
std::string kind_of_other_file(const std::string &file);

/// The keys that a file sets, known or not; none where it holds none.
std::set<std::string> keys_set_in(const std::string &file);
} // namespace homespun::homogenization
