// SPDX-License-Identifier: MIT
// Strains and stresses of phases against the closed form of a laminate, and their mean.
#include "tests/homogenization/cell/cells.h"
#include "verification/cell/phase_fields.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;
using homogenization::Phase;
using homogenization::UnitCell;
using homogenization::UnitStrains;

namespace
{
const std::vector<double> fractions = {0.25, 0.25, 0.5};

/// Layers of anisotropic phases that are all turned: no entry of any stiffness is zero.
UnitCell layers()
{
  const std::vector<Phase> phases = {{"a", 10., 1., 0.3, 0.4, 30., 1., 1.},
                                     {"b", 6., 2., 0.2, 0.7, -55., 0.8, 1.},
                                     homogenization::isotropic("c", 3., 0.1, 1.3, 1.)};
  return tests::cell_of(tests::square_lattice(0.01), 5, 8, phases,
                        [](double, double f2) { return f2 < 0.25  ? 0
                                                       : f2 < 0.5 ? 1
                                                                  : 2; });
}

homogenization::Homogenization solved(const UnitCell &cell, const unsigned int order,
                                      const unsigned int refine)
{
  homogenization::HomogenizationOptions options;
  options.order     = order;
  options.refine    = refine;
  options.tolerance = 1e-13;
  options.solver    = homogenization::CellSolver::direct;
  return homogenization::homogenize(cell, options, MPI_COMM_SELF);
}

/// The mean over the cell as columns, one per macro strain.
Eigen::Matrix3d mean_of(const UnitStrains &field, const UnitCell &cell)
{
  const Eigen::VectorXd areas           = meshes::signed_areas(cell.mesh);
  const Eigen::Matrix<double, 1, 9> sum = areas.transpose() * field;
  return Eigen::Map<const Eigen::Matrix3d>(sum.data()) / cell.lattice.area();
}
} // namespace

// Through layers stacked along axis 2 the strain 11 and the stresses 22 and 12 are the same, those
// stresses being the mean ones.
TEST(exact_phase_fields, of_a_laminate_are_those_of_the_closed_form_in_every_triangle)
{
  const UnitCell cell                  = layers();
  const std::vector<Eigen::Matrix3d> c = cell.stiffness_of_phase();
  const Eigen::Matrix3d C              = homogenization::laminate_stiffness(c, fractions);
  for (const auto &[order, refine] : {std::pair{1u, 0u}, {2u, 0u}, {1u, 2u}})
  {
    const UnitStrains strains  = solved(cell, order, refine).strains,
                      stresses = phase_stresses(cell, strains);
    for (int t = 0; t < cell.mesh.n_triangles(); ++t)
      for (int a = 0; a < 3; ++a)
      {
        const Eigen::Matrix3d &its    = c[static_cast<std::size_t>(cell.mesh.material(t))];
        const double e11              = a == 0 ? 1. : 0.;
        const Eigen::Vector2d through = C.col(a).tail<2>();
        const Eigen::Vector2d rest =
          its.bottomRightCorner<2, 2>().inverse() * (through - e11 * its.col(0).tail<2>());
        const Eigen::Vector3d strain(e11, rest(0), rest(1)), stress = its * strain;
        const double size = C.cwiseAbs().maxCoeff();
        EXPECT_LT((strains.row(t).segment<3>(3 * a).transpose() - strain).cwiseAbs().maxCoeff(),
                  1e-10)
          << t << " " << a << " P" << order << refine;
        EXPECT_LT((stresses.row(t).segment<3>(3 * a).transpose() - stress).cwiseAbs().maxCoeff(),
                  1e-10 * size)
          << t << " " << a << " P" << order << refine;
      }
  }
}

TEST(exact_phase_fields, the_mean_stress_is_the_effective_stiffness_and_the_mean_strain_the_unit)
{
  for (const auto &[order, refine] : {std::pair{1u, 0u}, {2u, 0u}, {2u, 1u}})
  {
    const UnitCell cell = tests::cell_of(tests::skewed_lattice(), 8, 8, tests::soft_and_hard(),
                                         tests::square_inclusion);
    const auto result   = solved(cell, order, refine);
    const Eigen::Matrix3d mean = mean_of(phase_stresses(cell, result.strains), cell);
    EXPECT_LT(tests::relative_difference(mean, result.stiffness), 1e-10) << order << refine;
    EXPECT_LT((mean_of(result.strains, cell) - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
              1e-12)
      << order << refine;
  }
}

TEST(exact_phase_fields, principal_vectors_are_along_the_axes_of_a_turned_tensor)
{
  const double angle = 0.3, cosine = std::cos(angle), sine = std::sin(angle);
  for (const auto &[first, second] : {std::pair{3., 1.}, {2., -5.}, {-1., -4.}})
  {
    const Eigen::Vector3d tensor(first * cosine * cosine + second * sine * sine,
                                 first * sine * sine + second * cosine * cosine,
                                 (first - second) * sine * cosine);
    const Eigen::Matrix2d vectors = principal_vectors(tensor);
    EXPECT_LT((vectors.row(0) - first * Eigen::RowVector2d(cosine, sine)).norm(), 1e-14);
    EXPECT_LT((vectors.row(1) - second * Eigen::RowVector2d(sine, -cosine)).norm(), 1e-14);
  }
}

TEST(exact_phase_fields, a_vertical_principal_vector_points_one_way_whatever_rounding_says)
{
  for (const double shear : {0., 1e-17, -1e-17, 1e-9, -1e-9})
  {
    const Eigen::Matrix2d vectors = principal_vectors({1., 3., shear});
    EXPECT_GT(vectors(0, 1), 0.) << shear;
    EXPECT_GT(vectors(1, 0), 0.) << shear;
  }
}

// What ParaView reads: of each macro strain both fields with two vectors each, in three components.
TEST(exact_phase_fields, the_data_of_a_file_hold_them_with_half_of_the_shear_in_the_directions)
{
  const UnitCell cell       = layers();
  const UnitStrains strains = solved(cell, 1, 0).strains;
  const auto data           = phase_field_data(cell, strains);
  ASSERT_EQ(data.size(), 18u);
  EXPECT_EQ(data[0].name, "strain_11 (11, 22, 2x12) [-]");
  EXPECT_EQ(data[17].name, "stress_12 principal 2 [N/m]");
  for (const meshes::VertexData &field : data)
    EXPECT_EQ(field.values.cols(), 3);
  // Both principal values add up to the trace.
  const auto value = [](const meshes::VertexData &field)
  { return (field.values(0, 0) < 0.f ? -1.f : 1.f) * field.values.row(0).norm(); };
  EXPECT_NEAR(value(data[13]) + value(data[14]), strains(0, 6) + strains(0, 7), 1e-6);
  EXPECT_NEAR(value(data[13]) - value(data[14]),
              std::hypot(strains(0, 6) - strains(0, 7), strains(0, 8)), 1e-6);
}
