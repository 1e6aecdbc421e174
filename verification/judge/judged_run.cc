// SPDX-License-Identifier: MIT
#include "verification/judge/judged_run.h"

#include "meshes/plain/errors.h"
#include "verification/judge/given_positions.h"
#include "verification/record/checksum.h"
#include "verification/record/number_text.h"
#include "verification/record/run_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

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
  if (lies_in(options.run, options.output))
    throw BadInput("--output " + options.output + ": holds the run that is judged, " + options.run +
                   ", which would be deleted; expected another folder");
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
      faults.push_back(file.row + file.path + ": `" + name + "` is no level or frame of " +
                       options.run + "; expected one of which CELL/positions/ has a file" +
                       (known.empty() ? "" : ", such as " + known.front()));
  if (!faults.empty())
    throw BadInput(faults);
}

Eigen::VectorXd JudgedRun::distance(const GivenFile &file, const KeptMesh &mesh, const double side,
                                    const PositionRows &reference,
                                    const std::function<void(PositionRows &)> &align)
{
  GivenPositions given = read_positions(file.path, mesh.triangles, reference);
  if (align)
    align(given.points);
  const Eigen::VectorXd distance = reference.cols() == 2 ? distances<2>(given.points, reference)
                                                         : distances<3>(given.points, reference);
  const double moved             = (reference - mesh.vertices).rowwise().norm().mean();
  // A scene has hardly moved at first, where another method may be anywhere in a cell.
  if (distance.mean() > std::max(2. * moved, reference.cols() == 2 ? 0. : 0.5 * side))
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

void JudgedRun::tell(const std::string &where, const ErrorWithBar &own, const UnitOfError &unit,
                     const std::vector<ErrorWithBar> &others) const
{
  const bool has_bar = std::isfinite(own.bar);
  int n_known = 0, n_closer = 0, n_surely = 0;
  for (const ErrorWithBar &other : others)
  {
    n_known += std::isfinite(other.error);
    n_closer += other.error < own.error;
    n_surely += other.error + other.bar < own.error - own.bar;
  }
  std::cout << where << ": "
            << (has_bar ? with_bar(own.error / unit.length, own.bar / unit.length)
                        : short_text(own.error / unit.length))
            << " " << unit.text << (has_bar ? "" : ", error bar not known") << "; " << n_closer
            << " of " << n_known << " methods of homespun are closer";
  if (n_closer > 0 && has_bar)
    std::cout << ", " << n_surely << " of them by more than both error bars";
  std::cout << "\n";
}

void JudgedRun::tell_notes() const
{
  for (const std::string &note : notes)
    std::cout << note << "\n";
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
