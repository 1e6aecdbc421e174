// SPDX-License-Identifier: MIT
// Reading .prm files: flat lists of `set KEY = VALUE`, all faults of a file at once.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dealii
{
class ParameterHandler;
}

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

/// What a file is that holds no keys, in words: a Gmsh mesh, an HDF5 file, ...; empty where it may
/// hold some.
std::string kind_of_other_file(const std::string &file);

/// The keys that a file sets, known or not; none where it holds none.
std::set<std::string> keys_set_in(const std::string &file);

/// Parses a file into the declared keys. Lines that are no `set KEY = VALUE`, and unknown keys,
/// become faults with their line; a file that holds no keys at all is one fault. A byte order mark
/// at the beginning is passed over.
void parse_parameters(const std::string &file, dealii::ParameterHandler &keys, Faults &faults);
} // namespace homespun::homogenization
