// SPDX-License-Identifier: MIT
// The Bloch margin: at rest, of the same cloth cut otherwise, in the limit of long waves, against
// the dense spectra of supercells, and published values.
#include "meshes/plain/errors.h"
#include "meshes/plain/symmetric_eigen.h"
#include "tests/verification/periodic/bloch_cell.h"

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace homespun;
using namespace homespun::verification;
using homespun::tests::BlochCell;
using homespun::tests::isotropic;
using homespun::tests::path_along;

namespace
{
/// n x n squares on a parallelogram of no symmetry, stiff ones among soft ones.
BlochCell skew_cell(const int n)
{
  meshes::Lattice lattice;
  lattice.vectors << 1., 0.15, 0.35, 0.8;
  meshes::TriangleMesh mesh;
  mesh.vertices.resize((n + 1) * (n + 1), 2);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.vertices.row(j * (n + 1) + i) =
        Eigen::RowVector2d(i, j) / static_cast<double>(n) * lattice.vectors;
  mesh.triangles.resize(2 * n * n, 3);
  mesh.material.setZero(2 * n * n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      const int corner = j * (n + 1) + i, t = 2 * (j * n + i);
      mesh.triangles.row(t) << corner, corner + 1, corner + n + 2;
      mesh.triangles.row(t + 1) << corner, corner + n + 2, corner + n + 1;
      if (j == 1 || (i == 0 && j == 2))
        mesh.material.segment<2>(t).setOnes();
    }
  return {mesh, lattice, {isotropic(100., 0.3), isotropic(3000., 0.2)}};
}

/// The least eigenvalue of a cell whose fields are periodic on it, dense; from the matrices of
/// Newton's method, which know nothing of waves.
double dense_least(const BlochCell &cell, const std::string &load, const double strain,
                   const Law law)
{
  const CellAssembly assembly = cell.assembly(law);
  PeriodicPath path           = path_along(assembly, load);
  const auto matrix           = [&](const CellEquilibrium &state)
  {
    return Eigen::MatrixXd(assembly.sums(state.gradient, state.fluctuation, Tangent::exact).matrix);
  };
  const Eigen::MatrixXd rest = matrix(path.at(0.)), there = matrix(path.at(strain));
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(there, rest,
                                                                   Eigen::EigenvaluesOnly)
    .eigenvalues()(0);
}

/// The wave whose phase grows by kappa n.y: k_i = kappa n.a_i / (2 pi).
/// @param kappa [1/m]
Wave wave_along(const meshes::Lattice &lattice, const double angle, const double kappa)
{
  const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d k = kappa / (2. * M_PI) * lattice.vectors * n;
  return bloch_wave(k(0), k(1));
}

/// A cell in a state.
struct Loaded
{
  Loaded(const BlochCell &cell, const std::string &load, const double strain,
         const Law law = Law::biot)
      : bloch(cell.assembly(law))
      , path(path_along(bloch.assembly, load))
      , state(path.at(strain))
  {
  }

  double beta(const Wave &wave) const
  {
    return bloch.of(state, {wave}).beta;
  }

  const BlochMargin bloch;
  PeriodicPath path;
  const CellEquilibrium state;
};

/// The same cloth turned by a right angle.
BlochCell turned(BlochCell cell)
{
  const auto turn = [](auto &rows)
  {
    const Eigen::VectorXd x = rows.col(0);
    rows.col(0)             = -rows.col(1);
    rows.col(1)             = x;
  };
  turn(cell.cell.mesh.vertices);
  turn(cell.cell.lattice.vectors);
  return cell;
}

/// The same cloth, cut half a cell further along both lattice vectors.
BlochCell shifted(const BlochCell &cell)
{
  const BlochCell four    = cell.tiled(2, 2);
  const meshes::Points &x = four.cell.mesh.vertices;
  std::vector<int> triangles, vertices, number(static_cast<std::size_t>(x.rows()), -1);
  const auto part = [&](const Eigen::RowVector2d &point, const int a) {
    return cell.cell.lattice.fractional(point - cell.cell.mesh.vertices.row(cell.cell.anchor))(a);
  };
  for (int t = 0; t < four.cell.mesh.n_triangles(); ++t)
  {
    Eigen::RowVector2d centre = Eigen::RowVector2d::Zero();
    for (int k = 0; k < 3; ++k)
      centre += x.row(four.cell.mesh.triangles(t, k)) / 3.;
    if (part(centre, 0) > 0.5 && part(centre, 0) < 1.5 && part(centre, 1) > 0.5 &&
        part(centre, 1) < 1.5)
      triangles.push_back(t);
  }
  meshes::TriangleMesh mesh;
  mesh.triangles.resize(static_cast<long>(triangles.size()), 3);
  mesh.material.resize(static_cast<long>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    mesh.material(static_cast<long>(t)) = four.cell.mesh.material(triangles[t]);
    for (int k = 0; k < 3; ++k)
    {
      const int v = four.cell.mesh.triangles(triangles[t], k);
      int &place  = number[static_cast<std::size_t>(v)];
      if (place < 0)
      {
        place = static_cast<int>(vertices.size());
        vertices.push_back(v);
      }
      mesh.triangles(static_cast<long>(t), k) = place;
    }
  }
  mesh.vertices.resize(static_cast<long>(vertices.size()), 2);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    mesh.vertices.row(static_cast<long>(v)) = x.row(vertices[v]);
  return {mesh, cell.cell.lattice, cell.phases};
}
} // namespace

