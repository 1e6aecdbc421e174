// SPDX-License-Identifier: MIT
#include "verification/reference/laws.h"

#include "meshes/plain/symmetric_eigen.h"
#include "verification/yarns/yarn_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace homespun::verification
{
namespace
{
using StrainDerivative = Eigen::Matrix<double, 3, 4>; // of the Voigt strain by F11, F12, F21, F22

Response linear_response(const Eigen::Matrix3d &C, const Eigen::Matrix2d &F)
{
  const Eigen::Vector3d strain(F(0, 0) - 1., F(1, 1) - 1., F(0, 1) + F(1, 0));
  StrainDerivative B;
  B << 1., 0., 0., 0., //
    0., 0., 0., 1.,    //
    0., 1., 1., 0.;
  const Eigen::Vector3d force = C * strain;
  return {0.5 * strain.dot(force), B.transpose() * force, B.transpose() * C * B};
}

Response green_response(const Eigen::Matrix3d &C, const Eigen::Matrix2d &F)
{
  const Eigen::Vector3d strain(0.5 * (F.col(0).squaredNorm() - 1.),
                               0.5 * (F.col(1).squaredNorm() - 1.), F.col(0).dot(F.col(1)));
  StrainDerivative B;
  B << F(0, 0), 0., F(1, 0), 0., //
    0., F(0, 1), 0., F(1, 1),    //
    F(0, 1), F(0, 0), F(1, 1), F(1, 0);
  const Eigen::Vector3d force = C * strain;
  Response result{0.5 * strain.dot(force), B.transpose() * force, B.transpose() * C * B};
  // Each row of F contributes the stress tensor once.
  Eigen::Matrix2d S;
  S << force(0), force(2), force(2), force(1);
  result.tangent.topLeftCorner<2, 2>() += S;
  result.tangent.bottomRightCorner<2, 2>() += S;
  return result;
}

Response biot_response(const Eigen::Matrix3d &C, const Eigen::Matrix2d &F)
{
  const double a = F(0, 0) + F(1, 1), b = F(1, 0) - F(0, 1), r = std::sqrt(a * a + b * b);
  if (!(r > 0.))
    return {std::numeric_limits<double>::infinity(), Eigen::Vector4d::Zero(),
            Eigen::Matrix4d::Zero()};
  const double c = a / r, s = b / r;
  const double U11 = c * F(0, 0) + s * F(1, 0), U22 = c * F(1, 1) - s * F(0, 1);
  const double U12 = c * F(0, 1) + s * F(1, 1);
  const Eigen::Vector3d strain(U11 - 1., U22 - 1., 2. * U12);

  // The strain depends on F directly (L) and through the angle of the rotation (h, with dtheta =
  // t.dF).
  StrainDerivative L, L_angle;
  L << c, 0., s, 0., //
    0., -s, 0., c,   //
    -s, c, c, s;
  L_angle << -s, 0., c, 0., //
    0., -c, 0., -s,         //
    -c, -s, -s, c;
  const Eigen::Vector3d h(U12, -U12, U22 - U11);
  const Eigen::Vector3d h_angle(-U11, -U22, -2. * U12);
  const Eigen::Vector4d t       = Eigen::Vector4d(-s, -c, c, -s) / r;
  const Eigen::Vector4d d_trace = Eigen::Vector4d(c, -s, s, c); // dr/dF, r = tr U
  const StrainDerivative G      = L + h * t.transpose();

  const Eigen::Vector3d force = C * strain;
  Response result{0.5 * strain.dot(force), G.transpose() * force, G.transpose() * C * G};
  const Eigen::Vector4d mixed = L_angle.transpose() * force - force.dot(h) / r * d_trace;
  result.tangent += mixed * t.transpose() + t * mixed.transpose();
  result.tangent += force.dot(h_angle) * t * t.transpose();
  return result;
}
} // namespace

LawOfPhase::LawOfPhase(const Law law, const Eigen::Matrix3d &stiffness)
    : law(law)
    , C(stiffness)
{
  if (is_of_yarns(law))
    yarns = meshes::yarn_axes(C);
}

Response LawOfPhase::response(const Eigen::Matrix2d &F) const
{
  switch (law)
  {
  case Law::linear:
    return linear_response(C, F);
  case Law::green:
    return green_response(C, F);
  case Law::yarn:
    return yarns.are_there ? yarn_response(yarns, F) : biot_response(C, F);
  case Law::biot:
    return biot_response(C, F);
  }
  throw std::logic_error("a law without a response");
}

Response response(const Law law, const Eigen::Matrix3d &C, const Eigen::Matrix2d &F)
{
  return LawOfPhase(law, C).response(F);
}

Eigen::Matrix4d positive_part(const Eigen::Matrix4d &tangent)
{
  return meshes::positive_part<4>(tangent);
}
} // namespace homespun::verification
