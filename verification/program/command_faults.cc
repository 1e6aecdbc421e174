// SPDX-License-Identifier: MIT
#include "verification/program/command_faults.h"

#include "homogenization/cell/parameter_text.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

#include <algorithm>
#include <iterator>

namespace homespun::verification
{
namespace
{
std::vector<std::string> commands_of(const CLI::App &app)
{
  std::vector<std::string> names;
  for (const CLI::App *command : app.get_subcommands([](const CLI::App *) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App &app)
{
  std::vector<std::string> names;
  for (const CLI::Option *option : app.get_options())
    for (const std::string &name : option->get_lnames())
      names.push_back("--" + name);
  return names;
}

/// The one name that begins so, or the one that is spelled nearly so.
std::string meant(const std::string &found, const std::vector<std::string> &names)
{
  std::vector<std::string> begun;
  std::copy_if(names.begin(), names.end(), std::back_inserter(begun),
               [&](const std::string &name) { return name.rfind(found, 0) == 0; });
  return begun.size() == 1 ? "; did you mean `" + begun[0] + "`?"
                           : homogenization::did_you_mean(found, names);
}

bool is_option(const std::string &word)
{
  return word.rfind("--", 0) == 0 && word.size() > 2;
}

/// What is wrong with the first word, where the command stands.
std::string fault_of_command(const CLI::App &app, const std::vector<std::string> &words)
{
  const std::vector<std::string> names = commands_of(app);
  const auto is_command                = [&](const std::string &word)
  { return std::find(names.begin(), names.end(), word) != names.end(); };
  std::string text = "found `" + words[0] + "`; expected a command first";
  if (const auto later = std::find_if(words.begin(), words.end(), is_command); later != words.end())
  {
    text += ", as in `homespun " + *later;
    for (auto word = words.begin(); word != words.end(); ++word)
      text += word == later ? "" : " " + *word;
    return text + "`";
  }
  return text + meant(words[0], names) + "; `homespun --help` lists the commands";
}
} // namespace

std::string command_fault(const CLI::App &app, const std::vector<std::string> &words,
                          const CLI::ParseError &error)
{
  if (words.empty())
    return "found nothing; expected a command: `homespun --help` lists them";
  const CLI::App *command  = &app;
  std::string name         = "homespun";
  std::size_t n_of_command = 0;
  for (const std::string &word : words)
  {
    const std::vector<std::string> names = commands_of(*command);
    if (std::find(names.begin(), names.end(), word) == names.end())
      break;
    command = command->get_subcommand(word);
    name += " " + word;
    ++n_of_command;
  }
  if (n_of_command == 0 && !is_option(words[0]))
    return fault_of_command(app, words);
  const std::vector<std::string> options = options_of(*command);
  for (std::size_t k = n_of_command; k < words.size(); ++k)
  {
    const std::string option = words[k].substr(0, words[k].find('='));
    if (is_option(option) && std::find(options.begin(), options.end(), option) == options.end())
      return "found `" + option + "`; expected an option of `" + name + "`" +
             meant(option, options) + "; `" + name + " --help` lists them";
  }
  return name + ": " + error.what() + "; `" + name + " --help` says what is expected";
}
} // namespace homespun::verification
