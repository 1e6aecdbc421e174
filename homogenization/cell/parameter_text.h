// SPDX-License-Identifier: MIT
// Reading .prm files: flat lists of `set KEY = VALUE`, all faults of a file at once.
#pragma once

#include <optional>
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

/// Parses a file into the declared keys. Lines that are no `set KEY = VALUE`, and unknown keys,
/// become faults with their line.
void parse_parameters(const std::string &file, dealii::ParameterHandler &keys, Faults &faults);
} // namespace homespun::homogenization
