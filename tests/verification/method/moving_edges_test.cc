// SPDX-License-Identifier: MIT
// Terms of edges in a moving cloth: where it comes to rest is the static method `edges`.
#include "homogenization/edges/edge_layers.h"
#include "homogenization/lint/cell_reading.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/drape/draped_cell.h"
#include "verification/method/coarse_model.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace homespun;
using namespace homespun::verification;

namespace
{
homogenization::UnitCell layers(const std::vector<homogenization::Phase> &phases)
{
  return tests::cell_of(tests::square_lattice(0.01), 4, 4, phases, tests::halves);
}

/// Two edges of n x n cells pulled apart by a strain, slowly enough to be at rest in the end.
Scene pulled(const int n, const double strain, const double side, const int axis)
{
  Scene scene;
  scene.n1 = scene.n2 = n;
  scene.terms         = {"membrane", "damping", "pins", "handles", "selvedge"};
  scene.standing      = false;
  scene.damping_rate  = 40.;
  scene.time_step     = 0.02;
  HeldPlace bottom, top;
  bottom.place           = axis == 0 ? "left" : "bottom";
  top.place              = axis == 0 ? "right" : "top";
  top.motion.kind        = Motion::Kind::translate;
  top.motion.along(axis) = strain * side * n;
  top.motion.seconds     = 1.;
  scene.held             = {bottom, top};
  return scene;
}

struct Pulled
{
  Pulled(const homogenization::UnitCell &cell, const int n, const double strain, const int axis = 1)
      : homogenized(homogenization::homogenized_cell(cell, tests::solved(cell), "test"))
      , edges(homogenization::edges_of(cell, {}))
      , draped(pulled(n, strain, std::sqrt(cell.lattice.area()), axis), cell, homogenized,
               Law::biot, edges)
  {
  }

  SceneCloth cloth(const char *method) const
  {
    return {draped.scene, draped.coarse, draped.effective_of(Method(method)),
            draped.coarse_motion()};
  }

  /// In the plane of the sheet.
  meshes::Points upsampled(const char *method, const shell::Vectors &positions) const
  {
    Upsampler3d::Fine fine;
    draped.upsampler<double>(Method(method)).upsample(positions, fine);
    return fine.leftCols<2>();
  }

  const meshes::HomogenizedCell homogenized;
  const meshes::CellEdges edges;
  const DrapedCell draped;
};

/// Moves the centre of the sheet to where the other has it.
double mean_distance(meshes::Points a, const meshes::Points &b)
{
  a.rowwise() += b.colwise().mean() - a.colwise().mean();
  return (a - b).rowwise().norm().mean();
}
} // namespace

namespace
{
meshes::HomogenizedCell of_second_order(const homogenization::UnitCell &cell)
{
  homogenization::HomogenizationOptions options;
  options.tolerance    = 1e-12;
  options.second_order = {meshes::Law::biot};
  return homogenization::homogenized_cell(
    cell, homogenization::homogenize(cell, options, MPI_COMM_SELF), "test");
}

/// A pull along an axis with some of the terms, and the fixed point of those of the static method:
/// that takes strains without the terms, the moving cloth those with them.
struct BothWays
{
  /// @param n cells, and coarse quads, per side
  /// @param method with terms of edges
  BothWays(const homogenization::UnitCell &cell, const int axis, const meshes::CellEdges &edges,
           const int n = 6, const Method &method = Method("localized+edges"))
      : homogenized(of_second_order(cell))
      , strain_side(strain * std::sqrt(cell.lattice.area()))
      , draped(pulled(n, strain, std::sqrt(cell.lattice.area()), axis), cell, homogenized,
               Law::biot, edges)
      , moving(draped.scene, draped.coarse, draped.effective_of(method), draped.coarse_motion())
  {
    const Load load(axis == 0 ? "strip-1" : "strip-2");
    without =
      CoarseModel({homogenized}, *draped.sheet, load, method, Law::biot).solve(strain).positions;
    const CoarseParts<2> parts({homogenized, &edges}, *draped.sheet, method, Law::biot,
                               edge_kinds(load));
    const auto solver =
      parts.space.solver(homogenized.stiffness, Law::biot,
                         draped.coarse_motion().vertices(draped.coarse), parts.cubic);
    fixed_point = without;
    for (int k = 0; k < 15; ++k)
      fixed_point =
        solver->solve(without + parts.edges->slip(fixed_point), parts.edges->forces(fixed_point))
          .positions;
  }

