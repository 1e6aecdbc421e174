// SPDX-License-Identifier: MIT
#include "homogenization/cell/material.h"

#include "homogenization/cell/cell_keys.h"
#include "homogenization/cell/cell_mesh_file.h"
#include "meshes/plain/symmetric_eigen.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

using namespace homespun::homogenization;

TEST(exact_material, the_compliance_of_a_brick_shows_each_of_its_constants_in_its_place)
{
  // Distinct constants, so that a swap of indices or a factor of two cannot hide.
  const Phase brick{"brick", 7., 3., 0.23, 1.7, 0., 0.5, 1.};
  const Eigen::Matrix3d S = plane_stress_stiffness(brick).inverse() * brick.thickness;
  EXPECT_NEAR(1. / S(0, 0), 7., 1e-13);
  EXPECT_NEAR(1. / S(1, 1), 3., 1e-13);
  EXPECT_NEAR(1. / S(2, 2), 1.7, 1e-13);
  EXPECT_NEAR(-S(0, 1) / S(0, 0), 0.23, 1e-13);
  EXPECT_NEAR(S(0, 2), 0., 1e-15);
}

TEST(exact_material, pulled_along_a_turned_fibre_the_modulus_is_that_of_the_fibre)
{
  const Phase yarn{"yarn", 10., 1., 0.3, 0.4, 30., 1., 1.};
  const Eigen::Matrix3d S = plane_stress_stiffness(yarn).inverse();
  const double c = std::cos(M_PI / 6.), s = std::sin(M_PI / 6.);
  const Eigen::Vector3d along(c * c, s * s, c * s); // stress of unit tension along the fibre
  EXPECT_NEAR(1. / along.dot(S * along), 10., 1e-12);
  // Under it the fibre's own axes do not shear, so the strain along it is 1/E1.
}

TEST(invariant_material, isotropic_phases_do_not_feel_their_angle)
{
  Phase phase             = isotropic("p", 3., 0.25, 2., 1.);
  const Eigen::Matrix3d c = plane_stress_stiffness(phase);
  phase.angle             = 37.;
  EXPECT_LT((plane_stress_stiffness(phase) - c).cwiseAbs().maxCoeff(), 1e-14 * c.maxCoeff());
}

TEST(invariant_material, plane_stress_stays_regular_at_incompressibility)
{
  for (const double nu : {-0.99, 0., 0.5, 0.999})
  {
    const Eigen::Matrix3d c = plane_stress_stiffness(isotropic("p", 1., nu, 1., 1.));
    EXPECT_GT(meshes::symmetric_eigen<3>(c).values(0), 0.) << nu;
    EXPECT_TRUE(faults_of(isotropic("p", 1., nu, 1., 1.)).empty()) << nu;
  }
}

TEST(exact_material, layers_bend_about_their_neutral_surface)
{
  // One layer cut in two is one layer.
  const Phase whole = isotropic("p", 3e6, 0.35, 1e-3, 1.),
              cut   = layered("p", {{2e-4, 3e6, 0.35}, {8e-4, 3e6, 0.35}}, 1.);
  EXPECT_LT((plane_stress_stiffness(cut) - plane_stress_stiffness(whole)).norm(),
            1e-14 * plane_stress_stiffness(whole).norm());
  EXPECT_LT((bending_stiffness(cut) - bending_stiffness(whole)).norm(),
            1e-14 * bending_stiffness(whole).norm());
  EXPECT_NEAR(cut.plate->neutral, 5e-4, 1e-17);

  // A bimetal as a beam, nu = 0 (Timoshenko 1925): with m = t1/t2, n = E1/E2
  //   E I = E2 t2³/12 (n² m⁴ + 4 n m³ + 6 n m² + 4 n m + 1) / (1 + n m).
  const double t1 = 6e-4, t2 = 4e-4, E1 = 4e5, E2 = 1.4e7, m = t1 / t2, n = E1 / E2;
  const double EI =
    E2 * t2 * t2 * t2 / 12. *
    (n * n * m * m * m * m + 4. * n * m * m * m + 6. * n * m * m + 4. * n * m + 1.) / (1. + n * m);
  const Phase strip = layered("p", {{t1, E1, 0.}, {t2, E2, 0.}}, 1.);
  EXPECT_NEAR(bending_stiffness(strip)(0, 0) / EI, 1., 1e-13);
  EXPECT_NEAR(plane_stress_stiffness(strip)(0, 0), E1 * t1 + E2 * t2, 1e-9);
  EXPECT_NEAR(strip.plate->neutral,
              (0.5 * E1 * t1 * t1 + E2 * t2 * (t1 + 0.5 * t2)) / (E1 * t1 + E2 * t2), 1e-16);

  // Of any nu: the least energy over the strain of the plane e of the layers' own energies,
  // kappa.D.kappa = min over e of sum of the integral of (e + z kappa).Q.(e + z kappa).
  const std::vector<Layer> layers = {{6e-4, 4e5, 0.2}, {4e-4, 1.4e7, 0.45}, {1e-4, 2e6, -0.3}};
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero(), B = A, D = A;
  double z = 0.;
  for (const Layer &layer : layers)
  {
    const Eigen::Matrix3d Q = plane_stress_stiffness(isotropic("p", layer.E, layer.nu, 1., 1.));
    const double top        = z + layer.thickness;
    A += (top - z) * Q;
    B += (top * top - z * z) / 2. * Q;
    D += (top * top * top - z * z * z) / 3. * Q;
    z = top;
  }
  const Phase phase       = layered("p", layers, 1.);
  const Eigen::Matrix3d c = A, d = D - B * A.inverse() * B;
  EXPECT_LT((plane_stress_stiffness(phase) - c).norm(), 1e-13 * c.norm());
  EXPECT_LT((bending_stiffness(phase) - d).norm(), 1e-12 * d.norm());
  EXPECT_TRUE(faults_of(phase).empty());
  // About the lower face, that of a neighbour without thickness.
  EXPECT_NEAR(coupling(strip, isotropic("p", 1., 0., 1e-300, 1.)),
              std::abs((0.5 * E1 * t1 * t1 + E2 * t2 * (t1 + 0.5 * t2))) /
                std::sqrt((E1 * t1 + E2 * t2) *
                          (E1 * t1 * t1 * t1 + E2 * (std::pow(t1 + t2, 3) - t1 * t1 * t1)) / 3.),
              1e-12);
  EXPECT_EQ(coupling(strip, strip), 0.);
}

