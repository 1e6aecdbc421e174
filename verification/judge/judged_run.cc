// SPDX-License-Identifier: MIT
#include "verification/judge/judged_run.h"

#include "meshes/plain/errors.h"
#include "verification/judge/given_positions.h"
#include "verification/record/checksum.h"
#include "verification/record/number_text.h"
#include "verification/record/run_folder.h"

#include <algorithm>
#include <filesystem>

namespace homespun::verification
{
namespace fs = std::filesystem;
using meshes::BadInput;
using nlohmann::ordered_json;

namespace
{
/// With the number of components known to the compiler, as the studies have it: so the last bits
/// are theirs.
template <int n_components>
Eigen::VectorXd distances(const PositionRows &one, const PositionRows &two)
{
  using Rows      = Eigen::Matrix<double, Eigen::Dynamic, n_components, Eigen::RowMajor>;
  const Rows from = one, to = two;
  return (from - to).rowwise().norm();
}
} // namespace

JudgedRun::JudgedRun(const JudgeOptions &options)
    : options(options)
    , run(finished_run(options.run))
    , files(files_by_level(options.files))
{
  const std::string command = run.value("command", "");
  if ((command != "strain" && command != "drape") || run["inputs"].contains("judged"))
    throw BadInput(options.run + ": is a run of `homespun " + command +
                   "`, or was judged; expected one of `homespun strain --keep` or `drape --keep`");
}

void JudgedRun::refuse_unknown(const std::vector<std::string> &known,
                               std::vector<std::string> faults) const
{
  for (const auto &[name, file] : files)
    if (std::find(known.begin(), known.end(), name) == known.end())
      faults.push_back(file.path + ": is of no level that " + options.run +
                       " has; expected a name like that of its files in CELL/positions/, as in " +
                       (known.empty() ? name : known.front()) + ".npy");
  if (!faults.empty())
    throw BadInput(faults);
}

Eigen::VectorXd JudgedRun::distance(const GivenFile &file, const JudgedMesh &mesh,
                                    const PositionRows &reference, const double moved,
                                    const std::function<void(PositionRows &)> &align)
{
  GivenPositions given = read_positions(file.path, mesh.triangles, reference);
  if (align)
    align(given.points);
  const Eigen::VectorXd distance = reference.cols() == 2 ? distances<2>(given.points, reference)
                                                         : distances<3>(given.points, reference);
  if (distance.mean() > std::max(2. * moved, 0.5 * mesh.side))
    throw BadInput(file.path + ": its positions are " + short_text(distance.mean()) +
                   " m from the reference in the mean, where the cloth at rest is " +
                   short_text(moved) +
                   " m from it; expected positions in metres, in the order of the kept mesh");
  if (given.resolution > 0.01 * distance.mean())
    notes.push_back(file.path + ": its numbers tell " + short_text(given.resolution) +
                    " m apart; errors of this size, as the " + short_text(distance.mean()) +
                    " m found here, are of the file and not of the method");
  return distance;
}

void JudgedRun::write(const std::string &description, const std::vector<Verdict> &verdicts,
                      const std::function<void()> &write_table) const
{
  RunDescription described = {run["command"], run["inputs"]};
  ordered_json of_files    = ordered_json::object();
  for (const auto &[name, file] : files)
    of_files[name] = checksum_of_file(file.path);
  described.inputs["judged"] = {
    {"method", options.method}, {"run", run["fingerprint"]}, {"positions", of_files}};
  const auto folder = open_run_folder(options.output, described, options.earlier, options.quiet);
  for (const auto &[name, listed] : run["files"].items())
    if (fs::path(name).parent_path().filename() != "positions" && name != "report.html" &&
        name.rfind("figures/", 0) != 0)
    {
      fs::create_directories((fs::path(options.output) / name).parent_path());
      fs::copy_file(fs::path(options.run) / name, fs::path(options.output) / name,
                    fs::copy_options::overwrite_existing);
    }
  write_table();
  ordered_json claims      = read_json(options.output + "/verdicts.json");
  const ordered_json added = to_json(verdicts, options.command)["verdicts"];
  claims["verdicts"].insert(claims["verdicts"].end(), added.begin(), added.end());
  write_json(options.output + "/verdicts.json", claims);
  ordered_json study = read_json(options.output + "/" + description);
  study["judged"]    = options.method;
  study["command"]   = study["command"].get<std::string>() + " && " + options.command;
  study["notes"].push_back(
    "`" + options.method + "` is no method of this program: its positions were given, and held " +
    "against the references of the run " + run["fingerprint"].get<std::string>() +
    "; the bar of its error is that of the reference");
  for (const std::string &note : notes)
    study["notes"].push_back(note);
  write_json(options.output + "/" + description, study);
  folder->finish();
}
} // namespace homespun::verification
