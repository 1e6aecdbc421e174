// SPDX-License-Identifier: MIT
// Up-sampling of a coarse motion that is known, not solved: the vertices of the coarse mesh stand
// where a smooth motion x(X) takes them, and the fine ones must converge to
//   x(X) + R w(E),   w = −(E11 chi_11 + E22 chi_22 + gamma12 chi_12),   F = R (I + E)
// of the motion itself, with chi a known field.
//
// Cells as large as coarse parallelograms H: chi shrinks with them. Interpolation errs by H², and
// strain and rotation by H in places, times chi ~ H: order 2. With a strain, a rotation, a chi or
// a blend that stays wrong by a part the order is 1.
//
// Cells of one size on finer and finer coarse meshes: strain and rotation themselves must have
// order 2. The averages of a vertex have it where its triangles lie symmetrically around it, as in
// coarse_sheet(); at the rim they do not, hence a motion whose curvature vanishes there.
#include "localization/upsampler.h"
#include "meshes/plain/sheet.h"
#include "meshes/plain/symmetric_eigen.h"
#include "tests/verification/manufactured/manufactured_cases.h"

#include <Eigen/LU>

#include <array>
#include <cmath>

namespace homespun::verification
{
namespace
{
/// A cell with a chi that is periodic and zero at its corners.
meshes::HomogenizedCell cell_of(const double cell_side, const int n_divisions)
{
  meshes::HomogenizedCell cell;
  cell.mesh = irregular_mesh(n_divisions);
  cell.mesh.vertices *= cell_side / manufactured_side;
  cell.lattice.vectors = cell_side * Eigen::Matrix2d::Identity();
  cell.chi.resize(cell.mesh.n_vertices(), 6);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d at = 2. * M_PI / cell_side * cell.mesh.vertices.row(v);
    const double s1 = std::sin(at(0)), s2 = std::sin(at(1)), c1 = 1. - std::cos(at(0)),
                 c2 = 1. - std::cos(at(1));
    cell.chi.row(v) << s1 + 0.5 * c2, 0.3 * s2 - 0.4 * c1, 0.6 * s2 + 0.2 * c1, s2 + 0.5 * s1,
      c2 - 0.7 * s1, 0.8 * s1 * s2 + c1;
  }
  cell.chi *= 0.2 * cell_side;
  cell.anchor    = meshes::anchor_vertex(cell.mesh, cell.lattice);
  cell.stiffness = anisotropic();
  return cell;
}

/// x + R w(E) at a rest point, with the root of C by its eigenvectors.
template <int dim>
Eigen::Matrix<double, 1, dim> fine_position(const Wave &motion,
                                            const Eigen::Matrix<double, 1, 6> &chi)
{
  const Eigen::Matrix<double, dim, 2> F = motion.gradient.topRows<dim>();
  const auto squared                    = meshes::symmetric_eigen<2>(F.transpose() * F);
  const Eigen::Matrix2d U =
    squared.vectors * squared.values.cwiseSqrt().asDiagonal() * squared.vectors.transpose();
  const Eigen::RowVector2d w =
    -((U(0, 0) - 1.) * chi.segment<2>(0) + (U(1, 1) - 1.) * chi.segment<2>(2) +
      2. * U(0, 1) * chi.segment<2>(4));
  return motion.value.head<dim>().transpose() + w * (F * U.inverse()).transpose();
}

/// The distance of the up-sampled vertices from the motion, root mean square.
/// @param n_cells,n_coarse per side of the sheet
/// @param n_fine divisions of a side of a cell
template <int dim>
ManufacturedSolution upsampled(const int n_cells, const int n_coarse, const int n_fine,
                               const localization::UpsamplerOptions &options)
{
  const meshes::HomogenizedCell cell = cell_of(manufactured_side / n_cells, n_fine);
  const meshes::Sheet sheet          = meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells);
  const meshes::TriangleMesh coarse  = meshes::coarse_sheet(
     sheet.origin, manufactured_side / n_coarse * Eigen::Matrix2d::Identity(), n_coarse, n_coarse);
  localization::Positions<dim> given(coarse.n_vertices(), dim);
  for (int v = 0; v < coarse.n_vertices(); ++v)
    given.row(v) = spreading(coarse.vertices.row(v)).value.head<dim>().transpose();
  const localization::Upsampler<dim, double> upsampler(cell, coarse, sheet, options);
  typename localization::Upsampler<dim, double>::Fine found;
  upsampler.upsample(given, found);
  ManufacturedSolution solution;
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
    solution.error.L2 += (found.row(v) - fine_position<dim>(spreading(sheet.mesh.vertices.row(v)),
                                                            cell.chi.row(sheet.cell_vertex(v))))
                           .squaredNorm();
  solution.error.L2  = manufactured_side * std::sqrt(solution.error.L2 / sheet.mesh.n_vertices());
  solution.n_dofs    = static_cast<unsigned long>(given.size());
  solution.positions = found;
  return solution;
}

ManufacturedCase upsampler_case(const std::string &name,
                                std::function<ManufacturedSolution(int n_coarse)> solve)
{
  ManufacturedCase result = of_elements("up-sampler; " + name + "; biot", 1, {8, 16, 32, 64});
  result.L2_claim         = "the up-sampled positions converge with order 2 in H";
  result.has_H1           = false;
  result.theory           = "linear interpolation of a smooth motion, of its strain and rotation";
  result.has_tolerance    = false;
  result.solve = [solve](const int n_coarse, double, MPI_Comm) { return solve(n_coarse); };
  return result;
}
} // namespace

std::vector<ManufacturedCase> upsampler_cases(const localization::UpsamplerOptions &options)
{
  constexpr int n_cells = 7; // of one size: their sides are no lines of the coarse meshes
  return {upsampler_case("in space; cells of the coarse mesh's size",
                         [=](const int n) { return upsampled<3>(n, n, 6, options); }),
          upsampler_case("in the plane; cells of the coarse mesh's size",
                         [=](const int n) { return upsampled<2>(n, n, 6, options); }),
          upsampler_case("in space; cells of one size",
                         [=](const int n) { return upsampled<3>(n_cells, n, 24, options); }),
          upsampler_case("in the plane; cells of one size",
                         [=](const int n) { return upsampled<2>(n_cells, n, 24, options); })};
}
} // namespace homespun::verification
