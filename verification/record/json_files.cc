// SPDX-License-Identifier: MIT
#include "verification/record/json_files.h"

#include "meshes/files/format_version.h"
#include "meshes/plain/errors.h"

#include <cmath>
#include <fstream>

namespace homespun::verification
{
nlohmann::ordered_json json_number(const double value)
{
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

std::string json_text(const nlohmann::ordered_json &json)
{
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_json(const std::string &path, const nlohmann::ordered_json &json)
{
  nlohmann::ordered_json written = {{"format_version", meshes::format_version}};
  written.update(json);
  write_whole(path, json_text(written));
}

nlohmann::ordered_json read_json(const std::string &path)
{
  std::ifstream input(path);
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(input, nullptr, false);
  if (!json.is_object())
    throw meshes::BadInput(path + ": is damaged; expected what homespun writes there: begin anew "
                                  "with --overwrite");
  return json;
}

nlohmann::ordered_json to_json(const std::vector<Verdict> &verdicts, const std::string &command)
{
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Verdict &verdict : verdicts)
    list.push_back({{"id", verdict.id},
                    {"claim", verdict.claim},
                    {"kind", name_of(verdict.kind)},
                    {"verdict", name_of(verdict.outcome)},
                    {"value", json_number(verdict.value)},
                    {"limit", verdict.limit},
                    {"derivation", verdict.derivation},
                    {"command", command}});
  return {{"verdicts", list}};
}
} // namespace homespun::verification
