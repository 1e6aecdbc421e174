// SPDX-License-Identifier: MIT
// Writes schema.json, the columns of every table, the rank of the methods and the claims, for the
// report: run by the build.
#include "meshes/plain/law.h"
#include "verification/method/method.h"
#include "verification/program/all_commands.h"
#include "verification/record/claim.h"
#include "verification/record/json_files.h"
#include "verification/reference/loads.h"

#include <cstdio>

int main(int argc, char **argv)
{
  using namespace homespun::verification;
  if (argc != 2)
  {
    std::fprintf(stderr, "write_schema: expected one argument, the path of schema.json\n");
    return exit_status::bad_input;
  }
  nlohmann::ordered_json schema;
  AllCommands::add_tables(schema);
  for (const homespun::meshes::LawProperties &law : homespun::meshes::law_table)
    schema["laws"].push_back({{"name", law.name},
                              {"is_of_coarse_cloth", law.is_of_coarse_cloth},
                              {"has_second_order", law.has_second_order},
                              {"is_of_space", law.is_of_space}});
  for (const LoadProperties &load : load_table)
    schema["loads"].push_back(
      {{"name", load.name}, {"label", load.label}, {"is_infinite", load.kind != LoadKind::sheet}});
  for (const std::string &preset : Method::presets())
    schema["methods"][preset] = Method(preset).term_names();
  schema["claims"] = nlohmann::ordered_json::parse(claims_text);
  write_json(argv[1], schema);
  return exit_status::good;
}
