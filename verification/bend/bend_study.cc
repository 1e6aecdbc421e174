// SPDX-License-Identifier: MIT
#include "verification/bend/bend_study.h"

#include "meshes/plain/errors.h"
#include "verification/bend/bend_tables.h"
#include "verification/bend/bend_verdicts.h"
#include "verification/bend/bent_cloth.h"
#include "verification/bend/wrinkles.h"
#include "verification/cell/cell_bending.h"
#include "verification/cell/discretization_distance.h"
#include "verification/cell/study_of_cells.h"
#include "verification/record/error_norms.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
/// Of D^H, in a wave of wrinkles.
const std::vector<int> cells_per_wave = {4, 6};

/// A sheet against one reference at one curvature.
struct Compared
{
  const char *reference;
  double bending; ///< curvature of its load in linear theory, x cell side
  BentSheet::OfMethods<BentState> errors;
  OptionalErrors bars;
  int macro_triangles;
  double curvature, deflection;
  double seconds, seconds_reference;
};

class BendStudy final : public StudyOfCells
{
public:
  BendStudy(const BendStudyOptions &options, const MPI_Comm communicator)
      : StudyOfCells("bend", options, communicator)
      , options(options)
  {
    for (const BendingLoad &load : bending_loads)
      if (std::find(options.loads.begin(), options.loads.end(), load.name) != options.loads.end())
        loads.push_back(load);
  }

private:
  void refuse() const override
  {
    refuse_cells_without_sheets(cells());
  }

  nlohmann::ordered_json inputs() override
  {
    return {{"cells", options.n_cells},
            {"curvatures", options.curvatures},
            {"loads", options.loads},
            {"references", options.references},
            {"cells of error bars", n_small()}};
  }

  std::vector<OwedClaim> owed() const override
  {
    std::vector<OwedClaim> owed = owed_of_cells(cells());
    for (const UnitCell &cell : cells())
    {
      add_owed_of_wrinkles(cell.name, cells_per_wave, owed);
      for (const BendingLoad &load : loads)
        for (const std::string &reference : options.references)
          if (reference == linear || why_no_large_turns(cell, load).empty())
            add_owed_of_bending(cell.name, load.name, reference, owed);
    }
    return owed;
  }

  void open_tables() override
  {
    table         = std::make_unique<Table<BendRow>>(options.output);
    wrinkle_table = std::make_unique<Table<WrinkleRow>>(options.output);
  }

  void work() override
  {
    CellNeeds needs;
    needs.bending = true;
    std::vector<AssessedCell> assessed;
    std::vector<Verdict> checks;
    for (const UnitCell &cell : cells())
      assessed.push_back(homogenize(cell, needs, checks));
    add(checks);
    on_root(communicator,
            [&]()
            {
              Progress progress(!options.quiet,
                                static_cast<int>(cells().size() * (loads.size() + 1)));
              for (std::size_t k = 0; k < cells().size(); ++k)
              {
                if (assessed[k].bending && !assessed[k].bending->roll) // up to where D^H holds
                  assessed[k].bending->roll = roll_of(cells()[k], {});
                write_cell(cells()[k], assessed[k]);
                solve(cells()[k], progress);
              }
            });
  }

  bool is_asked(const char *reference) const
  {
    return std::find(options.references.begin(), options.references.end(), reference) !=
           options.references.end();
  }

  bool is_complete(const UnitCell &cell, const BendingLoad &load, const char *reference) const
  {
    BendRow last;
    last.cell      = cell.name;
    last.load      = load.name;
    last.bending   = options.curvatures.back();
    last.reference = reference;
    last.method    = bending_methods.back(); // which is of every cell
    return !is_asked(reference) || table->contains(last);
  }

  void solve(const UnitCell &cell, Progress &progress)
  {
    std::unique_ptr<CellTwice> made; // where something is missing
    const auto twice = [&]() -> const CellTwice &
    {
      if (!made)
        made = std::make_unique<CellTwice>(cell);
      return *made;
    };
    for (const BendingLoad &load : loads)
    {
      progress.milestone(cell.name + ", " + load.name);
      const std::string why_not = why_no_large_turns(cell, load);
      if (is_asked(biot) && !why_not.empty())
        left_out.push_back(
          {{"what", cell.name + ", " + load.name + ": reference biot"}, {"why", why_not}});
      if (!is_complete(cell, load, linear))
        add_linear(twice(), load);
      if (why_not.empty() && !is_complete(cell, load, biot))
        add_bent(twice(), load);
      progress.done();
    }
    progress.milestone(cell.name + ", wrinkles");
    WrinkleRow last;
    last.cell           = cell.name;
    last.axis           = 2;
    last.cells_per_wave = cells_per_wave.back();
    if (!wrinkle_table->contains(last))
      for (const WrinkleRow &row : wrinkles(twice(), cells_per_wave))
        wrinkle_table->append_if_missing(row);
    progress.done();
  }

