// SPDX-License-Identifier: MIT
// The cells that come with homespun, those with holes too, over whole cells, over a mesh that is no
// multiple of cells, and over a garment.
#include "meshes/cloth/seams.h"
#include "meshes/files/obj_file.h"
#include "meshes/files/surface_files.h"
#include "meshes/garment/fine_cloth.h"
#include "meshes/plain/cross.h"
#include "tests/homogenization/cell/shipped.h"
#include "tests/localization/localization_cases.h"
#include "verification/upsample/upsampled_cloth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace homespun::verification
{
namespace
{
using meshes::ClothMesh;

constexpr const char *names[] = {"auxetic",     "checkerboard", "chevron",         "hexagonal-dots",
                                 "honeycomb",   "layered",      "plain-weave",     "printed-patch",
                                 "random-dots", "satin",        "three-stiffness", "twill"};

/// A smooth periodic field, zero at the anchor, different in every column.
double field(const meshes::Lattice &lattice, const Eigen::RowVector2d &x, const int column)
{
  const Eigen::RowVector2d f = 2. * M_PI * lattice.fractional(x);
  return 0.01 * std::sqrt(lattice.area()) *
         (std::sin(f(0) + column) - std::sin(column) + 0.5 * std::sin(f(1) - column) +
          0.5 * std::sin(column));
}

/// A shipped cell of this side [m], with that field as chi: what up-sampling does with it is known
/// without a solve.
meshes::HomogenizedCell cell_of(const std::string &name, const double side)
{
  const homogenization::UnitCell unit = tests::shipped(name);
  meshes::HomogenizedCell cell;
  const double factor = side / std::sqrt(unit.lattice.area());
  cell.mesh           = unit.mesh;
  cell.mesh.vertices *= factor;
  cell.lattice.vectors = factor * unit.lattice.vectors;
  cell.anchor          = meshes::anchor_vertex(cell.mesh, cell.lattice);
  cell.chi.resize(cell.mesh.n_vertices(), 6);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    for (int k = 0; k < 6; ++k)
      cell.chi(v, k) =
        field(cell.lattice, cell.mesh.vertices.row(v) - cell.mesh.vertices.row(cell.anchor), k);
  return cell;
}

ClothMesh laid_flat(const meshes::TriangleMesh &rest)
{
  return meshes::placed_sheet(rest, Eigen::Matrix<double, 3, 2>::Identity(), {0., 0., 0.});
}

/// The part of a triangle that lies in a rectangle from the origin (Sutherland and Hodgman).
double area_within(std::vector<Eigen::RowVector2d> polygon, const Eigen::RowVector2d &size)
{
  for (int side = 0; side < 4; ++side)
  {
    const int axis    = side % 2;
    const auto inside = [&](const Eigen::RowVector2d &x)
    { return side < 2 ? x(axis) : size(axis) - x(axis); };
    std::vector<Eigen::RowVector2d> rest;
    for (std::size_t k = 0; k < polygon.size(); ++k)
    {
      const Eigen::RowVector2d a = polygon[k], b = polygon[(k + 1) % polygon.size()];
      const double d = inside(a), e = inside(b);
      if (d >= 0.)
        rest.push_back(a);
      if ((d < 0.) != (e < 0.))
        rest.push_back(a + d / (d - e) * (b - a));
    }
    polygon = rest;
  }
  double twice = 0.;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    twice += meshes::cross(polygon[k], polygon[(k + 1) % polygon.size()]);
  return 0.5 * twice;
}

/// What cells whose anchors are the lattice points cover of that rectangle.
double covered_area(const meshes::HomogenizedCell &cell, const Eigen::RowVector2d &size)
{
  double sum                      = 0.;
  const Eigen::RowVector2d anchor = cell.mesh.vertices.row(cell.anchor);
  for (int i = -6; i <= 6; ++i)
    for (int j = -6; j <= 6; ++j)
      for (int t = 0; t < cell.mesh.n_triangles(); ++t)
      {
        std::vector<Eigen::RowVector2d> corners;
        for (int k = 0; k < 3; ++k)
          corners.push_back(cell.mesh.vertices.row(cell.mesh.triangles(t, k)) - anchor +
                            Eigen::RowVector2d(i, j) * cell.lattice.vectors);
        sum += area_within(corners, size);
      }
  return sum;
}

/// x = F X + w for every fine vertex, w that of the uniform strain U − I of a stretch F.
/// @return the largest distance [m]
double distance_from_theory(const meshes::HomogenizedCell &cell, const UpsampledCloth &cloth,
                            const ClothMesh &rest)
{
  const Eigen::Vector3d E(0.03, -0.02, 0.);
  meshes::SpacePoints moved = rest.positions;
  moved.col(0) *= 1. + E(0);
  moved.col(1) *= 1. + E(1);
  meshes::FloatPoints at_rest, now;
  cloth.upsampler->upsample(rest.positions, at_rest);
  cloth.upsampler->upsample(moved, now);
  double largest = 0.;
  for (Eigen::Index v = 0; v < now.rows(); ++v)
    for (int c = 0; c < 2; ++c)
    {
      const Eigen::RowVector2d X = at_rest.row(v).head<2>().cast<double>();
      const double w = -E(0) * field(cell.lattice, X, c) - E(1) * field(cell.lattice, X, 2 + c);
      largest        = std::max(largest, std::abs(now(v, c) - (1. + E(c)) * X(c) - w));
    }
  return largest;
}

double area_of(const UpsampledCloth &cloth, const meshes::SpacePoints &coarse)
{
  meshes::FloatPoints fine;
  cloth.upsampler->upsample(coarse, fine);
  const meshes::SpacePoints x = fine.cast<double>();
  double sum                  = 0.;
  for (Eigen::Index t = 0; t < cloth.triangles.rows(); ++t)
  {
    const Eigen::RowVector3d a = x.row(cloth.triangles(t, 0)), b = x.row(cloth.triangles(t, 1)),
                             c = x.row(cloth.triangles(t, 2));
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}
} // namespace

TEST(exact_shipped_cells, lie_on_whole_cells_and_on_a_mesh_that_is_no_multiple_of_cells)
{
  for (const std::string name : names)
  {
    SCOPED_TRACE(name);
    const meshes::HomogenizedCell cell = cell_of(name, 0.01);
    const double side = 0.01, solid = signed_areas(cell.mesh).sum();
    // chi is linear in a triangle where a vertex was made on the outline; field curves there.
    const double curvature = 0.05 * 0.01 * side;

    const ClothMesh whole = laid_flat(meshes::coarse_sheet({0., 0.}, cell.lattice.vectors, 3, 2));
    const UpsampledCloth on_cells(cell, whole, {});
    EXPECT_NE(on_cells.description.find("a sheet of 3 x 2 cells"), std::string::npos);
    EXPECT_NEAR(area_of(on_cells, whole.positions), 6. * solid, 1e-5 * 6. * solid);

    const Eigen::RowVector2d size(2.3 * side, 1.7 * side);
    Eigen::Matrix2d steps = Eigen::Matrix2d::Zero();
    steps.diagonal() << size(0) / 5., size(1) / 4.;
    const ClothMesh own = laid_flat(meshes::coarse_sheet({0., 0.}, steps, 5, 4));
    const UpsampledCloth on_own(cell, own, {});
    EXPECT_NE(on_own.description.find("1 panel, 40 coarse triangles"), std::string::npos);
    const double expected = covered_area(cell, size);
    // Single precision of the positions.
    EXPECT_NEAR(area_of(on_own, own.positions), expected, 1e-5 * expected);
    EXPECT_LT(distance_from_theory(cell, on_own, own), curvature);
  }
}

TEST(exact_shipped_cells, cover_a_garment_as_densely_as_the_plane)
{
  const ClothMesh skirt = meshes::read_cloth(std::string(CELLS) + "../scenes/skirt.obj", 1.);
  const double area     = signed_areas(skirt.rest).sum();
  for (const std::string name : names)
  {
    SCOPED_TRACE(name);
    const meshes::HomogenizedCell cell = cell_of(name, 0.05);
    const UpsampledCloth cloth(cell, skirt, {});
    meshes::FloatPoints fine;
    cloth.upsampler->upsample(skirt.positions, fine);
    EXPECT_TRUE(fine.allFinite());
    // Areas at rest, by the coarse triangles: of cells that are many over a panel the part that is
    // solid is that of the cell, but for what the outlines cut.
    const double solid              = signed_areas(cell.mesh).sum() / cell.lattice.area();
    const meshes::FineCloth covered = meshes::fine_cloth(cell.mesh, cell.lattice, skirt);
    EXPECT_NEAR(signed_areas(covered.rest).sum() / area, solid, 0.05 * solid);
    EXPECT_LT(std::abs(covered.area_lost), 1e-9 * area);
    EXPECT_EQ(fine.rows(), covered.n_vertices());
  }
}
} // namespace homespun::verification
