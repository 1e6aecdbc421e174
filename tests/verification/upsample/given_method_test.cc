// SPDX-License-Identifier: MIT
// A method on coarse positions that are given: where they are those of a study, the fine positions
// are its own to the bit; where nobody gave them slip, held edges stay where they are held.
#include "homogenization/edges/edge_layers.h"
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "localization/coarse_frames.h"
#include "localization/given_method.h"
#include "localization/upsampler.h"
#include "meshes/files/cell_file.h"
#include "tests/refusal.h"
#include "verification/method/coarse_model.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace homespun::verification
{
namespace
{
using localization::GivenCloth;
using localization::Panel;
using localization::Slip;

/// As `homespun homogenize` leaves it, read back from the file; with modes of no cell in the place
/// of fitted ones.
meshes::HomogenizedCell cell_of(const std::string &name, const bool is_fitted)
{
  const homogenization::UnitCell unit =
    homogenization::read_unit_cell(std::string(CELLS) + name + ".prm", MPI_COMM_WORLD);
  homogenization::HomogenizationOptions options;
  options.order                = 1;
  options.second_order         = {Law::biot};
  meshes::HomogenizedCell cell = homogenization::homogenized_cell(
    unit, homogenization::homogenize(unit, options, MPI_COMM_WORLD), "");
  cell.edges = homogenization::edges_of(unit, {});
  if (is_fitted)
  {
    meshes::FittedModes &fitted = cell.fitted["yarn"];
    fitted.low                  = Eigen::Vector3d::Constant(-0.1);
    fitted.high                 = Eigen::Vector3d::Constant(0.1);
    fitted.knees                = Eigen::Vector3d(0.02, 0.03, 0.5);
    fitted.modes                = cell.second_order.at("biot").chi;
    for (int j = 0; j < fitted.coefficients.size(); ++j)
      fitted.coefficients(j) = 0.01 * (j % 7 - 3);
    for (int j = 0; j < fitted.of_strain.size(); ++j)
      fitted.of_strain(j) = 0.02 * (j % 5 - 2);
  }
  const std::string file = testing::TempDir() + "homespun-given-method.h5";
  meshes::write_cell(cell, file);
  return meshes::read_cell(file);
}
} // namespace

TEST(exact_given_method, from_the_coarse_positions_of_a_study_come_its_fine_ones_to_the_bit)
{
  for (const Law law : {Law::biot, Law::yarn})
  {
    const meshes::HomogenizedCell cell = cell_of("three-stiffness", law == Law::yarn);
    const meshes::Sheet sheet          = meshes::tile(cell.mesh, cell.lattice, 4, 4);
    const CellModel known              = {cell, &*cell.edges,
                             law == Law::yarn ? &cell.fitted.at("yarn") : nullptr};
    const Load load("strip-1");
    std::vector<meshes::Points> all;
    for (const char *const name :
         {"affine+p2", "localized", "localized+modes", "localized+edges", "full-p2-cubic", "full"})
    {
      SCOPED_TRACE(name + (" " + name_of(law)));
      const Method method(name);
      const CoarseModel model(known, sheet, load, method, law);
      const CoarseState state = model.solve(0.03);
      const GivenCloth given  = {{"left", "right"}, Slip::of_cloth, {}};
      meshes::Points fine;
      localization::Upsampler<2, double>(cell, model.parts.space.grid.mesh, sheet,
                                         on_given(method, cell, given).options)
        .upsample(model.on_grid(state), fine);
      EXPECT_EQ(fine, model.upsample(state));
      for (const meshes::Points &other : all)
        EXPECT_GT((fine - other).cwiseAbs().maxCoeff(), 1e-9);
      all.push_back(fine);
    }
  }
}

TEST(bound_given_method, held_edges_stay_where_they_are_held)
{
  const meshes::HomogenizedCell cell = cell_of("layered", false);
  const meshes::Sheet sheet          = meshes::tile(cell.mesh, cell.lattice, 8, 8);
  const meshes::TriangleMesh rest = meshes::coarse_sheet(sheet.origin, cell.lattice.vectors, 8, 8);
  Eigen::Matrix2d F;
  F << 1.02, 0.03, 0., 0.99;
  const meshes::Points moved = rest.vertices * F.transpose();
  const auto fine_of =
    [&](const char *const method, const std::vector<std::string> &held, const Slip slip)
  {
    meshes::Points fine;
    localization::Upsampler<2, double>(cell, rest, sheet,
                                       on_given(Method(method), cell, {held, slip, {}}).options)
      .upsample(moved, fine);
    return fine;
  };
  const meshes::Points affine = fine_of("affine", {}, Slip::added);
  const double largest        = // of the fluctuation
    (fine_of("localized", {}, Slip::added) - affine).rowwise().norm().maxCoeff();
  for (const auto &[axis, held] : {std::pair(0, std::vector<std::string>{"left", "right"}),
                                   std::pair(1, std::vector<std::string>{"bottom", "top"})})
  {
    const auto farthest = [&](const Slip slip)
    {
      const meshes::Points fine = fine_of("localized+edges", held, slip);
      double distance           = 0.;
      for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
      {
        const Eigen::RowVector2d at = sheet.fraction(sheet.mesh.vertices.row(v));
        // In the middle of a held edge, where layers of free ones are gone.
        if (std::abs(at(axis) - 0.5) > 0.5 - 1e-9 && std::abs(at(1 - axis) - 0.5) < 0.13)
          distance = std::max(distance, (fine.row(v) - affine.row(v)).norm());
      }
      return distance / largest;
    };
    // Fields of an edge below a thousandth of the largest are not kept: those of the other three.
    EXPECT_LT(farthest(Slip::added), 3e-3) << axis;
    EXPECT_GT(farthest(Slip::of_cloth), 0.3) << axis; // the coarse cloth has none here
  }
}

TEST(exact_given_method, the_slip_of_one_held_edge_moves_the_whole_sheet_and_turns_with_the_edge)
{
  const meshes::HomogenizedCell cell = cell_of("layered", false);
  const meshes::Sheet sheet          = meshes::tile(cell.mesh, cell.lattice, 4, 8);
  const meshes::TriangleMesh rest = meshes::coarse_sheet(sheet.origin, cell.lattice.vectors, 4, 8);
  const double height             = sheet.sides()(1, 1);
  // Strain grows from the bottom, which is held, to ten times as much at the top.
  meshes::Points moved = rest.vertices;
  for (int v = 0; v < rest.n_vertices(); ++v)
  {
    const double y = sheet.fraction(rest.vertices.row(v))(1);
    moved(v, 1) += height * (0.002 * y + 0.009 * y * y);
    moved(v, 0) += height * (0.004 * y + 0.018 * y * y);
  }
  const Eigen::Rotation2Dd turn(1.2);
  const auto slip_of = [&](const meshes::Points &positions, const char *const method)
  {
    const Method of(method);
    std::array<meshes::Points, 2> fine;
    for (const Slip slip : {Slip::added, Slip::of_cloth})
      localization::Upsampler<2, double>(cell, rest, sheet,
                                         on_given(of, cell, {{"bottom"}, slip, {}}).options)
        .upsample(positions, fine[slip == Slip::added ? 0 : 1]);
    return meshes::Points(fine[0] - fine[1]);
  };
  const meshes::Points slip = slip_of(moved, "localized+edges"),
                       turned =
                         slip_of(moved * turn.toRotationMatrix().transpose(), "localized+edges");
  localization::CoarseFrames<2> frames(rest, localization::Method("localized").options(Law::biot));
  const Eigen::Vector3d E = frames.values(moved).row(2).head<3>(); // of the edge, away from corners
  Eigen::Matrix2d L;
  L << frames.values(moved)(2, 3), frames.values(moved)(2, 4), frames.values(moved)(2, 5),
    frames.values(moved)(2, 6);
  const Eigen::RowVector2d expected = (L * (cell.edges->sides[2].slip * E)).transpose();
  ASSERT_GT(expected.norm(), 1e-7 * height);
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    EXPECT_LT((slip.row(v) - expected).norm(), 1e-9 * expected.norm()) << v;
    EXPECT_LT((turned.row(v) - (turn * expected.transpose()).transpose()).norm(),
              1e-9 * expected.norm())
      << v;
  }
}

