// SPDX-License-Identifier: MIT
#include "shell/membrane/triangle_packs.h"

#include <algorithm>
#include <numeric>

namespace homespun::shell
{
namespace
{
using Pack    = TrianglePacks::Pack;
using Vector3 = std::array<Pack, 3>;

Pack dot(const Vector3 &a, const Vector3 &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3 cross(const Vector3 &a, const Vector3 &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// a x + b y.
Vector3 combined(const Vector3 &x, const Pack &a, const Vector3 &y, const Pack &b)
{
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}

/// Symmetric 3 x 3 in the order 11, 22, 33, 12, 13, 23, times a vector.
Vector3 times(const std::array<Pack, 6> &D, const Vector3 &x)
{
  return {D[0] * x[0] + D[3] * x[1] + D[4] * x[2], D[3] * x[0] + D[1] * x[1] + D[5] * x[2],
          D[4] * x[0] + D[5] * x[1] + D[2] * x[2]};
}

/// In the plane, the second derivative over (Z11, Z22, Z12 + Z21, β): D, its last column and its
/// last entry; out of the plane S11, S22, S12. See TurnedHessian of corotational_energy.cc.
struct Turned
{
  Vector3 column;
  Pack last, S11, S22, S12;
};

/// S with its compression set to zero.
void keep_tension(Turned &turned)
{
  const Pack mean = 0.5 * (turned.S11 + turned.S22), half = 0.5 * (turned.S11 - turned.S22),
             radius = (half.square() + turned.S12.square()).sqrt();
  const Pack larger = 0.5 * (mean + radius).max(0.), ratio = (radius > 0.).select(1. / radius, 0.);
  const auto is_tension = (mean - radius >= 0.).eval();
  turned.S11            = is_tension.select(turned.S11, larger * (1. + half * ratio));
  turned.S22            = is_tension.select(turned.S22, larger * (1. - half * ratio));
  turned.S12            = is_tension.select(turned.S12, larger * turned.S12 * ratio);
}
} // namespace

/// The polar decomposition of the triangles of a pack, and what follows of strain and stress.
struct TrianglePacks::State
{
  Vector3 d1, d2, R1, R2, normal, strain, stress, turning;
  Pack p, J, U1, U2, U12;
  Lanes irregular;
  bool any_irregular = false;
};

TrianglePacks::TrianglePacks(const Membrane &membrane)
    : triangles(membrane.triangles)
    , rest_triangles(membrane.rest)
    , phase(membrane.phase)
    , packs((membrane.rest.size() + size - 1) / size)
{
  for (int p = 0; p < n_packs(); ++p)
    for (int lane = 0; lane < size; ++lane)
    { // lanes behind the last triangle repeat it
      const auto t    = static_cast<std::size_t>(std::min(p * size + lane, n_triangles() - 1));
      Rest &pack      = packs[static_cast<std::size_t>(p)];
      const auto &g   = rest_triangles[t].shape_gradients;
      pack.area(lane) = rest_triangles[t].area;
      pack.g1x(lane)  = g(1, 0);
      pack.g1y(lane)  = g(1, 1);
      pack.g2x(lane)  = g(2, 0);
      pack.g2y(lane)  = g(2, 1);
    }
  set_stiffness(membrane.stiffness);
  set_initial_stress({});
}

void TrianglePacks::set_stiffness(const std::vector<MembraneStiffness> &values)
{
  stiffness = values;
  for (int p = 0; p < n_packs(); ++p)
    for (int lane = 0; lane < size; ++lane)
    {
      const auto t = static_cast<std::size_t>(std::min(p * size + lane, n_triangles() - 1));
      const MembraneStiffness &one = stiffness[static_cast<std::size_t>(phase[t])];
      Rest &pack                   = packs[static_cast<std::size_t>(p)];
      constexpr std::array<std::array<int, 2>, 6> entries = {
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
      for (std::size_t e = 0; e < 6; ++e)
      {
        pack.D[e](lane)       = one.D(entries[e][0], entries[e][1]);
        pack.inverse[e](lane) = one.inverse(entries[e][0], entries[e][1]);
      }
    }
}

void TrianglePacks::set_stiffness_of_triangles(const std::vector<MembraneStiffness> &values)
{
  std::iota(phase.begin(), phase.end(), 0);
  set_stiffness(values);
}

void TrianglePacks::set_initial_stress(const std::vector<Eigen::Vector3d> &stresses)
{
  initial_stress = stresses;
  for (int p = 0; p < n_packs(); ++p)
    for (int k = 0; k < 3; ++k)
      for (int lane = 0; lane < size; ++lane)
      {
        const auto t = static_cast<std::size_t>(std::min(p * size + lane, n_triangles() - 1));
        packs[static_cast<std::size_t>(p)].initial_stress[static_cast<std::size_t>(k)](lane) =
          stresses.empty() ? 0. : stresses[t](k);
      }
}

Eigen::Matrix3d TrianglePacks::corners_of(const int t, const Positions<3> &positions) const
{
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k)
    corners.row(k) = positions.row(triangles(t, k));
  return corners;
}

TrianglePacks::State TrianglePacks::state(const int pack, const Positions<3> &positions) const
{
  const Rest &rest = packs[static_cast<std::size_t>(pack)];
  State s;
  for (int lane = 0; lane < size; ++lane)
  {
    const int t      = std::min(pack * size + lane, n_triangles() - 1);
    const double *x0 = positions.data() + 3 * static_cast<Eigen::Index>(triangles(t, 0)),
                 *x1 = positions.data() + 3 * static_cast<Eigen::Index>(triangles(t, 1)),
                 *x2 = positions.data() + 3 * static_cast<Eigen::Index>(triangles(t, 2));
    for (std::size_t i = 0; i < 3; ++i)
    {
      s.d1[i](lane) = x1[i] - x0[i];
      s.d2[i](lane) = x2[i] - x0[i];
    }
  }
  const Vector3 f1 = combined(s.d1, rest.g1x, s.d2, rest.g2x),
                f2 = combined(s.d1, rest.g1y, s.d2, rest.g2y), n = cross(f1, f2);
  const Pack C11 = dot(f1, f1), C22 = dot(f2, f2), trace = C11 + C22;
  s.J                   = dot(n, n).sqrt();
  const auto is_regular = (s.J > 1e-14 * trace && trace < 1e300).eval();
  s.any_irregular       = !is_regular.all();
  for (int lane = 0; lane < size; ++lane)
    s.irregular[static_cast<std::size_t>(lane)] = !is_regular(lane);
  s.p               = 1. / (trace + 2. * s.J).sqrt();
  s.U1              = s.p * (C11 + s.J);
  s.U2              = s.p * (C22 + s.J);
  s.U12             = s.p * dot(f1, f2);
  const Pack over_J = 1. / s.J;
  for (std::size_t i = 0; i < 3; ++i)
    s.normal[i] = n[i] * over_J;
  const Vector3 c1 = cross(f2, s.normal), c2 = cross(s.normal, f1); // dJ/dF
  for (std::size_t i = 0; i < 3; ++i)
  {
    s.R1[i] = s.p * (f1[i] + c1[i]);
    s.R2[i] = s.p * (f2[i] + c2[i]);
  }
  s.strain  = {s.U1 - 1., s.U2 - 1., 2. * s.U12};
  s.stress  = times(rest.D, s.strain);
  s.turning = {s.p * s.U12, -s.p * s.U12, s.p * (s.U2 - s.U1)};
  return s;
}

void TrianglePacks::strains(const Positions<3> &positions, std::vector<Eigen::Vector3d> &all) const
{
  all.resize(rest_triangles.size());
  for (int p = 0; p < n_packs(); ++p)
  {
    const State s = state(p, positions);
    for (int lane = 0; lane < size && p * size + lane < n_triangles(); ++lane)
    {
      const int t = p * size + lane;
      all[static_cast<std::size_t>(t)] =
        s.irregular[static_cast<std::size_t>(lane)]
          ? biot_strain<3>(deformation_gradient<3>(rest_triangles[static_cast<std::size_t>(t)],
                                                   corners_of(t, positions)))
          : Eigen::Vector3d(s.strain[0](lane), s.strain[1](lane), s.strain[2](lane));
    }
  }
}

double TrianglePacks::scalar_energy(const int t, const Positions<3> &positions) const
{
  const auto at = static_cast<std::size_t>(t);
  const Eigen::Vector3d e =
    biot_strain<3>(deformation_gradient<3>(rest_triangles[at], corners_of(t, positions)));
  const Eigen::Matrix3d &D = stiffness[static_cast<std::size_t>(phase[at])].D;
  return rest_triangles[at].area *
         (0.5 * e.dot(D * e) + (initial_stress.empty() ? 0. : initial_stress[at].dot(e)));
}

double TrianglePacks::energy(const Positions<3> &positions) const
{
  Pack sum         = Pack::Zero();
  double irregular = 0.;
  for (int p = 0; p < n_packs(); ++p)
  {
    const Rest &rest = packs[static_cast<std::size_t>(p)];
    const State s    = state(p, positions);
    const int last   = n_triangles() - p * size;
    Pack own = rest.area * (0.5 * dot(s.strain, s.stress) + dot(s.strain, rest.initial_stress));
    if (s.any_irregular || last < size)
      for (int lane = 0; lane < size; ++lane)
        if (lane >= last || s.irregular[static_cast<std::size_t>(lane)])
        {
          own(lane) = 0.;
          irregular += lane < last ? scalar_energy(p * size + lane, positions) : 0.;
        }
    sum += own;
  }
  return sum.sum() + irregular;
}

TriangleDerivatives<3> TrianglePacks::scalar_derivatives(const int t, const Positions<3> &positions,
                                                         const Hessian kind) const
{
  const auto at = static_cast<std::size_t>(t);
  return triangle_derivatives<3>(
    rest_triangles[at], corners_of(t, positions), stiffness[static_cast<std::size_t>(phase[at])],
    kind, initial_stress.empty() ? Eigen::Vector3d::Zero().eval() : initial_stress[at]);
}

TrianglePacks::Lanes TrianglePacks::pack_derivatives(const int pack, const Positions<3> &positions,
                                                     const Hessian kind, Derivatives &result) const
{
  const Rest &rest = packs[static_cast<std::size_t>(pack)];
  const State s    = state(pack, positions);
  Vector3 T        = s.stress;
  for (std::size_t k = 0; k < 3; ++k)
    T[k] += rest.initial_stress[k];
  const Vector3 &c = s.turning;
  const Pack skew  = dot(c, T);

  // First Piola-Kirchhoff stress in the turned frame, P = (T1, T12 - skew; T12 + skew, T2).
  const Pack P12 = T[2] - skew, P21 = T[2] + skew;
  const Vector3 P1 = combined(s.R1, T[0], s.R2, P21), P2 = combined(s.R1, P12, s.R2, T[1]);
  for (std::size_t i = 0; i < 3; ++i)
  {
    result.gradient[1][i] = rest.area * (rest.g1x * P1[i] + rest.g1y * P2[i]);
    result.gradient[2][i] = rest.area * (rest.g2x * P1[i] + rest.g2y * P2[i]);
    result.gradient[0][i] = -(result.gradient[1][i] + result.gradient[2][i]);
  }

  Turned turned;
  const Vector3 q = {-s.p * P21, s.p * P12, 0.5 * s.p * (T[0] - T[1])}, Dc = times(rest.D, c);
  Pack kappa = s.p * (T[0] + T[1] - s.p * (T[0] * s.U1 + T[1] * s.U2 + 2. * T[2] * s.U12));
  if (kind == Hessian::projected)
    kappa = kappa.max(2. * dot(c, q) + dot(q, times(rest.inverse, q)));
  for (std::size_t k = 0; k < 3; ++k)
    turned.column[k] = Dc[k] + q[k];
  turned.last       = dot(c, Dc) + kappa;
  const Pack over_J = 1. / s.J;
  turned.S11        = over_J * (s.U2 * T[0] - s.U12 * P21);
  turned.S22        = over_J * (s.U1 * T[1] - s.U12 * P12);
  turned.S12        = over_J * (s.U2 * P12 - s.U12 * T[1]);
  if (kind == Hessian::projected)
    keep_tension(turned);

  // Blocks of corners with the hat gradients g and h: B(g)^T A B(h) turned into space, and S.
  const auto block =
    [&](const Pack &gx, const Pack &gy, const Pack &hx, const Pack &hy, std::array<Pack, 9> &into)
  {
    const auto &D = rest.D;
    const auto &w = turned.column;
    // A B(h), columns: displacement of h's corner along r1, along r2.
    const std::array<Pack, 4> a1 = {D[0] * hx + D[4] * hy - w[0] * hy,
                                    D[3] * hx + D[5] * hy - w[1] * hy,
                                    D[4] * hx + D[2] * hy - w[2] * hy,
                                    w[0] * hx + w[2] * hy - turned.last * hy},
                              a2 = {D[3] * hy + D[4] * hx + w[0] * hx,
                                    D[1] * hy + D[5] * hx + w[1] * hx,
                                    D[5] * hy + D[2] * hx + w[2] * hx,
                                    w[1] * hy + w[2] * hx + turned.last * hx};
    const Pack m11 = gx * a1[0] + gy * (a1[2] - a1[3]), m12 = gx * a2[0] + gy * (a2[2] - a2[3]),
               m21 = gy * a1[1] + gx * (a1[2] + a1[3]), m22 = gy * a2[1] + gx * (a2[2] + a2[3]),
               out       = rest.area * (gx * (turned.S11 * hx + turned.S12 * hy) +
                                  gy * (turned.S12 * hx + turned.S22 * hy));
    const Vector3 first  = combined(s.R1, rest.area * m11, s.R2, rest.area * m21),
                  second = combined(s.R1, rest.area * m12, s.R2, rest.area * m22);
    for (std::size_t j = 0; j < 3; ++j)
    {
      const Pack along = out * s.normal[j];
      for (std::size_t i = 0; i < 3; ++i)
        into[3 * j + i] = first[i] * s.R1[j] + second[i] * s.R2[j] + along * s.normal[i];
    }
  };
  auto &blocks = result.blocks;
  block(rest.g1x, rest.g1y, rest.g1x, rest.g1y, blocks[3]);
  block(rest.g1x, rest.g1y, rest.g2x, rest.g2y, blocks[4]);
  block(rest.g2x, rest.g2y, rest.g2x, rest.g2y, blocks[5]);
  // Those of corner 0 are minus the sums of the others: a translation costs nothing, to round-off.
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t ij = 3 * j + i, ji = 3 * i + j;
      blocks[1][ij] = -(blocks[3][ij] + blocks[4][ji]);
      blocks[2][ij] = -(blocks[4][ij] + blocks[5][ij]);
    }
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i)
      blocks[0][3 * j + i] = -(blocks[1][3 * i + j] + blocks[2][3 * i + j]);
  return s.irregular;
}

TriangleDerivatives<3> TrianglePacks::Derivatives::of_lane(const int lane) const
{
  TriangleDerivatives<3> one;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      one.gradient(k, i) = gradient[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)](lane);
  for (std::size_t b = 0; b < 6; ++b)
    for (int e = 0; e < 9; ++e)
      one.blocks[b].data()[e] = blocks[b][static_cast<std::size_t>(e)](lane);
  return one;
}

std::size_t TrianglePacks::bytes() const
{
  return packs.size() * sizeof(Rest) +
         rest_triangles.size() * (sizeof(RestTriangle) + 4 * sizeof(int)) +
         initial_stress.size() * sizeof(Eigen::Vector3d);
}
} // namespace homespun::shell
