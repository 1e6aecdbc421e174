// SPDX-License-Identifier: MIT
// The bar of a method's error, where method and reference change their discretization together,
// against errors that are measured apart from it.
#include "homogenization/edges/edge_layers.h"
#include "homogenization/lint/cell_reading.h"
#include "localization/coarse_frames.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/reference/fine_reference.h"
#include "verification/strain/reference_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr double any_strain              = 1e-3; // the law is linear
const std::vector<std::string> of_sheets = {"affine", "localized", "full-micro", "full"};
const std::map<Law, meshes::FittedModes> no_modes;

homogenization::UnitCell cell_named(const std::string &name)
{
  return homogenization::read_unit_cell(std::string(CELLS) + name + ".prm");
}

CellLadder ladder_of_cell(const homogenization::UnitCell &cell)
{
  return ladder_of(cell, {tests::homogenized(cell), homogenization::edges_of(cell, {})},
                   MPI_COMM_SELF);
}

ReferenceUncertainty uncertainty(const homogenization::UnitCell &cell, const CellLadder &ladder,
                                 const std::string &load, const int n_cells, const int n_small)
{
  return {cell,
          Load(load),
          {{Law::linear},
           n_cells,
           n_small,
           any_strain,
           {of_sheets, [&]() -> const CellLadder & { return ladder; }, &no_modes}},
          nullptr,
          MPI_COMM_SELF,
          [](const std::string &) {}};
}

std::map<std::string, ErrorBar> bars(const homogenization::UnitCell &cell, const CellLadder &ladder,
                                     const std::string &load, const int n_cells, const int n_small)
{
  return uncertainty(cell, ladder, load, n_cells, n_small).of_errors(Law::linear, any_strain);
}

/// Mean error of a method, cell and reference by one discretization [m].
double error_of(const homogenization::UnitCell &cell, const CellLadder &ladder,
                const std::string &method, const Load &load, const int n_cells,
                const std::size_t discretization)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells);
  const ReferenceOptions options =
    std::vector<ReferenceOptions>{{1, 0}, {2, 0}, {2, 1}}[discretization];
  FineReference reference(sheet, cell.stiffness_of_phase(), options, MPI_COMM_SELF);
  reference.start(load, Law::linear);
  const meshes::Points fine = reference.advance(any_strain).positions;
  MovedMethods methods      = {ladder[discretization].model(), sheet, load};
  MovedModel &its           = methods.at(Law::linear, method);
  return (its.model.upsample(its.move(any_strain)) - fine).rowwise().norm().mean();
}
} // namespace

// By the triangle inequality; and where chi and its layers at edges are added, method and reference
// share what their mesh lacks inside and at the edges, so that the error is known better than the
// reference.
TEST(bound_error_bar, covers_what_the_error_changes_by_with_the_discretization)
{
  const Load load("strip-1");
  for (const char *name : {"checkerboard", "three-stiffness"})
  {
    const homogenization::UnitCell cell = cell_named(name);
    const CellLadder ladder             = ladder_of_cell(cell);
    const ReferenceUncertainty of_cell  = uncertainty(cell, ladder, load.name, 2, 2);
    const auto all                      = of_cell.of_errors(Law::linear, any_strain);
    const double of_reference           = of_cell.at(Law::linear, any_strain).mean;
    for (const std::string method : {"affine", "localized", "full"})
    {
      const double p1      = error_of(cell, ladder, method, load, 2, 0),
                   refined = error_of(cell, ladder, method, load, 2, 2), bar = all.at(method).mean;
      EXPECT_LT(std::abs(p1 - refined), bar) << name << " " << method;
      EXPECT_LT(bar, p1) << name << " " << method << ": the error is not known";
      if (method == "full")
      {
        EXPECT_LT(bar, of_reference) << name;
      }
    }
  }
}

// A bar is F times what was measured. One that is carried holds as long as it is no less than what
// is measured at full size without F, and is F times too long at most.
TEST(bound_error_bar, carried_to_a_larger_sheet_holds_within_its_safety_factor)
{
  for (const char *name : {"checkerboard", "three-stiffness", "layered"})
  {
    const homogenization::UnitCell cell = cell_named(name);
    const CellLadder ladder             = ladder_of_cell(cell);
    const auto carried                  = bars(cell, ladder, "strip-1", 4, 2),
               measured                 = bars(cell, ladder, "strip-1", 4, 4);
    for (const auto &[method, bar] : measured)
    {
      EXPECT_GE(carried.at(method).mean, bar.mean / bar.safety) << name << " " << method;
      EXPECT_LE(carried.at(method).mean, bar.mean * bar.safety) << name << " " << method;
    }
  }
}