TEST(exact_bloch, the_margin_at_rest_is_one_for_every_shipped_cell)
{
  for (const char *name :
       {"auxetic", "checkerboard", "chevron", "hexagonal-dots", "honeycomb", "layered",
        "plain-weave", "printed-patch", "random-dots", "satin", "three-stiffness", "twill"})
  {
    const Loaded rest(BlochCell(name), "periodic-11", 0.);
    const Margin margin = rest.bloch.of(rest.state);
    EXPECT_NEAR(margin.beta, 1., 1e-10) << name;
    // Twice the closeness of the two sides, which is that of 1 + beta.
    EXPECT_NEAR(margin.lower, 1., 3e-9) << name;
  }
}

// Both were found by other programs before: `layered` by two, `honeycomb` by one.
TEST(exact_bloch, layered_and_honeycomb_have_the_published_margins)
{
  Loaded layered(BlochCell("layered"), "periodic-11", -0.01);
  for (const auto &[strain, beta] :
       {std::pair(-0.01, 0.9297), {-0.05, 0.6429}, {-0.1, 0.2719}, {-0.2, -0.5157}})
  {
    const Margin margin = layered.bloch.of(layered.path.at(strain));
    EXPECT_NEAR(margin.beta, beta, 1e-3);
    EXPECT_EQ(margin.wave.text(), "long, at 0 degrees from axis 1");
    EXPECT_LE(margin.lower, margin.beta);
    EXPECT_GE(margin.lower, margin.beta - 1e-8);
  }
  Loaded honeycomb(BlochCell("honeycomb"), "uniaxial-1", -0.01);
  for (const auto &[strain, beta] :
       {std::pair(-0.01, 0.929), {-0.03, 0.793}, {-0.05, 0.664}, {-0.08, 0.488}, {-0.12, 0.285}})
  {
    const Margin margin = honeycomb.bloch.of(honeycomb.path.at(strain));
    EXPECT_NEAR(margin.beta, beta, 1e-3);
    EXPECT_EQ(margin.wave.text(), "k = (1/2, 1/2)");
    EXPECT_EQ(supercell_of(margin.wave, 4), Eigen::Vector2i(2, 2));
  }
}

// A supercell of n1 x n2 cells knows the waves k = (i / n1, j / n2), and no others.
TEST(exact_bloch, waves_have_the_dense_spectra_of_supercells)
{
  const BlochCell cell = skew_cell(4);
  for (const auto &[name, strain] : {std::pair("uniaxial-2", -0.12), {"periodic-12", 0.3}})
  {
    const Loaded loaded(cell, name, strain);
    const double alone = dense_least(cell, name, strain, Law::biot);
    for (const auto &[n1, n2] : {std::pair(2, 1), {1, 2}, {3, 1}, {1, 3}, {2, 3}, {4, 1}})
    {
      double least = alone;
      for (int i = 0; i < n1; ++i)
        for (int j = 0; j < n2; ++j)
          if (i + j > 0)
            least = std::min(least, loaded.beta(bloch_wave(static_cast<double>(i) / n1,
                                                           static_cast<double>(j) / n2)));
      EXPECT_NEAR(dense_least(cell.tiled(n1, n2), name, strain, Law::biot), least, 1e-8)
        << n1 << " x " << n2 << ", " << name;
    }
    // Three cells in a row that repeat along 3 a1 and a1 + a2 know k = (1/3, 2/3) alone, not (1/3,
    // 1/3): the signs of both phases.
    BlochCell row = cell.tiled(3, 1);
    row.cell.lattice.vectors.row(1) += cell.cell.lattice.vectors.row(0);
    row.cell.anchor = 0;
    EXPECT_NEAR(dense_least(row, name, strain, Law::biot),
                std::min(alone, loaded.beta(bloch_wave(1. / 3., 2. / 3.))), 1e-8);
  }
}

TEST(invariant_bloch, reciprocal_vectors_and_the_sign_of_k_change_nothing)
{
  const Loaded loaded(skew_cell(4), "uniaxial-2", -0.1);
  const double beta = loaded.beta(bloch_wave(0.3, 0.2));
  for (const auto &[k1, k2] : {std::pair(1.3, 0.2), {0.3, -1.8}, {-2.7, 3.2}, {-0.3, -0.2}})
    EXPECT_NEAR(loaded.beta(bloch_wave(k1, k2)), beta, 1e-8);
  EXPECT_GT(std::abs(loaded.beta(bloch_wave(-0.3, 0.2)) - beta), 1e-4);
}