  BentSheet linear_sheet(const CellTwice &cell, const BendingLoad &load, const int n) const
  {
    return {cell.drawn, load, n, macro_quads_per_cell(n)};
  }

  /// In linear theory all curvatures are one.
  void add_linear(const CellTwice &cell, const BendingLoad &load)
  {
    const BentSheet sheet = linear_sheet(cell, load, options.n_cells);
    const OptionalErrors bars =
      carried_bars(distance_of_meshes(cell, load, n_small()),
                   growth_in_linear_theory(ratio_to_small()), cell.factor);
    for (const double bending : options.curvatures)
    {
      const double curvature = bending / side_of(cell);
      Compared compared      = {linear,
                                bending,
                                sheet.error_of_method,
                                bars,
                                sheet.n_macro_triangles,
                                curvature,
                                curvature * sheet.deflection,
                                sheet.seconds,
                                sheet.seconds_reference};
      for (std::size_t k = 0; k < bars.size(); ++k)
      {
        compared.errors[k] *= curvature;
        if (bars[k])
        {
          const BendingError &macro = sheet.of_macro_mesh[k];
          compared.bars[k] =
            BendingError{curvature * (bars[k]->position + safety_unconfirmed * macro.position),
                         curvature * (bars[k]->normal + safety_unconfirmed * macro.normal)};
        }
      }
      add_rows(cell, load, sheet.sheet, compared);
    }
  }

  /// At the loads of linear theory, from one to the next.
  void add_bent(const CellTwice &cell, const BendingLoad &load)
  {
    const double unit_load = linear_sheet(cell, load, options.n_cells).unit_load,
                 of_small  = linear_sheet(cell, load, n_small()).unit_load;
    BentCloth sheet(cell.drawn, load, options.n_cells), small(cell.drawn, load, n_small()),
      finer(cell.finer, load, n_small());
    for (const double bending : options.curvatures)
      try
      {
        const double curvature = bending / side_of(cell);
        const BentByTurns bent = sheet.at(curvature * unit_load);
        OptionalErrors distances;
        try
        {
          distances =
            distance_of_errors(small.sheet, small.at(curvature * of_small).error_of_method,
                               finer.sheet, finer.at(curvature * of_small).error_of_method);
        }
        catch (const meshes::NotConverged &failure)
        {
          leave_out(cell, load, "error bars at", bending, failure);
        }
        add_rows(cell, load, sheet.sheet,
                 {biot, bending, bent.error_of_method,
                  carried_bars(distances, growth_at_large_turns(ratio_to_small()), cell.factor),
                  sheet.sheet.mesh.n_triangles(), bent.curvature, bent.deflection, bent.seconds,
                  bent.seconds_reference});
      }
      catch (const meshes::NotConverged &failure)
      {
        leave_out(cell, load, "all levels from", bending, failure);
        ended.insert({cell.drawn.cell.name, load.name});
        return;
      }
  }

  void leave_out(const CellTwice &cell, const BendingLoad &load, const std::string &what,
                 const double bending, const meshes::NotConverged &failure)
  {
    left_out.push_back({{"what", cell.drawn.cell.name + ", " + load.name + ": reference biot, " +
                                   what + " curvature times cell " + short_text(bending)},
                        {"why", failure.what()}});
  }

  void add_rows(const CellTwice &cell, const BendingLoad &load, const meshes::Sheet &sheet,
                const Compared &compared)
  {
    for (std::size_t k = 0; k < bending_methods.size(); ++k)
    {
      const BentState &error = compared.errors[k];
      if (error.size() == 0)
        continue;
      const BendingError mean = mean_of(error);
      BendRow row;
      row.cell                         = cell.drawn.cell.name;
      row.load                         = load.name;
      row.bending                      = compared.bending;
      row.reference                    = compared.reference;
      row.method                       = bending_methods[k];
      row.cells                        = options.n_cells;
      row.side                         = side_of(cell);
      row.macro_triangles              = compared.macro_triangles;
      row.fine_triangles               = sheet.mesh.n_triangles();
      row.curvature                    = compared.curvature;
      row.deflection                   = compared.deflection;
      row.mean                         = mean.position;
      row.normal                       = mean.normal;
      std::tie(row.interior, row.edge) = apart_from_edges(position_errors(error), sheet);
      std::tie(row.normal_interior, row.normal_edge) =
        apart_from_edges(normal_errors(error), sheet);
      if (compared.bars[k])
      {
        row.bar        = compared.bars[k]->position;
        row.normal_bar = compared.bars[k]->normal;
      }
      row.seconds           = compared.seconds;
      row.seconds_reference = compared.seconds_reference;
      table->append_if_missing(row);
    }
  }