// In linear theory terms of edges leave an error at edges alone, which falls as a sheet grows; what
// the turning of yarns adds lies inside and does not.
TEST(bound_error_bar, what_strain_adds_to_it_is_carried_whole)
{
  homogenization::UnitCell cell = cell_named("../../tests/cells/plain-weave-straight");
  cell.phases                   = cell_named("plain-weave").phases; // crimped
  const CellLadder ladder       = ladder_of_cell(cell);
  const std::string method      = "localized+p2+edges";
  const auto added              = [&](const int n_cells, const int n_small)
  {
    const MethodsOfCell methods = {
      {method}, [&]() -> const CellLadder & { return ladder; }, &no_modes};
    const ReferenceUncertainty of(cell, Load("strip-1"),
                                  {{Law::linear, Law::yarn}, n_cells, n_small, 0.04, methods},
                                  nullptr, MPI_COMM_SELF, [](const std::string &) {});
    const ErrorBar bar = of.of_errors(Law::yarn, 0.04).at(method);
    return std::pair(bar.mean - of.of_errors(Law::linear, 0.04).at(method).mean, bar.safety);
  };
  const auto [carried, F] = added(4, 2);
  const double measured   = added(4, 4).first;
  EXPECT_GT(measured, 0.);
  EXPECT_GE(carried, measured / F);
}

// Of an infinite cloth in linear theory localized is exact by each discretization; with a method
// that does not follow the reference it is not.
TEST(tripwire_error_bar, a_method_of_another_discretization_than_its_reference_is_seen)
{
  const homogenization::UnitCell cell = cell_named("checkerboard");
  CellLadder ladder                   = ladder_of_cell(cell);
  const double zero                   = solved_to * any_strain * std::sqrt(cell.lattice.area());
  EXPECT_LT(bars(cell, ladder, "periodic-11", 1, 1).at("localized").mean, 3. * zero);
  for (const std::size_t k : {1, 2})
    ladder[k] = ladder[0];
  EXPECT_GT(bars(cell, ladder, "periodic-11", 1, 1).at("localized").mean, 1e3 * zero);
}

TEST(exact_error_bar, what_was_not_run_has_none)
{
  const homogenization::UnitCell cell = cell_named("layered");
  const ReferenceUncertainty none(cell, Load("strip-1"), {{Law::linear}, 1, 1, any_strain}, nullptr,
                                  MPI_COMM_SELF, [](const std::string &) {});
  EXPECT_TRUE(none.of_errors(Law::linear, any_strain).empty());
  EXPECT_TRUE(std::isnan(ErrorBar().mean));
}

// Nothing of the cell is there to be wrong: all methods of one coarse cloth have one bar.
TEST(exact_error_bar, of_one_material_up_sampling_changes_no_bar)
{
  const homogenization::UnitCell cell = tests::cell_of(
    tests::square_lattice(0.01), 6, 6, {homogenization::isotropic("one", 1e6, 0.3, 5e-4, 1.)},
    tests::everywhere_the_same);
  const CellLadder ladder = ladder_of_cell(cell);
  const auto all          = bars(cell, ladder, "strip-1", 4, 4);
  EXPECT_NEAR(all.at("localized").mean / all.at("affine").mean, 1., 1e-6);
  EXPECT_NEAR(all.at("full").mean / all.at("full-micro").mean, 1., 1e-6);
  EXPECT_LT(all.at("full").mean, error_of(cell, ladder, "full", Load("strip-1"), 4, 0));
}

// Up-sampling centres chi by its mean over triangles of three nodes, P2 by its own: slip makes up
// for it, so that under each macro strain w + phi is zero at every vertex of a clamped edge. Slip
// of the opposite edge does not.
TEST(exact_cell_ladder, a_clamped_edge_stays_where_it_is_by_each_discretization)
{
  const homogenization::UnitCell cell = cell_named("three-stiffness");
  for (const DiscretizedCell &of : ladder_of_cell(cell))
  {
    const meshes::Chi chi = localization::anchored(of.cell, localization::Anchor::mean);
    for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
    {
      const auto fraction = [&](const int v)
      { return cell.lattice.fractional(cell.mesh.vertices.row(v))(meshes::axis_of_side(side)); };
      double low = 1e9, high = -1e9;
      for (int v = 0; v < cell.mesh.n_vertices(); ++v)
      {
        low  = std::min(low, fraction(v));
        high = std::max(high, fraction(v));
      }
      const auto moved = [&](const meshes::CellEdge &slipping)
      {
        double largest = 0.;
        for (int v = 0; v < cell.mesh.n_vertices(); ++v)
          if (std::abs(fraction(v) - (meshes::is_far_side(side) ? high : low)) < 1e-9)
            for (int k = 0; k < 6; ++k)
              largest = std::max(
                largest, std::abs(of.edges->sides[static_cast<std::size_t>(side)].clamped(v, k) +
                                  slipping.slip(k % 2, k / 2) - chi(v, k)));
        return largest / chi.cwiseAbs().maxCoeff();
      };
      // Two solvers, which leave 1e-11 of the forces, times 1e4 for the condition of a cell.
      EXPECT_LT(moved(of.edges->sides[static_cast<std::size_t>(side)]), 1e-7) << side;
      EXPECT_GT(moved(of.edges->sides[static_cast<std::size_t>(side ^ 1)]), 1e-3) << side;
    }
  }
}
