// SPDX-License-Identifier: MIT
#include "verification/periodic/bloch_pencil.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/lattice.h"

#include <cmath>

namespace homespun::verification
{
namespace
{
/// Rows and columns of vertices out of a matrix of two components a vertex.
CellAssembly::Sparse block(const CellAssembly::Sparse &matrix, const std::vector<int> &rows,
                           const std::vector<int> &columns)
{
  std::vector<int> row_of(static_cast<std::size_t>(matrix.rows()), -1);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (int c = 0; c < 2; ++c)
      row_of[static_cast<std::size_t>(2 * rows[k] + c)] = 2 * static_cast<int>(k) + c;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (int c = 0; c < 2; ++c)
      for (CellAssembly::Sparse::InnerIterator entry(matrix, 2 * columns[k] + c); entry; ++entry)
        if (const int row = row_of[static_cast<std::size_t>(entry.row())]; row >= 0)
          entries.emplace_back(row, 2 * static_cast<int>(k) + c, entry.value());
  CellAssembly::Sparse result(2 * static_cast<long>(rows.size()),
                              2 * static_cast<long>(columns.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}
} // namespace

BlochPencil::BlochPencil(const meshes::HomogenizedCell &cell, const Sparse &at_rest)
    : at_rest(at_rest)
{
  const meshes::ImageClasses classes = meshes::match_images(cell.mesh.vertices, cell.lattice);
  const auto of                      = [](const int v) { return static_cast<std::size_t>(v); };
  std::vector<int> number(of(cell.mesh.n_vertices()), -1); // of masters
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    if (classes.size[of(v)] == 1)
      inner.push_back(v);
    else
    {
      outer.push_back(v);
      const int representative = classes.representative[of(v)]; // the lowest index comes first
      if (representative == v)
        number[of(v)] = n_masters++;
      master.push_back(number[of(representative)]);
    }
  anchor_master = number[of(classes.representative[of(cell.anchor)])];
  offset.resize(static_cast<long>(outer.size()), 2);
  place.resize(static_cast<long>(outer.size()), 2);
  for (std::size_t k = 0; k < outer.size(); ++k)
  {
    offset.row(static_cast<long>(k)) = classes.offset.row(outer[k]);
    place.row(static_cast<long>(k)) =
      (cell.mesh.vertices.row(outer[k]) - cell.mesh.vertices.row(cell.anchor)) /
      std::sqrt(cell.lattice.area());
  }
  rest            = split(at_rest);
  rest_eliminated = shifted(rest, 0.);
  if (!rest_eliminated)
    throw meshes::NotConverged(
      "Bloch waves: the stiffness at rest is not positive definite, the outline held", {});
}

SplitStiffness BlochPencil::split(const Sparse &stiffness) const
{
  return {block(stiffness, inner, inner), block(stiffness, inner, outer),
          Eigen::MatrixXd(block(stiffness, outer, outer))};
}

BlochPencil::Ties BlochPencil::ties(const Wave &wave) const
{
  const bool is_long = wave.is_long();
  const Eigen::Vector2d n(std::cos(wave.angle), std::sin(wave.angle));
  // Of a long wave the anchor is held, and two columns at the end are a (n.y).
  const auto column_of = [&](const int number)
  { return 2 * (is_long && number > anchor_master ? number - 1 : number); };
  std::vector<Eigen::Triplet<std::complex<double>>> entries;
  for (std::size_t k = 0; k < outer.size(); ++k)
  {
    const auto vertex  = static_cast<long>(k);
    const double phase = is_long ? 0. : 2. * M_PI * offset.row(vertex).cast<double>().dot(wave.k);
    for (int c = 0; c < 2; ++c)
    {
      const int row = 2 * static_cast<int>(k) + c;
      if (!is_long || master[k] != anchor_master)
        entries.emplace_back(row, column_of(master[k]) + c, std::polar(1., phase));
      if (is_long)
        entries.emplace_back(row, 2 * (n_masters - 1) + c, place.row(vertex).dot(n));
    }
  }
  Ties result(2 * static_cast<long>(outer.size()), 2 * n_masters);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

std::optional<BlochPencil::Shifted> BlochPencil::shifted(const SplitStiffness &stiffness,
                                                         const double beta) const
{
  Shifted result;
  result.beta     = beta;
  result.schur    = stiffness.outer - beta * rest.outer;
  result.coupling = stiffness.coupling - beta * rest.coupling;
  if (inner.empty())
    return result;
  const Sparse matrix = stiffness.inner - beta * rest.inner;
  const auto factor   = std::make_shared<Eigen::SimplicialLLT<Sparse>>();
  factor->analyzePattern(matrix);
  factor->factorize(matrix);
  if (factor->info() != Eigen::Success)
    return {};
  Eigen::MatrixXd half = factor->permutationP() * Eigen::MatrixXd(result.coupling);
  factor->matrixL().solveInPlace(half);
  result.schur.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose(), -1.);
  result.schur.triangularView<Eigen::StrictlyUpper>() = result.schur.transpose();
  result.inner                                        = factor;
  return result;
}

Mode BlochPencil::extended(const Shifted &shifted, const Eigen::VectorXcd &outline) const
{
  Mode mode(at_rest.rows());
  for (std::size_t k = 0; k < outer.size(); ++k)
    mode.segment<2>(2 * outer[k]) = outline.segment<2>(2 * static_cast<long>(k));
  if (inner.empty())
    return mode;
  const Eigen::VectorXd real = shifted.inner->solve(shifted.coupling * outline.real());
  const Eigen::VectorXd imag = shifted.inner->solve(shifted.coupling * outline.imag());
  for (std::size_t k = 0; k < inner.size(); ++k)
    for (int c = 0; c < 2; ++c)
    {
      const long from        = 2 * static_cast<long>(k) + c;
      mode(2 * inner[k] + c) = {-real(from), -imag(from)};
    }
  return mode;
}

double BlochPencil::quotient(const Sparse &stiffness, const Mode &mode) const
{
  const Eigen::VectorXd real = mode.real(), imag = mode.imag();
  const auto energy = [&](const Sparse &matrix)
  { return real.dot(matrix * real) + imag.dot(matrix * imag); };
  return energy(stiffness) / energy(at_rest);
}
} // namespace homespun::verification