TEST(tripwire_material, impossible_constants_are_named)
{
  const auto says = [](const Phase &phase, const std::string &text)
  {
    for (const std::string &fault : faults_of(phase))
      if (fault.find(text) != std::string::npos && fault.find("`p`") != std::string::npos)
        return true;
    return false;
  };
  EXPECT_TRUE(says(isotropic("p", -1., 0.3, 1., 1.), "Young's modulus -1 Pa"));
  EXPECT_TRUE(says(isotropic("p", 1., 1., 1., 1.), "Poisson's ratio 1"));
  EXPECT_TRUE(says(isotropic("p", 1., -1., 1., 1.), "Poisson's ratio -1"));
  EXPECT_TRUE(says(isotropic("p", 1., 0.3, 0., 1.), "thickness 0 m"));
  EXPECT_TRUE(says(isotropic("p", 1., 0.3, 1., -2.), "density -2 kg/m^3"));
  EXPECT_TRUE(says({"p", 1., 4., 0.6, 1., 0., 1., 1.}, "Poisson's ratio 0.6"));
  EXPECT_TRUE(says({"p", 1., 4., 0.3, -1., 0., 1., 1.}, "shear modulus -1 Pa"));
}

namespace
{
/// Young's moduli of the groups 1 and 2 of a mesh.
std::vector<double> moduli(const std::string &young, const std::map<std::string, int> &names,
                           std::vector<std::string> &faults)
{
  CellMeshFile file;
  file.mesh.material  = Eigen::Vector2i(1, 2);
  file.number_of_name = names;
  CellKeys keys;
  keys.young     = young;
  keys.poisson   = "0.3";
  keys.thickness = "1e-3";
  keys.density   = "400";
  std::vector<double> found;
  for (const Phase &phase : assign_phases("cell.prm", keys, file, faults))
    found.push_back(phase.E1);
  return found;
}
} // namespace

TEST(exact_phases, a_number_that_is_the_name_of_another_group_is_that_group)
{
  using Moduli = std::vector<double>;
  std::vector<std::string> faults;
  const std::map<std::string, int> crossed = {{"2", 1}, {"1", 2}};
  EXPECT_EQ(moduli("1e6, 1: 1e7", crossed, faults), (Moduli{1e6, 1e7}));
  EXPECT_EQ(moduli("1: 1e6, 2: 1e7", crossed, faults), (Moduli{1e7, 1e6}));
  EXPECT_EQ(moduli("1: 1e6, hard: 1e7", {{"soft", 1}, {"hard", 2}}, faults), (Moduli{1e6, 1e7}));
  EXPECT_TRUE(faults.empty());
  moduli("1e6, 2: 1e7", {{"2", 1}}, faults);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].find("group 2 of the mesh has no name of its own"), std::string::npos);
}