  /// The scene begins with its sheet around the origin.
  meshes::Points moved() const
  {
    meshes::Points positions = moving.cloth().positions().leftCols<2>();
    positions.rowwise() +=
      draped.coarse.rest.vertices.row(0) - draped.coarse.positions.row(0).head<2>();
    return positions;
  }

  static constexpr double strain = 0.01;
  const meshes::HomogenizedCell homogenized;
  const double strain_side;
  const DrapedCell draped;
  SceneCloth moving;
  meshes::Points without, fixed_point;
};
} // namespace

TEST(exact_moving_edges, slip_and_strain_gradients_of_a_slow_pull_end_in_those_of_the_static_method)
{
  for (const homogenization::UnitCell &cell :
       {layers(tests::soft_and_hard()),
        homogenization::read_unit_cell(CELLS "three-stiffness.prm")})
    for (const int axis : {0, 1})
    {
      meshes::CellEdges edges = homogenization::edges_of(cell, {});
      for (meshes::CellEdge &edge : edges.sides)
        edge.tension.setZero();
      BothWays ways(cell, axis, edges);
      ways.moving.solve_equilibrium(3.);
      const std::string name = cell.name + ", axis " + std::to_string(axis + 1);
      EXPECT_GT(mean_distance(ways.without, ways.fixed_point), 1e-3 * ways.strain_side) << name;
      EXPECT_LT((ways.moved() - ways.fixed_point).cwiseAbs().maxCoeff(), 1e-5 * ways.strain_side)
        << name;
      // In motion the terms lag by a step, and the cloth swings for a while.
      SceneCloth slow(ways.draped.scene, ways.draped.coarse,
                      ways.draped.effective_of(Method("localized+edges")),
                      ways.draped.coarse_motion());
      for (int k = 0; k < 150; ++k)
        slow.step(ways.draped.scene.time_step);
      EXPECT_LT((slow.cloth().positions() - ways.moving.cloth().positions()).cwiseAbs().maxCoeff(),
                1e-3 * ways.strain_side)
        << name;
    }
}

// The same of triangles with six nodes and the cubic energy, which the fine positions show too.
TEST(exact_moving_edges, full_comes_to_rest_where_the_static_method_does)
{
  const homogenization::UnitCell cell = homogenization::read_unit_cell(CELLS "three-stiffness.prm");
  const Method full("full-curved");
  for (const int axis : {0, 1})
  {
    meshes::CellEdges edges = homogenization::edges_of(cell, {});
    for (meshes::CellEdge &edge : edges.sides)
      edge.tension.setZero();
    BothWays ways(cell, axis, edges, 6, full);
    ways.moving.solve_equilibrium(3.);
    EXPECT_GT(mean_distance(ways.without, ways.fixed_point), 1e-3 * ways.strain_side) << axis;
    EXPECT_LT((ways.moved() - ways.fixed_point).cwiseAbs().maxCoeff(), 1e-5 * ways.strain_side)
      << axis;
    // Six-node triangles are not the three-node ones of the same nodes.
    const BothWays of_three(cell, axis, edges);
    EXPECT_GT(mean_distance(ways.fixed_point, of_three.fixed_point), 1e-3 * ways.strain_side)
      << axis;

    const CoarseSpace space(*ways.draped.sheet, CoarseElement::six_nodes);
    const localization::UpsamplerOptions options =
      options_of(full, Law::biot, {ways.homogenized, &edges},
                 edge_kinds(Load(axis == 0 ? "strip-1" : "strip-2")));
    localization::Upsampler<2, double>::Fine in_plane;
    localization::Upsampler<2, double>(ways.homogenized, space.grid.mesh, *ways.draped.sheet,
                                       options)
      .upsample(space.on_grid<2>(ways.moved()), in_plane);
    Upsampler3d::Fine in_space;
    ways.draped.upsampler<double>(full).upsample(ways.moving.cloth().positions(), in_space);
    EXPECT_LT(mean_distance(in_space.leftCols<2>(), in_plane), 1e-6 * ways.strain_side) << axis;
  }
}

