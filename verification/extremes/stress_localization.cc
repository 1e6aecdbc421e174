// SPDX-License-Identifier: MIT
// Up-sampling of violent coarse motions. A uniform strain has a closed form at any size; for others
// the bound of the method: a fine vertex is no further from its place in the coarse triangles than
// the largest lift times the largest strain times the largest characteristic displacement.
#include "localization/upsampler.h"
#include "meshes/plain/sheet.h"
#include "meshes/plain/symmetric_eigen.h"
#include "meshes/plain/triangle_kinematics.h"
#include "verification/extremes/stress_cases.h"
#include "verification/record/number_text.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace homespun::verification
{
using localization::Positions;
using localization::Upsampler;
using localization::UpsamplerOptions;

namespace
{
constexpr int n_cells = 4;

struct Sheets
{
  explicit Sheets(const meshes::HomogenizedCell &cell)
      : cell(cell)
      , fine(meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells))
      , coarse(meshes::coarse_sheet(fine.origin, fine.lattice.vectors, n_cells, n_cells))
      , side(std::sqrt(cell.lattice.area()))
  {
  }
  meshes::HomogenizedCell cell;
  meshes::Sheet fine;
  meshes::TriangleMesh coarse;
  double side; ///< of a cell [m]
};
using Shared = std::shared_ptr<const Sheets>;

Positions<3> embedded(const meshes::TriangleMesh &mesh)
{
  Positions<3> x  = Positions<3>::Zero(mesh.n_vertices(), 3);
  x.leftCols<2>() = mesh.vertices;
  return x;
}

template <typename Scalar>
Eigen::MatrixXd upsampled(const Sheets &sheets, const Positions<3> &coarse,
                          const bool is_localized = true)
{
  UpsamplerOptions options;
  options.microscopic = is_localized;
  const Upsampler<3, Scalar> upsampler(sheets.cell, sheets.coarse, sheets.fine, options);
  typename Upsampler<3, Scalar>::Fine fine;
  upsampler.upsample(coarse, fine);
  return fine.template cast<double>();
}

/// U of F = R U by the eigenvectors of F'F, apart from the code under test.
Eigen::Matrix2d stretch(const Eigen::Matrix<double, 3, 2> &F)
{
  const auto squared = meshes::symmetric_eigen<2>(F.transpose() * F);
  return squared.vectors * squared.values.cwiseMax(0.).cwiseSqrt().asDiagonal() *
         squared.vectors.transpose();
}

/// Biot's strain U - I: 11, 22, twice 12.
Eigen::Vector3d strain_of(const Eigen::Matrix2d &U)
{
  return {U(0, 0) - 1., U(1, 1) - 1., 2. * U(0, 1)};
}

/// Largest distance from F X + R w, in cell sides.
StressAnswer uniform(const Sheets &sheets, const Eigen::Matrix<double, 3, 2> &F)
{
  const Positions<3> coarse           = sheets.coarse.vertices * F.transpose();
  const Eigen::MatrixXd found         = upsampled<double>(sheets, coarse);
  const Eigen::Matrix2d U             = stretch(F);
  const Eigen::Vector3d strain        = strain_of(U);
  const Eigen::Matrix<double, 3, 2> R = F * U.inverse();
  const meshes::Chi chi = localization::anchored(sheets.cell, localization::Anchor::lattice);
  double worst          = 0.;
  for (int v = 0; v < sheets.fine.mesh.n_vertices(); ++v)
  {
    const Eigen::Matrix<double, 1, 6> chi_here = chi.row(sheets.fine.cell_vertex(v));
    const Eigen::Vector2d w =
      -(strain(0) * chi_here.segment<2>(0) + strain(1) * chi_here.segment<2>(2) +
        strain(2) * chi_here.segment<2>(4))
         .transpose();
    const Eigen::Vector3d exact = F * sheets.fine.mesh.vertices.row(v).transpose() + R * w;
    worst                       = std::max(worst, (found.row(v).transpose() - exact).norm());
  }
  return {worst / sheets.side, found};
}

/// Largest microscopic displacement over its bound.
StressAnswer violent(const Sheets &sheets, const Positions<3> &coarse)
{
  const Eigen::MatrixXd fine  = upsampled<double>(sheets, coarse),
                        alone = upsampled<double>(sheets, coarse, false);
  const meshes::Chi chi       = localization::anchored(sheets.cell, localization::Anchor::lattice);
  double strain = 0., mode = 0.;
  for (int t = 0; t < sheets.coarse.n_triangles(); ++t)
    strain =
      std::max(strain, strain_of(stretch(meshes::deformation_gradient<3>(sheets.coarse, t, coarse)))
                         .cwiseAbs()
                         .sum());
  for (int k = 0; k < 3; ++k)
    mode = std::max(mode, chi.middleCols<2>(2 * k).rowwise().norm().maxCoeff());
  constexpr double lift = 1.; // of a rotation
  const double bound    = strain * lift * mode + 1e-14 * coarse.cwiseAbs().maxCoeff();
  Eigen::MatrixXd values(fine.rows(), 6);
  values << fine, upsampled<float>(sheets, coarse);
  return {(fine - alone).rowwise().norm().maxCoeff() / bound, values};
}

constexpr const char *distance_over_side = "largest distance over the cell's side [-]";
constexpr const char *displacement_over_bound =
  "largest microscopic displacement over its bound [-]";

/// Uniform motions.
void add_uniform(const Shared &sheets, const std::string &of, CaseGroup &group)
{
  // Twenty roundings of positions that are up to twenty cell sides away.
  constexpr double round_off = 20. * 20. * std::numeric_limits<double>::epsilon();
  const auto exact           = [&](const std::string &what, const Eigen::Matrix<double, 3, 2> &F)
  {
    group.finite(what + of, "finite; exactly F X + R w", {round_off, distance_over_side},
                 [=](unsigned int) { return uniform(*sheets, F); });
  };
  Eigen::Matrix<double, 3, 2> F;
  for (const double stretch : {0.2, 1., 5.})
  {
    F << stretch, 0., 0., 1., 0., 0.;
    exact("axis 1 to " + short_text(stretch), F);
  }
  F << 0.2, 0., 0., 0.2, 0., 0.;
  exact("both axes to 0.2", F);
  F << 1., 1., 0., 1., 0.2, -0.1;
  exact("sheared by 45 degrees and tilted", F);
  F << -1., 0., 0., -1., 0., 0.;
  exact("turned by exactly 180 degrees", F);
}

/// Collapsed, inverted, torn apart.
void add_violent(const Shared &sheets, const std::string &of, CaseGroup &group)
{
  const auto bounded =
    [&](const std::string &what,
        const std::function<Positions<3>(unsigned int)> &positions) -> StressCase &
  {
    return group.finite(what + of, "finite in float and double; within the bound of the method",
                        {1. + 1e-12, displacement_over_bound},
                        [=](const unsigned int seed) { return violent(*sheets, positions(seed)); });
  };
  const int middle        = (n_cells + 1) * (n_cells / 2) + n_cells / 2;
  const Positions<3> flat = embedded(sheets->coarse);
  bounded("coarse triangle collapsed to a line",
          [=](unsigned int)
          {
            Positions<3> x    = flat;
            x.row(middle)     = 0.5 * (x.row(middle + 1) + x.row(middle - 1 + n_cells + 1));
            x.row(middle + 1) = x.row(middle);
            return x;
          });
  bounded("coarse triangles collapsed to a point",
          [=](unsigned int)
          {
            Positions<3> x = flat;
            for (const int v : {middle, middle + 1, middle + n_cells + 1, middle + n_cells + 2})
              x.row(v) = flat.row(middle);
            return x;
          });
  bounded("the whole sheet in a line",
          [=](unsigned int) -> Positions<3>
          { return flat.rowwise().sum() * Eigen::RowVector3d(1., 2., 3.); });
  bounded("the whole sheet in a point",
          [=](unsigned int) -> Positions<3>
          { return Positions<3>::Constant(flat.rows(), 3, 0.3); });
  bounded("every second coarse triangle inverted",
          [=](unsigned int)
          {
            Positions<3> x = flat;
            for (int j = 0; j <= n_cells; ++j)
              for (int i = 0; i <= n_cells; ++i)
                x.row(j * (n_cells + 1) + i) =
                  sheets->side * Eigen::RowVector3d((i + j) % 3 == 1, (i + j) % 3 == 2, 0.);
            return x;
          });
  bounded("random coarse vertices",
          [=](const unsigned int seed) -> Positions<3>
          { return n_cells * sheets->side * meshes::random_vectors(flat.rows(), seed); })
    .is_random = true;
  bounded("one coarse vertex at 1e6 m",
          [=](const unsigned int seed)
          {
            Positions<3> x = flat;
            x.row(static_cast<int>(7 * seed + 3) % static_cast<int>(x.rows())) << 1e6, -2e5, 3e5;
            return x;
          })
    .is_random = true;
  for (const double scale : {1e-30, 1e30})
    bounded("scaled by " + short_text(scale),
            [=](unsigned int) -> Positions<3> { return scale * flat; });
  group.refused("coarse vertex that is not a number" + of, "vertex 7",
                [=](unsigned int) -> StressAnswer
                {
                  Positions<3> x = flat;
                  x(7, 1)        = std::numeric_limits<double>::quiet_NaN();
                  return {0., upsampled<float>(*sheets, x)};
                });
}
} // namespace

