// SPDX-License-Identifier: MIT
// The tables as the report reads them: their columns once, from the structs that the program
// writes.
#pragma once

#include "verification/record/table.h"

#include <nlohmann/json.hpp>

namespace homespun::verification
{
/// Adds a kind of row: {FILE: {"keys": number of columns that name a row,
/// "columns": [{"name", "domain"}]}}.
template <typename Row>
void add_to_schema(nlohmann::ordered_json &schema)
{
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const ColumnDescription &column : column_descriptions<Row>())
    columns.push_back({{"name", column.name}, {"domain", name_of(column.domain)}});
  schema[Row::file] = {{"keys", Row::n_keys}, {"columns", columns}};
}

/// The tables that a command leaves, by their rows.
template <typename... Row>
struct TablesOf
{
  static void add_to(nlohmann::ordered_json &schema)
  {
    (add_to_schema<Row>(schema), ...);
  }
};
} // namespace homespun::verification
