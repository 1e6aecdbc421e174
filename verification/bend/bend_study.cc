// SPDX-License-Identifier: MIT
#include "verification/bend/bend_study.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "verification/bend/bend_tables.h"
#include "verification/bend/bend_verdicts.h"
#include "verification/bend/wrinkles.h"
#include "verification/cell/cell_bending.h"
#include "verification/cell/discretization_distance.h"
#include "verification/cell/study_of_cells.h"
#include "verification/record/error_norms.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
/// Of D^H, in a wave of wrinkles.
const std::vector<int> cells_per_wave = {4, 6};

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
    for (const UnitCell &cell : cells())
      meshes::tile(cell.mesh, cell.lattice, 1, 1); // refuses cells that make no sheet
  }

  nlohmann::ordered_json inputs() override
  {
    return {{"cells", options.n_cells},
            {"curvatures", options.curvatures},
            {"loads", options.loads},
            {"cells of error bars", n_small()}};
  }

  std::vector<OwedClaim> owed() const override
  {
    std::vector<OwedClaim> owed = owed_of_cells(cells());
    for (const UnitCell &cell : cells())
      for (const BendingLoad &load : loads)
        add_owed_of_bending(cell.name, load.name, owed);
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
      BendRow last;
      last.cell      = cell.name;
      last.load      = load.name;
      last.bending   = options.curvatures.back();
      last.reference = linear;
      last.method    = bending_methods.back(); // which is of every cell
      if (!table->contains(last))
        add_rows(twice(), load);
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

  void add_rows(const CellTwice &cell, const BendingLoad &load)
  {
    const BentSheet sheet(cell.drawn, load, options.n_cells, macro_quads_per_cell(options.n_cells));
    const auto bars =
      carried_bars(distance_of_meshes(cell, load, n_small()), 1. * options.n_cells / n_small());
    const double side = std::sqrt(cell.drawn.cell.lattice.area());
    for (const double bending : options.curvatures)
      for (std::size_t k = 0; k < bending_methods.size(); ++k)
      {
        const BentState &error = sheet.error_of_method[k];
        if (error.size() == 0)
          continue;
        const double curvature  = bending / side;
        const BendingError mean = mean_of(error);
        BendRow row;
        row.cell              = cell.drawn.cell.name;
        row.load              = load.name;
        row.bending           = bending;
        row.reference         = linear;
        row.method            = bending_methods[k];
        row.cells             = options.n_cells;
        row.macro_triangles   = sheet.n_macro_triangles;
        row.fine_triangles    = sheet.sheet.mesh.n_triangles();
        row.curvature         = curvature;
        row.deflection        = curvature * sheet.deflection;
        row.mean              = curvature * mean.position;
        row.normal            = curvature * mean.normal;
        const auto [in, edge] = apart_from_edges(curvature * position_errors(error), sheet.sheet);
        row.interior          = in;
        row.edge              = edge;
        const auto [normal_in, normal_edge] =
          apart_from_edges(curvature * normal_errors(error), sheet.sheet);
        row.normal_interior = normal_in;
        row.normal_edge     = normal_edge;
        if (bars[k])
        {
          const BendingError &macro = sheet.of_macro_mesh[k];
          row.bar        = curvature * (bars[k]->position + safety_unconfirmed * macro.position);
          row.normal_bar = curvature * (bars[k]->normal + safety_unconfirmed * macro.normal);
        }
        row.seconds           = sheet.seconds;
        row.seconds_reference = sheet.seconds_reference;
        table->append_if_missing(row);
      }
  }

  int n_small() const
  {
    return std::min(options.n_cells, options.n_cells_of_error_bar);
  }

  StudyDescription conclude() override
  {
    for (const UnitCell &cell : cells())
      for (const BendingLoad &load : loads)
      {
        std::vector<BendRow> rows; // errors are proportional to the curvature: one level says all
        for (const BendRow &row : table->rows())
          if (row.cell == cell.name && row.load == load.name &&
              row.bending == options.curvatures.front())
            rows.push_back(row);
        add(verdicts_on_bending(rows));
      }
    nlohmann::ordered_json left_out = {
      {{"what", "large turns, stretching, mass, contact"},
       {"why", "plates in linear theory: errors are proportional to the curvature"}}};
    for (const UnitCell &cell : cells())
      if (std::none_of(table->rows().begin(), table->rows().end(),
                       [&](const BendRow &row)
                       { return row.cell == cell.name && row.method == "full"; }))
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
        " cells, in position times the ratio of the sheets' sides, with three times what "
        "halved quads of the homogenized sheet change on the "
        "sheet itself.",
      "Wrinkles: waves out of plane of an infinite sheet that is pressed along an axis and held "
      "by an elastic foundation, as a sheet of length L that is pulled across by T is, by "
      "T (pi/L)^2. The foundation is the one on which D^H has the number of cells per wave."};
  }

  static constexpr const char *linear = "linear";
  const BendStudyOptions options;
  std::vector<BendingLoad> loads;
  // On the first rank alone:
  std::unique_ptr<Table<BendRow>> table;
  std::unique_ptr<Table<WrinkleRow>> wrinkle_table;
};
} // namespace

std::vector<Verdict> run_bend_study(const BendStudyOptions &options, const MPI_Comm communicator)
{
  return BendStudy(options, communicator).run();
}
} // namespace homespun::verification
