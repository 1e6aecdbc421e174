// SPDX-License-Identifier: MIT
#include "verification/strain/law_verdicts.h"

#include <algorithm>

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
} // namespace

std::vector<Verdict> law_verdicts(const homogenization::UnitCell &cell,
                                  const std::vector<Law> &laws, const double strain)
{
  const std::vector<Eigen::Matrix2d> paths = {
    Eigen::Matrix2d{{1., 0.}, {0., 0.}}, Eigen::Matrix2d{{0., 0.}, {0., 1.}},
    Eigen::Matrix2d{{0., 1.}, {0., 0.}}, Eigen::Matrix2d{{0.9, 0.4}, {-0.6, 0.5}}};
  std::vector<Verdict> verdicts;
  for (const Law law : laws)
  {
    double worst = 0.;
    for (const Eigen::Matrix3d &C : cell.stiffness_of_phase())
      for (const Eigen::Matrix2d &path : paths)
        for (const double part : {0.1, 1.})
          worst =
            larger(worst, misfit_of(law, C, Eigen::Matrix2d::Identity() + part * strain * path));
    constexpr double limit = 1e-6;
    verdicts.push_back({cell.name + ", " + name_of(law) +
                          ": stress and tangent are the derivatives of the energy, for each phase "
                          "(largest difference over the size of the tangent)",
                        worst <= limit ? Outcome::pass : Outcome::fail, worst, "<= 1e-06",
                        "central differences of step 1e-5 err by the square of the step times a "
                        "third derivative of up to 1e2 tangents, and by 1e-11 of round-off",
                        Kind::program});
  }
  return verdicts;
}
} // namespace homespun::verification