TEST(invariant_bloch, the_margin_is_that_of_the_cloth_however_it_is_cut)
{
  const BlochCell cell = skew_cell(4);
  const Loaded one(cell, "uniaxial-2", -0.1);
  const Wave wave      = bloch_wave(0.3, 0.2);
  const double beta    = one.beta(wave);
  const double of_long = one.beta(long_wave(0.4));
  for (const auto &[n1, n2] : {std::pair(2, 1), {1, 2}})
  {
    const Loaded doubled(cell.tiled(n1, n2), "uniaxial-2", -0.1);
    // A wave of the double cell is two waves of the single one.
    const Wave other = bloch_wave(0.3 + 0.5 * (n1 - 1), 0.2 + 0.5 * (n2 - 1));
    EXPECT_NEAR(doubled.beta(bloch_wave(n1 * 0.3, n2 * 0.2)), std::min(beta, one.beta(other)),
                1e-8);
    EXPECT_NEAR(doubled.bloch.of(doubled.state).beta, one.bloch.of(one.state).beta, 1e-8);
  }
  const Loaded moved(shifted(cell), "uniaxial-2", -0.1);
  EXPECT_NEAR(moved.beta(wave), beta, 1e-8);
  EXPECT_NEAR(moved.beta(long_wave(0.4)), of_long, 1e-8);
  const Loaded round(turned(cell), "uniaxial-1", -0.1);
  EXPECT_NEAR(round.beta(wave), beta, 1e-8);
  EXPECT_NEAR(round.beta(long_wave(0.4 + 0.5 * M_PI)), of_long, 1e-8);
}

// The quotient is even in k: its distance from the limit is a multiple of |k|^2.
TEST(order_bloch, waves_that_grow_come_to_the_limit_of_long_ones)
{
  for (const auto &[cell, name, strain] : {std::tuple(skew_cell(4), "uniaxial-2", -0.1),
                                           {BlochCell("honeycomb"), "uniaxial-1", -0.08}})
  {
    const Loaded loaded(cell, name, strain);
    const double size = std::sqrt(cell.cell.lattice.area());
    for (const double angle : {0.2, 1.1, 2.5})
    {
      const double limit = loaded.beta(long_wave(angle));
      const auto miss    = [&](const double part) {
        return loaded.beta(wave_along(cell.cell.lattice, angle, 2. * M_PI * part / size)) - limit;
      };
      EXPECT_NEAR(std::log2(miss(0.04) / miss(0.02)), 2., 0.1) << name << ", " << angle;
    }
  }
}

TEST(exact_bloch, the_limit_of_long_waves_has_the_sign_of_the_acoustic_tensor)
{
  int n_negative = 0, n_positive = 0;
  for (const auto &[name, load, strain] : {std::tuple("layered", "periodic-11", -0.1),
                                           {"layered", "periodic-11", -0.2},
                                           {"chevron", "periodic-22", -0.3},
                                           {"chevron", "uniaxial-1", 0.1}})
  {
    const Loaded loaded(BlochCell(name), load, strain);
    const Eigen::Matrix4d tangent = macro_tangent(loaded.bloch.assembly, loaded.state);
    ASSERT_TRUE(tangent.allFinite()) << name << ", " << strain;
    for (int j = 0; j < 12; ++j)
    {
      const double angle = M_PI * j / 12.;
      const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
      Eigen::Matrix<double, 4, 2> along; // a n^T in the order 11, 12, 21, 22
      along << n(0), 0., n(1), 0., 0., n(0), 0., n(1);
      const double acoustic =
        meshes::symmetric_eigen<2>(along.transpose() * tangent * along).values(0);
      const double beta = loaded.beta(long_wave(angle));
      EXPECT_EQ(beta > 0., acoustic > 0.) << name << ", " << angle << ": " << beta;
      ++(acoustic > 0. ? n_positive : n_negative);
    }
  }
  EXPECT_GT(n_negative, 0);
  EXPECT_GT(n_positive, 0);
}

TEST(tripwire_bloch, the_certificate_tells_what_is_a_millionth_above_from_what_is_below)
{
  const BlochCell cell = skew_cell(4);
  const Loaded loaded(cell, "uniaxial-2", -0.12);
  // Of the waves of a 1 x 2 cell, k = (0, 1/2) is the lower one.
  const double least = dense_least(cell.tiled(1, 2), "uniaxial-2", -0.12, Law::biot);
  ASSERT_LT(least, dense_least(cell, "uniaxial-2", -0.12, Law::biot) - 1e-3);
  MarginSearch search = loaded.bloch.search(loaded.state);
  EXPECT_TRUE(search.is_above(bloch_wave(0., 0.5), least - 1e-6));
  EXPECT_FALSE(search.is_above(bloch_wave(0., 0.5), least + 1e-6));
  EXPECT_FALSE(search.is_above(bloch_wave(0., 0.5), 1e3)); // fields inside the cell are below too
}

TEST(tripwire_bloch, loads_of_sheets_are_refused)
{
  EXPECT_THROW(load_control(Load("strip-1")), meshes::BadInput);
}
