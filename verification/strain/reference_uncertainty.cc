// SPDX-License-Identifier: MIT
#include "verification/strain/reference_uncertainty.h"

#include "meshes/plain/errors.h"
#include "verification/record/on_root.h"
#include "verification/reference/fine_reference.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace homespun::verification
{
namespace
{
/// Distances of two or three solutions, each as `between` has it.
template <typename Solution, typename Between>
DiscretizationDistance distances_of(const std::vector<Solution> &of, const Between &between)
{
  DiscretizationDistance found = unknown_distance;
  found.reached                = true;
  found.p1_to_p2               = between(of[0], of[1]);
  if (of.size() > 2)
  {
    found.p1_to_refined = between(of[0], of[2]);
    found.p2_to_refined = between(of[1], of[2]);
  }
  return found;
}

double mean_distance(const meshes::Points &a, const meshes::Points &b)
{
  const Eigen::VectorXd distance = (a - b).rowwise().norm();
  return distance.mean();
}

double largest_distance(const meshes::Points &a, const meshes::Points &b)
{
  return (a - b).rowwise().norm().maxCoeff();
}

/// What was measured at a strain, or lies on the line through the two beside it.
template <typename Bar>
double at_strain(const std::map<double, Bar> &bars, const double strain, const double Bar::*which)
{
  if (bars.size() == 1)
    return bars.begin()->second.*which;
  const auto right = std::find_if(std::next(bars.begin()), std::prev(bars.end()),
                                  [&](const auto &measured) { return measured.first >= strain; });
  const auto left  = std::prev(right);
  double smallest  = left->second.*which;
  for (const auto &[its_strain, bar] : bars)
    smallest = std::min(smallest, bar.*which);
  return std::max(left->second.*which + (right->second.*which - left->second.*which) *
                                          (strain - left->first) / (right->first - left->first),
                  0.5 * smallest);
}

/// The bar of a larger sheet. That of linear theory, the first of the map, grows with the sheet as
/// measured, and falls where methods err at edges alone; what strain adds to it may lie inside, and
/// does not fall.
template <typename Bar>
double carried(const std::map<double, Bar> &bars, const double strain, const double Bar::*which,
               const double growth)
{
  const double small = bars.begin()->second.*which, bar = at_strain(bars, strain, which),
               excess = std::max(0., bar - small);
  return growth * (bar - excess) + std::max(1., growth) * excess;
}

/// |P1 − P2| of a sheet over that of a smaller one.
double growth(const DiscretizationDistance &at_full, const DiscretizationDistance &of)
{
  return at_full.reached && of.p1_to_p2 != 0. ? std::abs(at_full.p1_to_p2 / of.p1_to_p2)
                                              : unknown_length;
}
} // namespace

ReferenceBar ReferenceBar::operator*(const double factor) const
{
  return {factor * mean, factor * max, factor * to_refined, force};
}

/// One level after another on each discretization, each from where the last one ended.
std::vector<ReferenceUncertainty::Distances>
ReferenceUncertainty::measure(const Measurement &what) const
{
  std::vector<FineReference *> ladder = {&what.of.by(1), &what.of.by(2)};
  if (what.ladder == Ladder::with_refined_p2)
    ladder.push_back(&what.of.by(2, 1));
  std::vector<std::vector<meshes::Points>> positions(what.strains.size());
  std::vector<std::vector<double>> forces(what.strains.size());
  std::size_t n_reached = what.strains.size(); // by all so far: beyond it nothing can be compared
  for (FineReference *const reference : ladder)
  {
    if (n_reached > 0)
      reference->start(load, what.law);
    for (std::size_t k = 0; k < n_reached; ++k)
    {
      const ReferenceStep step = reference->advance(what.strains[k]);
      if (!step.reached)
      {
        n_reached = k;
        break;
      }
      positions[k].push_back(step.positions);
      forces[k].push_back(force_per_width(load, what.of.sheet.sides(), step.forces));
    }
  }
  std::vector<Distances> distances(what.strains.size());
  for (std::size_t k = 0; k < what.strains.size(); ++k)
  {
    if (positions[k].size() < ladder.size())
      continue;
    distances[k].mean  = distances_of(positions[k], mean_distance);
    distances[k].max   = distances_of(positions[k], largest_distance);
    distances[k].force = distances_of(forces[k], [&](const double a, const double b)
                                      { return (a - b) / std::abs(forces[k][0]); });
  }
  add_errors(what, positions, distances);
  return distances;
}

/// Method and reference of the same discretization, and how far their differences are apart.
void ReferenceUncertainty::add_errors(const Measurement &what,
                                      const std::vector<std::vector<meshes::Points>> &references,
                                      std::vector<Distances> &distances) const
{
  if (methods.names.empty())
    return;
  const CellLadder &cells = methods.ladder();
  on_root(communicator,
          [&]()
          {
            std::vector<MovedMethods> by;
            for (const DiscretizedCell &of : cells)
              by.push_back({of.model(), what.of.sheet, load, *methods.fitted});
            for (std::size_t k = 0; k < what.strains.size() && distances[k].mean.reached; ++k)
              for (const std::string &name : methods.names)
                try
                {
                  std::vector<meshes::Points> errors;
                  for (std::size_t d = 0; d < references[k].size(); ++d)
                  {
                    MovedModel &of = by[d].at(what.law, name);
                    errors.emplace_back(of.model.upsample(of.move(what.strains[k])) -
                                        references[k][d]);
                  }
                  distances[k].errors[name] = distances_of(errors, mean_distance);
                }
                catch (const meshes::NotConverged &)
                {
                  distances[k].errors[name] = unknown_distance;
                }
          });
}

/// The row of a table that rank 0 keeps. One without refined P2 does not answer a request with it,
/// unless P1 was not reached.
const UncertaintyRow *ReferenceUncertainty::stored(const Measurement &what, const double strain,
                                                   const std::string &method) const
{
  const UncertaintyRow wanted = {cell.name, load.name,        name_of(what.law),
                                 strain,    what.of.sheet.n1, method};
  if (table != nullptr)
    for (const UncertaintyRow &row : table->rows())
      if (keys_of_row(row) == keys_of_row(wanted) &&
          (what.ladder == Ladder::p1_p2 || std::isfinite(row.p1_to_refined) ||
           !std::isfinite(row.p1_to_p2)))
        return &row;
  return nullptr;
}

/// Whether a row is there is told to all.
bool ReferenceUncertainty::look_up(const Measurement &what, const double strain,
                                   Distances &known) const
{
  const UncertaintyRow *const row = stored(what, strain, UncertaintyRow::of_reference);
  if (row != nullptr)
  {
    const bool reached = std::isfinite(row->p1_to_p2);
    known.mean         = {row->p1_to_p2, row->p1_to_refined, row->p2_to_refined, reached};
    known.max   = {row->p1_to_p2_max, row->p1_to_refined_max, row->p2_to_refined_max, reached};
    known.force = {row->force_p1_to_p2, row->force_p1_to_refined, row->force_p2_to_refined,
                   reached};
  }
  for (DiscretizationDistance *const of : {&known.mean, &known.max, &known.force})
    MPI_Bcast(of, sizeof(*of), MPI_BYTE, 0, communicator);
  return answer_of_root(row != nullptr, communicator);
}

bool ReferenceUncertainty::look_up_errors(const Measurement &what, const double strain,
                                          Distances &known) const
{
  bool is_known = true;
  for (const std::string &name : methods.names)
    if (const UncertaintyRow *const row = stored(what, strain, name))
      known.errors[name] = {row->p1_to_p2, row->p1_to_refined, row->p2_to_refined,
                            std::isfinite(row->p1_to_p2)};
    else
      is_known = false;
  return answer_of_root(is_known, communicator);
}

void ReferenceUncertainty::keep(const Measurement &what, const double strain,
                                const Distances &measured) const
{
  if (!table)
    return;
  const auto row_of = [&](const std::string &method, const DiscretizationDistance &of)
  {
    UncertaintyRow row = {cell.name, load.name,        name_of(what.law),
                          strain,    what.of.sheet.n1, method};
    row.p1_to_p2       = of.p1_to_p2;
    row.p1_to_refined  = of.p1_to_refined;
    row.p2_to_refined  = of.p2_to_refined;
    row.bar            = of.uncertainty(order) / (strain * side);
    return row;
  };
  for (const auto &[name, of] : measured.errors)
    table->append_if_missing(row_of(name, of));
  UncertaintyRow row      = row_of(UncertaintyRow::of_reference, measured.mean);
  row.p1_to_p2_max        = measured.max.p1_to_p2;
  row.p1_to_refined_max   = measured.max.p1_to_refined;
  row.p2_to_refined_max   = measured.max.p2_to_refined;
  row.force_p1_to_p2      = measured.force.p1_to_p2;
  row.force_p1_to_refined = measured.force.p1_to_refined;
  row.force_p2_to_refined = measured.force.p2_to_refined;
  const ReferenceBar bar  = bar_of(measured, strain);
  row.bar_max             = bar.max;
  row.force_bar           = bar.force;
  table->append_if_missing(row);
}

std::vector<ReferenceUncertainty::Distances>
ReferenceUncertainty::known_or_measured(const Measurement &what) const
{
  std::vector<Distances> known(what.strains.size());
  std::vector<char> is_known(what.strains.size());
  for (std::size_t k = 0; k < what.strains.size(); ++k)
    is_known[k] =
      look_up(what, what.strains[k], known[k]) && look_up_errors(what, what.strains[k], known[k]);
  if (std::all_of(is_known.begin(), is_known.end(), [](const char is) { return is; }))
    return known;
  const std::string n = std::to_string(what.of.sheet.n1);
  tell("error bar of " + name_of(what.law) + ", " + n + " x " + n + " cells: P1, P2" +
       (what.ladder == Ladder::with_refined_p2 ? ", refined P2" : ""));
  const std::vector<Distances> measured = measure(what);
  for (std::size_t k = 0; k < what.strains.size(); ++k)
    if (!is_known[k])
      keep(what, what.strains[k], measured[k]);
  return measured;
}

ReferenceBar ReferenceUncertainty::bar_of(const Distances &distances, const double strain) const
{
  return ReferenceBar{distances.mean.uncertainty(order), distances.max.uncertainty(order),
                      distances.mean.p1_to_refined, distances.force.uncertainty(order_of_force)} *
         (1. / (strain * side));
}

void ReferenceUncertainty::keep_bars(const Law law, const double strain, const double measured_at,
                                     const Distances &distances)
{
  measured_bars[law][strain] = bar_of(distances, measured_at);
  for (const auto &[name, of] : distances.errors)
    if (of.reached)
    {
      // Errors that are zero to what solvers leave have converged.
      const bool is_zero              = of.p2_to_refined < solved_to * measured_at * side;
      error_bars[{law, name}][strain] = {of.uncertainty(order) / (measured_at * side),
                                         is_zero ? 0. : of.safety()};
    }
}

ReferenceUncertainty::ReferenceUncertainty(const homogenization::UnitCell &cell, const Load &load,
                                           const Scope &scope, Table<UncertaintyRow> *table,
                                           const MPI_Comm communicator,
                                           const std::function<void(const std::string &)> &tell)
    : cell(cell)
    , load(load)
    , table(table)
    , communicator(communicator)
    , tell(tell)
    , methods(scope.methods)
    , side(std::sqrt(cell.lattice.area()))
    , order(order_of_p2(cell, load.is_periodic() ? order_of_p2_smooth : order_of_p2_sheet))
    , order_of_force(order_of_p2(cell, load.is_periodic() ? order_of_p2_energy : order_of_p2_sheet))
{
  const int n_full      = load.is_periodic() ? 1 : scope.n_cells;
  const int n_measured  = load.is_periodic() ? 1 : std::min(scope.n_small, scope.n_cells);
  const auto references = [&](const int n) -> SheetReferences {
    return {meshes::tile(cell.mesh, cell.lattice, n, n), cell.stiffness_of_phase(), communicator};
  };
  SheetReferences of_small = references(n_measured);
  const Distances small =
    known_or_measured({of_small, Law::linear, {small_strain}, Ladder::with_refined_p2})[0];
  keep_bars(Law::linear, 0., small_strain, small);
  if (n_full != n_measured)
  {
    std::unique_ptr<SheetReferences> own;
    if (scope.full == nullptr)
      own.reset(new SheetReferences(references(n_full)));
    const Distances full = known_or_measured(
      {scope.full == nullptr ? *own : *scope.full, Law::linear, {small_strain}, Ladder::p1_p2})[0];
    carry_over.mean = carry_over.to_refined = growth(full.mean, small.mean);
    carry_over.max                          = growth(full.max, small.max);
    carry_over.force                        = growth(full.force, small.force);
    for (const auto &[name, of] : small.errors)
    {
      const auto its = full.errors.find(name);
      carry_over_of_errors[name] =
        its == full.errors.end() ? unknown_length : growth(its->second, of);
    }
  }
  std::vector<double> strains = {large_strain};
  if (scope.largest_strain > large_strain)
    strains.push_back(scope.largest_strain);
  for (const Law law : scope.laws)
    if (law != Law::linear)
    {
      keep_bars(law, 0., small_strain, small);
      const std::vector<Distances> large =
        known_or_measured({of_small, law, strains, Ladder::with_refined_p2});
      for (std::size_t k = 0; k < strains.size(); ++k)
        if (large[k].mean.reached)
          keep_bars(law, strains[k], strains[k], large[k]);
      if (large[0].mean.reached || scope.largest_strain < middle_strain)
        continue;
      const Distances middle =
        known_or_measured({of_small, law, {middle_strain}, Ladder::with_refined_p2})[0];
      if (middle.mean.reached)
        keep_bars(law, middle_strain, middle_strain, middle);
    }
}

ReferenceBar ReferenceUncertainty::at(const Law law, const double strain) const
{
  const double unit = strain * side;
  const auto value  = [&](const double ReferenceBar::*which)
  { return carried(measured_bars.at(law), strain, which, carry_over.*which); };
  return {value(&ReferenceBar::mean) * unit, value(&ReferenceBar::max) * unit,
          value(&ReferenceBar::to_refined) * unit, value(&ReferenceBar::force)};
}

std::map<std::string, ErrorBar> ReferenceUncertainty::of_errors(const Law law,
                                                                const double strain) const
{
  std::map<std::string, ErrorBar> all;
  for (const std::string &name : methods.names)
    if (const auto bars = error_bars.find({law, name}); bars != error_bars.end())
    {
      const auto grown = carry_over_of_errors.find(name);
      ErrorBar &bar    = all[name];
      bar.mean         = carried(bars->second, strain, &ErrorBar::mean,
                         grown == carry_over_of_errors.end() ? 1. : grown->second) *
                 strain * side;
      bar.safety = 0.;
      for (const auto &[measured_at, of] : bars->second)
        bar.safety = std::max(bar.safety, of.safety);
    }
  return all;
}
} // namespace homespun::verification
