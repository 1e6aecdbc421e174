// SPDX-License-Identifier: MIT
#include "verification/program/study_arguments.h"

#include "homogenization/cell/parameter_text.h"
#include "meshes/plain/law.h"
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

void ArgumentFaults::read_methods(StudyOptions &study, std::vector<std::string> &methods)
{
  std::vector<std::string> read;
  for (const std::string &text : methods)
    try
    {
      const std::string now = Method::name_of_old(text);
      const Method method(now.empty() ? text : now);
      if (!now.empty() && !study.quiet && is_root(MPI_COMM_WORLD))
        std::cerr << "homespun: --methods: `" << text << "` is called `" << now
                  << "` since 0.2.0\n";
      const auto same =
        std::find_if(read.begin(), read.end(),
                     [&](const std::string &other) { return method.has_terms_of(Method(other)); });
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

void print(const std::vector<Verdict> &verdicts)
{
  for (const Verdict &verdict : verdicts)
    std::printf("%-12s %-7s %s: %.4g (%s)\n", name_of(verdict.outcome).c_str(),
                name_of(verdict.kind).c_str(), verdict.claim.c_str(), verdict.value,
                verdict.limit.c_str());
}

void add_report_option(CLI::App &command, bool &no_report)
{
  command.add_flag("--no-report", no_report, "Leave out report.html");
}

int conclude(const std::vector<Verdict> &verdicts, const StudyOptions &study)
{
  if (is_root(MPI_COMM_WORLD) && !study.quiet)
    print(verdicts);
  return status_of(verdicts);
}

AfterMpi report_of(const StudyOptions &study)
{
  if (!is_root(MPI_COMM_WORLD))
    return {};
  return [output = study.output, quiet = study.quiet]()
  {
    make_report({output}, output, quiet);
    list_report(output);
    return 0;
  };
}
} // namespace homespun::verification