TEST(tripwire_given_method, what_has_no_meaning_is_said_and_what_is_missing_refused)
{
  meshes::HomogenizedCell cell = cell_of("layered", false);
  const std::string no_curve =
    "curved is left out, because the cell has no deflection of a bent sheet";
  const auto left_out = [&](const char *const method, const std::vector<std::string> &held,
                            const std::vector<Panel> &panels = {}) {
    return on_given(Method(method), cell, {held, Slip::added, panels}).left_out;
  };
  EXPECT_EQ(left_out("localized+modes", {}), "");
  EXPECT_EQ(left_out("full-p2-cubic", {"none"}), "method full-p2-cubic: " + no_curve);
  EXPECT_EQ(left_out("full-p2", {"none"}),
            "method full-p2: cubic belongs to the coarse cloth, which is yours; " + no_curve);
  EXPECT_EQ(left_out("affine+curved", {}), ""); // of the coarse cloth alone
  // Without the deflection all is as without the term.
  EXPECT_EQ(on_given(Method("full"), cell, {{"top"}, Slip::added, {}}).options.surface,
            localization::Surface::flat);
  cell.bending.emplace();
  EXPECT_EQ(on_given(Method("full"), cell, {{"top"}, Slip::added, {}}).options.surface,
            localization::Surface::curved);
  EXPECT_EQ(left_out("full-p2-cubic", {"none"}), "");
  EXPECT_EQ(left_out("full", {"top"}),
            "method full: p2 and cubic belong to the coarse cloth, which is yours");
  EXPECT_EQ(
    left_out("full-p2", {}),
    "method full-p2: cubic belongs to the coarse cloth, which is yours; edges are left out, "
    "because `held` does not say which edges on lattice lines are held: left, right, bottom, "
    "top, or none");
  // Panels, of which one has no edge on a lattice line, two have some, and in all two kinds.
  std::vector<Panel> panels(3);
  for (Panel &panel : panels)
    panel.length = 1.;
  EXPECT_EQ(left_out("full-p2-cubic", {"top"}, panels),
            "method full-p2-cubic: edges are left out, because no edge of a panel that is not sewn "
            "lies on a lattice line of its cells");
  panels[0].edges       = {{0, 2, {0., 4.}, {}}, {3, 4, {2., 4.}, {}}, {3, 4, {5., 6.}, {}}};
  panels[2].edges       = {{3, 7, {0., 4.}, {}}};
  panels[0].edge_length = 0.5;
  panels[2].edge_length = 0.25;
  panels[1].sewn_length = 0.6;
  const std::string layers =
    "method full-p2-cubic: edges have layers at left (free) of panel 0; top (held) of panel 0, 2; "
    "none along the 20 % of the outlines that are sewn and the 55 % that lie on no lattice line";
  EXPECT_EQ(left_out("full-p2-cubic", {"top"}, panels), layers);
  EXPECT_EQ(left_out("full-p2-cubic", {"top", "right"}, panels),
            layers + "; no edge on a lattice line is `right`, which is held");
  panels[0].edge_length = panels[1].edge_length = panels[2].edge_length = 1.;
  panels[1].sewn_length                                                 = 0.;
  EXPECT_EQ(left_out("full-p2-cubic", {"top"}, panels), ""); // there is nothing without

  meshes::HomogenizedCell old = cell;
  old.bending.reset();
  const auto refused = [&](const char *const method, const std::vector<std::string> &held)
  {
    return tests::refusal(
      [&]()
      {
        const auto given = on_given(Method(method), old, {held, Slip::added, {}});
        localization::anchored_quadratic(old, given.options.second_order, given.options.anchor);
      });
  };
  EXPECT_NE(refused("affine+modes", {}).find("expected localized+modes"), std::string::npos);
  EXPECT_NE(refused("localized+edges", {}).find("there are no terms of edges, because `held`"),
            std::string::npos);
  EXPECT_NE(refused("localized+curved", {}).find("the cell has no deflection of a bent sheet"),
            std::string::npos);
  EXPECT_NE(refused("full", {"upper"}).find("held: found `upper`; expected"), std::string::npos);
  EXPECT_NE(refused("full", {"none", "top"}).find("held: found `none`"), std::string::npos);
  old.edges.reset();
  EXPECT_NE(refused("full", {"top"})
              .find("has no terms of edges: make its cell.h5 again with "
                    "`homespun homogenize`"),
            std::string::npos);
  const std::string cure = refused("localized+edges", {"top"});
  EXPECT_EQ(cure.substr(cure.rfind(' ') + 1), "localized");
  EXPECT_NE(refused("full", {"top"}).find("as in full-edges"), std::string::npos);
  old.second_order.clear();
  EXPECT_NE(refused("full-edges", {})
              .find("no quadratic modes under the law `biot`; found none: "
                    "make its cell.h5 again with `homespun homogenize`"),
            std::string::npos);
}
} // namespace homespun::verification
