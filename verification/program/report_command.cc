// SPDX-License-Identifier: MIT
// homespun report: the pages of stored results, made by Debian's Python.
#include "verification/command/report_script.h"
#include "verification/program/program_commands.h"
#include "verification/record/on_root.h"
#include "verification/record/run_folder.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

#include <memory>

namespace homespun::verification
{
void ReportCommand::add(CommandLine &line)
{
  CLI::App *command =
    line.app.add_subcommand("report", "Make report.html and the figures again from stored results");
  struct Arguments
  {
    std::vector<std::string> folders;
    std::string output, figure, width = "8.5cm", loads, format = "pdf,svg";
    bool pdf = false, quiet = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  command
    ->add_option("DIR", arguments->folders,
                 "Folders of results; several cells or versions are compared in one page")
    ->required();
  command->add_option("--output", arguments->output,
                      "Folder of the report (default DIR; of several out/report)");
  command->add_flag("--pdf", arguments->pdf,
                    "Save each figure as PDF as well, which takes half as long again");
  CLI::Option *figure = command->add_option(
    "--figure", arguments->figure,
    "One figure for a paper instead of the page: strain, stiffness or cell, with text as text, "
    "letters of 7 to 9 pt, and curves that survive black and white");
  command->add_option("--width", arguments->width, "Of the figure: 8.5cm, 180mm or 3.3in")
    ->needs(figure)
    ->capture_default_str();
  command
    ->add_option("--loads", arguments->loads, "Of the figure, comma-separated (default all sheets)")
    ->needs(figure);
  command->add_option("--format", arguments->format, "Files of the figure: pdf, svg, png")
    ->needs(figure)
    ->capture_default_str();
  command->add_flag("--quiet", arguments->quiet, "Print errors only");
  command->callback(
    [&line, arguments]()
    {
      line.at_once = [&line, arguments]()
      {
        if (is_root(MPI_COMM_WORLD))
          line.afterwards = [arguments]()
          {
            // A page of several runs belongs to none of them.
            const std::string output = !arguments->output.empty()       ? arguments->output
                                       : arguments->folders.size() == 1 ? arguments->folders[0]
                                                                        : "out/report";
            if (!arguments->figure.empty())
            {
              std::vector<std::string> words = arguments->folders;
              words.insert(words.end(), {"--output", output, "--figure", arguments->figure,
                                         "--width", arguments->width, "--loads", arguments->loads,
                                         "--format", arguments->format});
              return run_report_script("report.py", words);
            }
            make_report(arguments->folders, output, arguments->quiet,
                        arguments->pdf ? FigureFiles::with_pdf : FigureFiles::svg);
            list_report(output);
            return 0;
          };
        return 0;
      };
    });
}
} // namespace homespun::verification
