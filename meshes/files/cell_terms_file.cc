// SPDX-License-Identifier: MIT
#include "meshes/files/cell_terms_file.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/law.h"

#include <cmath>

namespace homespun::meshes
{
namespace
{
constexpr int n_sides = CellEdges::n_sides, n_modes = FittedModes::n_modes,
              n_functions = FittedModes::n_functions;

template <typename Matrix>
using RowMajor = Eigen::Matrix<double, Matrix::RowsAtCompileTime, Matrix::ColsAtCompileTime,
                               Matrix::ColsAtCompileTime == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

std::string name_of_modes(const char *kind, const int side)
{
  return std::string("/edges/") + kind + "_" + std::to_string(side);
}

void write_second_order(const std::string &law, const SecondOrder &second, Hdf5Writer &file)
{
  const std::string energy = "/W3/" + law, modes = "/chi_quadratic/" + law;
  file.write(energy, {10}, second.energy.derivatives.data(), "N/m");
  file.attribute(energy, "convention",
                 "third derivatives of the energy per area by E = U - I, engineering shear; 111 "
                 "112 113 122 123 133 222 223 233 333, where 1, 2, 3 stand for 11, 22, 12");
  file.write(modes, {static_cast<unsigned long long>(second.chi.rows()), 2, n_modes},
             by_component(second.chi).data(), "m");
  file.attribute(modes, "convention",
                 "w = ... - E11^2/2 chi_1 - E22^2/2 chi_2 - gamma12^2/2 chi_3 - E11 E22 chi_4 - "
                 "E11 gamma12 chi_5 - E22 gamma12 chi_6, E = U - I, engineering shear; axes: "
                 "vertex, component, mode");
}

SecondOrder read_second_order(const Hdf5Reader &file, const std::string &law,
                              const unsigned long long n)
{
  const std::vector<double> energy = file.numbers("/W3/" + law, {10});
  SecondOrder second;
  second.energy.derivatives = Eigen::Map<const Eigen::Matrix<double, 10, 1>>(energy.data());
  second.chi = by_mode<QuadraticChi>(file.numbers("/chi_quadratic/" + law, {n, 2, n_modes}));
  return second;
}

void write_edges(const CellEdges &edges, const int n_vertices, Hdf5Writer &file)
{
  std::vector<double> slip, tension, decay, bulk;
  std::vector<int> n_cells;
  for (const CellEdge &edge : edges.sides)
  {
    for (int c = 0; c < 2; ++c)
      for (int a = 0; a < 3; ++a)
        slip.push_back(edge.slip(c, a));
    for (int a = 0; a < 3; ++a)
      tension.push_back(edge.tension(a));
    decay.push_back(edge.decay);
    n_cells.push_back(edge.n_cells);
  }
  for (const Eigen::Matrix3d &of_axis : edges.bulk)
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c)
        bulk.push_back(of_axis(a, c));
  file.write("/edges/slip", {n_sides, 2, 3}, slip.data(), "m");
  file.attribute("/edges/slip", "convention",
                 "edges where lattice coordinate 1 is smallest, largest, then 2; x, y; strain 11, "
                 "22, 12 with engineering shear; a clamped edge acts slip.E off where it is drawn");
  file.write("/edges/tension", {n_sides, 3}, tension.data(), "N");
  file.attribute("/edges/tension", "convention", "along a free edge, positive where it pulls");
  file.write("/edges/bulk", {2, 3, 3}, bulk.data(), "N");
  file.attribute("/edges/bulk", "convention",
                 "M_abc = <(sigma_c e_b).w_a> - <(sigma_a e_b).w_c>; axes: b, a, c; force on the "
                 "cloth: minus M_abc d_b E_a times the strain c of its virtual motion");
  file.write("/edges/decay", {n_sides}, decay.data(), "1");
  file.write("/edges/n_cells", {n_sides}, n_cells.data());
  for (int side = 0; side < n_sides; ++side)
  {
    const CellEdge &edge          = edges.sides[static_cast<std::size_t>(side)];
    const Hdf5Writer::Shape shape = {static_cast<unsigned long long>(edge.n_cells),
                                     static_cast<unsigned long long>(n_vertices), 2, 3};
    file.write(name_of_modes("clamped", side), shape, by_component(edge.clamped).data(), "m");
    file.write(name_of_modes("free", side), shape, by_component(edge.free).data(), "m");
  }
}

CellEdges read_edges(const Hdf5Reader &file, const std::string &path, const unsigned long long n)
{
  const std::vector<double> slip    = file.numbers("/edges/slip", {n_sides, 2, 3}),
                            tension = file.numbers("/edges/tension", {n_sides, 3}),
                            bulk    = file.numbers("/edges/bulk", {2, 3, 3}),
                            decay   = file.numbers("/edges/decay", {n_sides});
  const std::vector<int> n_cells    = file.integers("/edges/n_cells", {n_sides});
  CellEdges edges;
  for (std::size_t b = 0; b < 2; ++b)
    edges.bulk[b] =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(bulk.data() + 9 * b);
  for (int side = 0; side < n_sides; ++side)
  {
    const auto k   = static_cast<std::size_t>(side);
    CellEdge &edge = edges.sides[k];
    edge.slip = Eigen::Map<const Eigen::Matrix<double, 2, 3, Eigen::RowMajor>>(slip.data() + 6 * k);
    edge.tension = Eigen::Map<const Eigen::Vector3d>(tension.data() + 3 * k);
    edge.decay   = decay[k];
    edge.n_cells = n_cells[k];
    if (edge.n_cells < 1 || !(edge.decay >= 0. && edge.decay < 1.))
      throw BadInput(path + ": edge " + std::to_string(side) + " has /edges/n_cells " +
                     std::to_string(edge.n_cells) + " and /edges/decay " +
                     std::to_string(edge.decay) +
                     "; expected at least one cell and a decay below 1");
    const Hdf5Reader::Shape shape = {static_cast<unsigned long long>(edge.n_cells), n, 2, 3};
    edge.clamped = by_mode<EdgeModes>(file.numbers(name_of_modes("clamped", side), shape));
    edge.free    = by_mode<EdgeModes>(file.numbers(name_of_modes("free", side), shape));
  }
  return edges;
}

/// Numbers of fitted modes beside their fields, each with its name and unit.
template <typename Modes, typename Function>
void for_each_matrix(Modes &modes, const Function &function)
{
  function("low", modes.low);
  function("high", modes.high);
  function("knees", modes.knees);
  function("coefficients", modes.coefficients);
  function("of_strain", modes.of_strain);
}

void write_fitted(const std::string &law, const FittedModes &fitted, Hdf5Writer &file)
{
  const std::string group = "/fitted/" + law + "/";
  file.write(group + "modes", {static_cast<unsigned long long>(fitted.modes.rows()), 2, n_modes},
             by_component(fitted.modes).data(), "m");
  file.attribute(group + "modes", "convention",
                 "w = - sum_a e_a chi_a - sum_k c_k m_k, e_a = E_a + sum_j B_ja f_j(E), c_k = "
                 "sum_j A_jk f_j(E), A of coefficients, B of of_strain, f_j = E_a s_1^p s_2^q "
                 "s_3^r, 1 <= p + q + r <= 2, by a, then p, q, r; s_1 = E11/(e_1 + |E11|), s_2 "
                 "alike, s_3 = gamma12/e_3, e of knees; axes: vertex, component, mode");
  for_each_matrix(fitted,
                  [&](const char *const name, const auto &matrix)
                  {
                    const RowMajor<std::decay_t<decltype(matrix)>> rows = matrix;
                    Hdf5Writer::Shape shape = {static_cast<unsigned long long>(rows.rows())};
                    if (rows.cols() > 1)
                      shape.push_back(static_cast<unsigned long long>(rows.cols()));
                    file.write(group + name, shape, rows.data(), "1");
                  });
}

FittedModes read_fitted(const Hdf5Reader &file, const std::string &path, const std::string &law,
                        const unsigned long long n)
{
  const std::string group = "/fitted/" + law + "/";
  FittedModes fitted;
  fitted.modes   = by_mode<decltype(fitted.modes)>(file.numbers(group + "modes", {n, 2, n_modes}));
  bool is_finite = fitted.modes.allFinite();
  for_each_matrix(fitted,
                  [&](const char *const name, auto &matrix)
                  {
                    using Rows              = RowMajor<std::decay_t<decltype(matrix)>>;
                    Hdf5Reader::Shape shape = {Rows::RowsAtCompileTime};
                    if (Rows::ColsAtCompileTime > 1)
                      shape.push_back(Rows::ColsAtCompileTime);
                    matrix    = Eigen::Map<const Rows>(file.numbers(group + name, shape).data());
                    is_finite = is_finite && matrix.allFinite();
                  });
  if (!is_finite || !(fitted.knees.minCoeff() > 0.) ||
      !((fitted.high - fitted.low).minCoeff() >= 0.))
    throw BadInput(path + ": " + group +
                   " holds values that are not finite, knees that are not "
                   "positive or a box whose high is below its low; expected "
                   "what `homespun strain` leaves there");
  return fitted;
}
} // namespace

void write_terms(const HomogenizedCell &cell, Hdf5Writer &file)
{
  for (const auto &[law, second] : cell.second_order)
    write_second_order(law, second, file);
  if (cell.edges)
    write_edges(*cell.edges, cell.mesh.n_vertices(), file);
  for (const auto &[law, fitted] : cell.fitted)
    write_fitted(law, fitted, file);
}

void read_terms(const Hdf5Reader &file, const std::string &path, HomogenizedCell &cell)
{
  const auto n = static_cast<unsigned long long>(cell.mesh.n_vertices());
  for (const Law law : all_laws())
  {
    const std::string name = name_of(law);
    if (file.has("/W3/" + name) || file.has("/chi_quadratic/" + name))
      cell.second_order[name] = read_second_order(file, name, n);
    if (file.has("/fitted") && file.has("/fitted/" + name))
      cell.fitted[name] = read_fitted(file, path, name, n);
  }
  if (file.has("/edges"))
    cell.edges = read_edges(file, path, n);
}
} // namespace homespun::meshes
