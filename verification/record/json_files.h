// SPDX-License-Identifier: MIT
// Results as JSON files.
#pragma once

#include "meshes/files/write_whole.h"
#include "verification/record/verdict.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace homespun::verification
{
using meshes::write_whole;

/// A number as JSON; null where it is not finite.
nlohmann::ordered_json json_number(double value);

/// Text of a JSON file; names that are not UTF-8 are written with replacement characters.
std::string json_text(const nlohmann::ordered_json &json);

/// Writes a result as a JSON file, whole, with the key `format_version` (format_version.h) first.
/// @throws BadInput where it cannot be written
void write_json(const std::string &path, const nlohmann::ordered_json &json);

/// Reads one of the program's own.
/// @throws BadInput where it is damaged
nlohmann::ordered_json read_json(const std::string &path);

/// {"verdicts": [{id, claim, kind, verdict, value, limit, derivation, command}]}
nlohmann::ordered_json to_json(const std::vector<Verdict> &verdicts, const std::string &command);
} // namespace homespun::verification