std::vector<StressCase> localization_cases(const std::vector<meshes::HomogenizedCell> &cells,
                                           const std::vector<std::string> &names)
{
  std::vector<StressCase> all;
  CaseGroup group("localization", all);
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const Shared sheets  = std::make_shared<const Sheets>(cells[k]);
    const std::string of = "; " + names.at(k);
    add_uniform(sheets, of, group);
    add_violent(sheets, of, group);
  }
  derive(
    all,
    {{distance_over_side,
      "theory: a uniform strain is up-sampled exactly; round-off: twenty roundings of positions "
      "up to twenty cell sides away"},
     {displacement_over_bound,
      "theory: lift x sum of |strains| x largest mode, and 1e-14 of the largest coordinate, whose "
      "digits the difference of two positions loses; round-off of the bound itself: 1e-12 of it"}});
  return all;
}

meshes::HomogenizedCell smooth_cell()
{
  constexpr double side = 0.01;
  constexpr int n       = 8;
  meshes::HomogenizedCell cell;
  cell.lattice.vectors = side * Eigen::Matrix2d::Identity();
  cell.mesh = meshes::coarse_sheet({0., 0.}, side / n * Eigen::Matrix2d::Identity(), n, n);
  cell.chi.resize(cell.mesh.n_vertices(), 6);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = 2. * M_PI / side * cell.mesh.vertices.row(v);
    for (int k = 0; k < 6; ++k)
      cell.chi(v, k) =
        0.05 * side * (std::sin(f(0) + k) + std::cos(2. * f(1) - k) + std::sin(f(0) - f(1)));
  }
  cell.chi.rowwise() -= Eigen::Matrix<double, 1, 6>(cell.chi.row(0));
  // Corners and opposite edges are one vertex: the same to the last bit.
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      if (i == n || j == n)
        cell.chi.row(j * (n + 1) + i) = cell.chi.row((j % n) * (n + 1) + i % n);
  return cell;
}
} // namespace homespun::verification