  static double side_of(const CellTwice &cell)
  {
    return std::sqrt(cell.drawn.cell.lattice.area());
  }

  double ratio_to_small() const
  {
    return 1. * options.n_cells / n_small();
  }

  int n_small() const
  {
    return std::min(options.n_cells, options.n_cells_of_error_bar);
  }

  StudyDescription conclude() override
  {
    // Errors of linear theory are proportional to the curvature: one level says all.
    for (const UnitCell &cell : cells())
      for (const BendingLoad &load : loads)
        for (const auto &[reference, bending] : {std::pair(linear, options.curvatures.front()),
                                                 std::pair(biot, options.curvatures.back())})
        {
          BendRow of;
          of.cell      = cell.name;
          of.load      = load.name;
          of.reference = reference;
          std::vector<BendRow> rows;
          for (const BendRow &row : table->rows())
            if (row.cell == of.cell && row.load == of.load && row.reference == of.reference &&
                row.bending == bending)
              rows.push_back(row);
          // Rows that are missing for no reason leave their claims owed.
          if (!rows.empty() || (reference == biot && ended.count({of.cell, of.load}) > 0))
            add(verdicts_on_bending(of, rows));
        }
    for (const WrinkleRow &row : wrinkle_table->rows())
      verdicts.push_back(verdict_on_wrinkles(row));
    left_out.push_back(
      is_asked(biot)
        ? nlohmann::ordered_json({{"what", "terms of free edges at large turns, mass, contact"},
                                  {"why", "none are known; statics of sheets that touch nothing"}})
        : nlohmann::ordered_json(
            {{"what", "large turns, stretching, mass, contact"},
             {"why", "plates in linear theory: errors are proportional to the curvature"}}));
    const auto has = [&](const UnitCell &cell, const char *method)
    {
      return std::any_of(table->rows().begin(), table->rows().end(),
                         [&](const BendRow &row)
                         { return row.cell == cell.name && row.method == method; });
    };
    for (const UnitCell &cell : cells())
      if (has(cell, "affine") && !has(cell, "full"))
        left_out.push_back(
          {{"what", cell.name + ": terms of edges"}, {"why", known_edges_of_plate(cell).why_not}});
    return {{{"cells", options.n_cells}, {"loads", options.loads}}, left_out, notes()};
  }

  std::vector<std::string> notes() const
  {
    return {
      "Errors are means over the vertices. The size of a fluctuation is curvature x cell "
      "side² in position and curvature x cell side in the normal.",
      "An error bar is three times what a refined mesh of cell and sheet changes on " +
        std::to_string(n_small()) + " x " + std::to_string(n_small()) +
        " cells, in position times the ratio of the sheets' sides (in linear theory only without "
        "terms of edges), with three times what "
        "halved quads of the homogenized sheet change on the "
        "sheet itself. At large turns (reference biot) both sheets have the same triangles, and "
        "the first part counts alone.",
      "Wrinkles: waves out of plane of an infinite sheet that is pressed along an axis and held "
      "by an elastic foundation, as a sheet of length L that is pulled across by T is, by "
      "T (pi/L)^2. The foundation is the one on which D^H has the number of cells per wave."};
  }

  static constexpr const char *linear = bending_references[0], *biot = bending_references[1];
  const BendStudyOptions options;
  std::vector<BendingLoad> loads;
  // On the first rank alone:
  std::unique_ptr<Table<BendRow>> table;
  std::unique_ptr<Table<WrinkleRow>> wrinkle_table;
  nlohmann::ordered_json left_out = nlohmann::ordered_json::array();
  std::set<std::pair<std::string, std::string>> ended; ///< cells and loads without equilibrium
};
} // namespace

std::vector<Verdict> run_bend_study(const BendStudyOptions &options, const MPI_Comm communicator)
{
  return BendStudy(options, communicator).run();
}
} // namespace homespun::verification
