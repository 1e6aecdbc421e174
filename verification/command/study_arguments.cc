// SPDX-License-Identifier: MIT
#include "verification/command/study_arguments.h"

#include "homogenization/cell/parameter_text.h"
#include "meshes/plain/law.h"
#include "verification/command/report_script.h"
#include "verification/method/method.h"
#include "verification/record/on_root.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

namespace homespun::verification
{
void ArgumentFaults::check_names(const std::string &option, const std::vector<std::string> &names,
                                 const std::vector<std::string> &known)
{
  check_names(option, names,
              [&](const std::string &name)
              {
                if (std::find(known.begin(), known.end(), name) != known.end())
                  return;
                meshes::refuse_removed_law(name);
                throw meshes::BadInput("found `" + name + "`; expected " + meshes::one_of(known));
              });
}

namespace
{
/// Says what a name of version 0.1 is now, unless the study is quiet.
void tell_new_name(const StudyOptions &study, const std::string &option, const std::string &old,
                   const std::string &now)
{
  if (!study.quiet && is_root(MPI_COMM_WORLD))
    std::cerr << "homespun: " << option << ": `" << old << "` is called `" << now
              << "` since 0.2.0\n";
}
} // namespace

void ArgumentFaults::read_variants(const StudyOptions &study, std::vector<std::string> &variants)
{
  std::vector<std::string> read;
  for (const std::string &text : variants)
  {
    const std::string now = text == "corotational" ? "biot" : text == "woven" ? "yarn" : "";
    if (!now.empty())
      tell_new_name(study, "--variants", text, now);
    read.push_back(now.empty() ? text : now);
    if (std::count(read.begin(), read.end(), read.back()) > 1)
      read.pop_back();
  }
  variants = read;
}

void ArgumentFaults::read_methods(StudyOptions &study, std::vector<std::string> &methods,
                                  const std::vector<Term> &without_meaning)
{
  std::vector<std::string> read;
  const auto with_meaning = [&](Method method)
  {
    for (const Term term : without_meaning)
      method = method.without(term);
    return method;
  };
  for (const std::string &text : methods)
    try
    {
      const std::string now = Method::name_of_old(text);
      const Method method(now.empty() ? text : now);
      for (const Term term : without_meaning)
        if (method.asks_for(term))
          throw meshes::BadInput("`" + text + "`: the term " + localization::name_of(term) +
                                 " does nothing here; leave it out");
      if (!now.empty())
        tell_new_name(study, "--methods", text, now);
      const auto same =
        std::find_if(read.begin(), read.end(),
                     [&](const std::string &other)
                     { return with_meaning(method).has_terms_of(with_meaning(Method(other))); });
      if (same == read.end())
        read.push_back(method.name);
      else if (now.empty())
        throw meshes::BadInput("`" + text + "` has the terms of `" + *same +
                               "`; expected one of the two");
    }
    catch (const meshes::BadInput &bad)
    {
      add(std::string("--methods: ") + bad.what());
    }
  methods = read;
}

std::optional<std::array<int, 2>> read_supercell(const std::string &text, ArgumentFaults &faults)
{
  if (text.empty())
    return {};
  constexpr int most      = 8;
  const std::size_t cross = text.find('x');
  const auto one          = homogenization::numbers(text.substr(0, cross));
  const auto other =
    homogenization::numbers(cross == std::string::npos ? "" : text.substr(cross + 1));
  const auto is_count = [](const auto &found)
  {
    return found && found->size() == 1 && (*found)[0] >= 1. && (*found)[0] <= most &&
           (*found)[0] == std::floor((*found)[0]);
  };
  if (is_count(one) && is_count(other) && (*one)[0] * (*other)[0] > 1.)
    return std::array<int, 2>{static_cast<int>((*one)[0]), static_cast<int>((*other)[0])};
  faults.add("--supercell: found `" + text + "`; expected N1xN2, whole numbers from 1 to " +
             std::to_string(most) + " with two cells at least, like 2x2");
  return {};
}

std::vector<std::string> joined_lists(const std::vector<std::string> &words)
{
  std::vector<std::string> joined;
  bool in_list = false; // of an option: the last word is its value, or names it and has one
  for (std::size_t k = 0; k < words.size(); ++k)
  {
    const std::string &word = words[k];
    const bool is_option    = word.rfind("--", 0) == 0;
    if (in_list && !is_option && !word.empty() && !joined.back().empty() &&
        (joined.back().back() == ',' || word.front() == ','))
      joined.back() += word;
    else
    {
      in_list =
        is_option ? word.find('=') != std::string::npos : k > 0 && words[k - 1].rfind("--", 0) == 0;
      joined.push_back(word);
    }
  }
  return joined;
}

std::vector<std::string> stems(const std::vector<std::string> &files)
{
  std::vector<std::string> names;
  for (const std::string &file : files)
    names.push_back(std::filesystem::path(file).stem().string());
  return names;
}

void print(const std::vector<Verdict> &verdicts, const EndOfStudy &end)
{
  for (const Verdict &verdict : verdicts)
    if (end.is_verbose || verdict.outcome != Outcome::pass)
    {
      char value[32] = ""; // of a claim without one there is nothing to print
      if (std::isfinite(verdict.value))
        std::snprintf(value, sizeof(value), ": %.4g", verdict.value);
      std::printf("%-12s %-7s %s%s (%s)\n", name_of(verdict.outcome).c_str(),
                  name_of(verdict.kind).c_str(), verdict.claim.c_str(), value,
                  verdict.limit.c_str());
    }
}

std::string count_of_claims(const std::vector<Verdict> &verdicts)
{
  const auto count = [&](const Outcome outcome)
  {
    return std::count_if(verdicts.begin(), verdicts.end(),
                         [&](const Verdict &verdict) { return verdict.outcome == outcome; });
  };
  const auto n_failed = count(Outcome::fail), n_open = count(Outcome::inconclusive);
  return std::to_string(count(Outcome::pass)) + " of " + std::to_string(verdicts.size()) +
         " claims hold" + (n_failed > 0 ? ", " + std::to_string(n_failed) + " failed" : "") +
         (n_open > 0 ? ", " + std::to_string(n_open) + " open" : "") +
         " (--verbose lists those that hold)";
}

void add_end_options(CLI::App &command, EndOfStudy &end)
{
  command.add_flag("--no-report", end.no_report, "Leave out report.html");
  command.add_flag("--verbose", end.is_verbose, "Also list the claims that hold");
}

void choose_folder(const CLI::App &command, const std::vector<std::string> &input_files,
                   StudyOptions &study)
{
  if (study.output.empty())
    study.output =
      default_folder(command.get_name() + (study.is_quick ? "-quick" : ""), stems(input_files));
}

int conclude(CommandLine &line, const std::vector<Verdict> &verdicts, const StudyOptions &study,
             const EndOfStudy &end)
{
  if (is_root(MPI_COMM_WORLD))
  {
    const std::string last =
      study.quiet || verdicts.empty() ? "" : count_of_claims(verdicts) + "\n";
    if (!study.quiet)
      print(verdicts, end);
    if (end.no_report)
      std::cout << last;
    else
      line.afterwards = [output = study.output, quiet = study.quiet, last]()
      {
        make_report({output}, output, quiet);
        list_report(output);
        std::cout << last;
        return 0;
      };
  }
  return status_of(verdicts);
}
} // namespace homespun::verification