// The cable takes the strain of the edge, the static method that of the triangles around it: two
// discretizations of one tension, which meet where coarse triangles are small beside the sheet. The
// limit of their distance by Aitken's extrapolation is zero within the last change of it.
TEST(order_moving_edges, the_cable_and_the_static_tension_meet_on_fine_meshes)
{
  for (const homogenization::UnitCell &cell :
       {layers(tests::soft_and_hard()),
        homogenization::read_unit_cell(CELLS "three-stiffness.prm")})
  {
    meshes::CellEdges edges = homogenization::edges_of(cell, {});
    for (meshes::CellEdge &edge : edges.sides)
      edge.slip.setZero();
    edges.bulk = {Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
    std::vector<double> apart; // distance over what the cable does
    for (const int n : {12, 24, 48})
    {
      BothWays ways(cell, 0, edges, n);
      ways.moving.solve_equilibrium(3.);
      const meshes::Points moved = ways.moved();
      apart.push_back((moved - ways.fixed_point).rowwise().norm().mean() /
                      (moved - ways.without).rowwise().norm().mean());
    }
    EXPECT_LT(apart[1], apart[0]) << cell.name;
    EXPECT_LT(apart[2], apart[1]) << cell.name;
    const double limit =
      (apart[0] * apart[2] - apart[1] * apart[1]) / (apart[0] + apart[2] - 2. * apart[1]);
    EXPECT_LT(std::abs(limit), apart[1] - apart[2])
      << cell.name << ": " << apart[0] << ", " << apart[1] << ", " << apart[2];
  }
}

TEST(exact_moving_edges, a_cell_of_one_phase_moves_as_without_them)
{
  std::vector<homogenization::Phase> phases = tests::soft_and_hard();
  phases[1]                                 = phases[0];
  const Pulled sheet(layers(phases), 3, 0.05);
  SceneCloth with = sheet.cloth("localized+edges"), without = sheet.cloth("localized");
  for (int k = 0; k < 10; ++k)
  {
    with.step(0.02);
    without.step(0.02);
  }
  EXPECT_LT((with.cloth().positions() - without.cloth().positions()).cwiseAbs().maxCoeff(),
            1e-12 * 0.03);
  EXPECT_LT((sheet.upsampled("localized+edges", with.cloth().positions()) -
             sheet.upsampled("localized", without.cloth().positions()))
              .cwiseAbs()
              .maxCoeff(),
            1e-12 * 0.03);
}

// kappa = (E_h − E_s) t eps (1/8 − s/2) of stripes, s eps the soft layer outside: the shipped cut
// has a full soft stripe below, s = ½, and a full hard one above, s = 0.
TEST(exact_moving_edges, stripes_have_the_selvedge_that_theory_says)
{
  const homogenization::UnitCell cell = layers(tests::soft_and_hard());
  const meshes::CellEdges edges       = homogenization::edges_of(cell, {});
  const auto homogenized = homogenization::homogenized_cell(cell, tests::solved(cell), "test");
  const auto C           = cell.stiffness_of_phase();
  const auto youngs      = [](const Eigen::Matrix3d &of) { return 1. / of.inverse()(0, 0); };
  const double range     = (youngs(C[1]) - youngs(C[0])) * 0.01;
  const auto kappa       = [&](const std::size_t side) {
    return shell::selvedge_stiffness(edges.sides[side].tension, homogenized.stiffness, {1., 0.});
  };
  EXPECT_NEAR(kappa(2), -range / 8., 1e-9 * range);
  EXPECT_NEAR(kappa(3), range / 8., 1e-9 * range);
}

TEST(invariant_moving_edges, edges_of_a_scene_are_clamped_free_or_neither)
{
  const homogenization::UnitCell cell = layers(tests::soft_and_hard());
  const meshes::CellEdges edges       = homogenization::edges_of(cell, {});
  const auto homogenized = homogenization::homogenized_cell(cell, tests::solved(cell), "test");
  const auto sheet       = meshes::tile(cell.mesh, cell.lattice, 3, 3);
  // The lower edge and one vertex within the upper one.
  const CoarseSpace space(sheet, CoarseElement::three_nodes);
  const EdgeKinds kinds = edge_kinds(space.nodes.quads, {0, 1, 2, 3, 13});
  EXPECT_EQ(sentence_of_edges(kinds),
            "terms of edges: clamped, with slip and modes: axis 2, near end; free, with tension "
            "and modes: axis 1, near end and axis 1, far end; held in part, without terms: axis 2, "
            "far end");
  EXPECT_EQ(EdgeTerms<3>({homogenized, &edges}, sheet, space, kinds, Law::biot).selvedges().size(),
            6u);
}
