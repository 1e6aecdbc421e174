// SPDX-License-Identifier: MIT
// Writes schema.json, the columns of every table and the rank of the methods, for the report: run
// by the build.
#include "meshes/plain/law.h"
#include "verification/bloch/pattern_tables.h"
#include "verification/bloch/stability_tables.h"
#include "verification/budget/budget_tables.h"
#include "verification/budget/energy_tables.h"
#include "verification/converge/converge_tables.h"
#include "verification/drape/drape_tables.h"
#include "verification/extremes/stress_tables.h"
#include "verification/load/load_tables.h"
#include "verification/method/method.h"
#include "verification/record/json_files.h"
#include "verification/record/schema.h"
#include "verification/reference/loads.h"
#include "verification/strain/strain_tables.h"
#include "verification/upsample/upsample_tables.h"

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
  add_to_schema<StrainRow>(schema);
  add_to_schema<StepRow>(schema);
  add_to_schema<ForceRow>(schema);
  add_to_schema<EllipticityRow>(schema);
  add_to_schema<NoteRow>(schema);
  add_to_schema<UncertaintyRow>(schema);
  add_to_schema<BudgetRow>(schema);
  add_to_schema<SecondCodeRow>(schema);
  add_to_schema<EnergyRow>(schema);
  add_to_schema<RunTimeRow>(schema);
  add_to_schema<ValidityRow>(schema);
  add_to_schema<ConvergeRow>(schema);
  add_to_schema<ClaimRow>(schema);
  add_to_schema<CaseRow>(schema);
  add_to_schema<DrapeRow>(schema);
  add_to_schema<MotionRow>(schema);
  add_to_schema<HeldForceRow>(schema);
  add_to_schema<TermRow>(schema);
  add_to_schema<StressRow>(schema);
  add_to_schema<SolverRow>(schema);
  add_to_schema<LoadRow>(schema);
  add_to_schema<MeasuredRow>(schema);
  add_to_schema<StabilityRow>(schema);
  add_to_schema<LossRow>(schema);
  add_to_schema<ZoneRow>(schema);
  add_to_schema<ModeRow>(schema);
  add_to_schema<PatternRow>(schema);
  add_to_schema<UpsampleRow>(schema);
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
  write_json(argv[1], schema);
  return exit_status::good;
}
