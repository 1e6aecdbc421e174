// SPDX-License-Identifier: MIT
#include "verification/strain/claims/self_checks.h"

#include "homogenization/cell/material.h"
#include "meshes/plain/epsilon.h"
#include "verification/method/sheet_reading.h"
#include "verification/record/claim.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
namespace
{
/// Relative to the size of the tangent, how far stress and tangent are from central differences.
double misfit_of(const Law law, const Eigen::Matrix3d &C, const Eigen::Matrix2d &F)
{
  constexpr double step   = 1e-5;
  const Response response = verification::response(law, C, F);
  Eigen::Vector4d stress;
  Eigen::Matrix4d tangent;
  for (int k = 0; k < 4; ++k)
  {
    Eigen::Matrix2d ahead = F, behind = F;
    ahead(k / 2, k % 2) += step;
    behind(k / 2, k % 2) -= step;
    const Response after  = verification::response(law, C, ahead),
                   before = verification::response(law, C, behind);
    stress(k)             = (after.energy - before.energy) / (2. * step);
    tangent.col(k)        = (after.stress - before.stress) / (2. * step);
  }
  return larger((stress - response.stress).norm(), (tangent - response.tangent).norm()) /
         response.tangent.norm();
}
Verdict verdict_of_law(const homogenization::UnitCell &cell, const Law law, const double strain)
{
  const std::vector<Eigen::Matrix2d> paths = {
    Eigen::Matrix2d{{1., 0.}, {0., 0.}}, Eigen::Matrix2d{{0., 0.}, {0., 1.}},
    Eigen::Matrix2d{{0., 1.}, {0., 0.}}, Eigen::Matrix2d{{0.9, 0.4}, {-0.6, 0.5}}};
  const Eigen::Matrix2d all = Eigen::Matrix2d::Identity();
  double worst              = 0.;
  for (const Eigen::Matrix3d &C : cell.stiffness_of_phase())
    for (const Eigen::Matrix2d &path : paths)
      for (const double part : {0.1, 1.})
        worst = larger(worst, misfit_of(law, C, all + part * strain * path));
  return at_most("law-derivatives", {{"cell", cell.name}, {"reference", name_of(law)}}, worst,
                 1e-6);
}

/// The energies of a strain, a symmetric tensor, in a stiffness.
double energy_of(const Eigen::Matrix2d &e, const Eigen::Matrix3d &c)
{
  const Eigen::Vector3d voigt(e(0, 0), e(1, 1), 2. * e(0, 1));
  return voigt.dot(c * voigt);
}

Verdict verdict_of_axes(const homogenization::UnitCell &cell)
{
  constexpr double degrees = 37.;
  const double angle       = degrees * M_PI / 180.;
  Eigen::Matrix2d Q;
  Q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  double worst = 0.;
  for (const homogenization::Phase &phase : cell.phases)
  {
    homogenization::Phase turned = phase;
    turned.angle += degrees;
    const Eigen::Matrix3d c     = homogenization::plane_stress_stiffness(phase),
                          there = homogenization::plane_stress_stiffness(turned);
    for (const Eigen::Matrix2d &e :
         {Eigen::Matrix2d{{1., 0.}, {0., 0.}}, Eigen::Matrix2d{{0., 0.}, {0., 1.}},
          Eigen::Matrix2d{{0., 0.5}, {0.5, 0.}}, Eigen::Matrix2d{{0.8, 0.3}, {0.3, -0.4}}})
      worst =
        larger(worst, std::abs(energy_of(Q * e * Q.transpose(), there) / energy_of(e, c) - 1.));
  }
  return at_most("phases-turned", {{"cell", cell.name}}, worst, 1e-8);
}

Verdict verdict_of_interpolation(const homogenization::UnitCell &cell)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  constexpr Quads quads     = {3, 2};
  const meshes::Points rest =
    CoarseSpace(sheet, CoarseElement::three_nodes, quads).nodes.mesh.vertices;
  const double largest =
    (SheetReading(sheet, quads).at_fine_vertices(Law::linear, rest).positions - sheet.mesh.vertices)
      .rowwise()
      .norm()
      .maxCoeff() /
    std::sqrt(cell.lattice.area());
  // Coordinates far from the origin have fewer digits.
  const double limit = 1e-12 + 4. * meshes::epsilon * sheet.mesh.vertices.cwiseAbs().maxCoeff() /
                                 std::sqrt(cell.lattice.area());
  return at_most("sheet-at-rest", {{"cell", cell.name}}, largest, limit);
}
} // namespace

std::vector<Verdict> self_checks(const homogenization::UnitCell &cell, const std::vector<Law> &laws,
                                 const double strain)
{
  std::vector<Verdict> verdicts;
  for (const Law law : laws)
    verdicts.push_back(verdict_of_law(cell, law, strain));
  verdicts.push_back(verdict_of_axes(cell));
  verdicts.push_back(verdict_of_interpolation(cell));
  return verdicts;
}
} // namespace homespun::verification
