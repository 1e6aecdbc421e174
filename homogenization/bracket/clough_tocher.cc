// SPDX-License-Identifier: MIT
#include "homogenization/bracket/clough_tocher.h"

#include "meshes/plain/gauss_rule.h"

#include <Eigen/LU>

namespace homespun::homogenization
{
CloughTocher::CloughTocher(const std::array<Eigen::Vector2d, 3> &vertices,
                           const std::array<Eigen::Vector2d, 3> &normals)
{
  const Eigen::Vector2d centroid = (vertices[0] + vertices[1] + vertices[2]) / 3.;
  /// The ordinate a third of the way from a vertex along a direction: value + gradient . third.
  const auto towards = [](const std::size_t vertex, const Eigen::Vector2d &third)
  {
    Row row                                                   = Row::Zero();
    row(static_cast<Eigen::Index>(3 * vertex))                = 1.;
    row.segment<2>(static_cast<Eigen::Index>(3 * vertex + 1)) = third.transpose();
    return row;
  };
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t next = (k + 1) % 3;
    corners[k]             = towards(k, Eigen::Vector2d::Zero());
    spokes[k]              = towards(k, (centroid - vertices[k]) / 3.);
    sides[k]               = {towards(k, (vertices[next] - vertices[k]) / 3.),
                              towards(next, (vertices[k] - vertices[next]) / 3.)};
    Eigen::Matrix2d legs;
    legs << vertices[next] - vertices[k], centroid - vertices[k];
    const Eigen::Matrix2d inverse = legs.inverse();
    gradients[k].col(1)           = inverse.row(0).transpose();
    gradients[k].col(2)           = inverse.row(1).transpose();
    gradients[k].col(0)           = -gradients[k].col(1) - gradients[k].col(2);
  }
  // The derivative along the normal n at the middle of a side A B of the piece A B C, with the
  // barycentric direction (a, b, c) of n, is
  //   3 [¼ (a b300 + b b210 + c b201) + ½ (a b210 + b b120 + c b111)
  //      + ¼ (a b120 + b b030 + c b021)],
  // which gives b111, the ordinate over the middle of the side.
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t next          = (k + 1) % 3;
    const Eigen::RowVector3d normal = normals[k].transpose() * gradients[k];
    const double a = normal(0), b = normal(1), c = normal(2);
    Row derivative                               = Row::Zero();
    derivative(static_cast<Eigen::Index>(9 + k)) = 1.;
    const Row rest = 0.25 * (a * corners[k] + b * sides[k][0] + c * spokes[k]) +
                     0.5 * (a * sides[k][0] + b * sides[k][1]) +
                     0.25 * (a * sides[k][1] + b * corners[next] + c * spokes[next]);
    middles[k] = (derivative / 3. - rest) * (2. / c);
  }
  // The centroid weighs the vertices alike: once continuously differentiable across the inner sides
  // means that each ordinate on them is the mean of the one before and of its two neighbours.
  for (std::size_t k = 0; k < 3; ++k)
    inner[k] = (spokes[k] + middles[k] + middles[(k + 2) % 3]) / 3.;
  centre = (inner[0] + inner[1] + inner[2]) / 3.;
}

const CloughTocher::Row &CloughTocher::ordinate(const int piece,
                                                const std::array<int, 3> powers) const
{
  const auto k         = static_cast<std::size_t>(piece);
  const auto next      = (k + 1) % 3;
  const auto [i, j, l] = powers;
  if (l == 3)
    return centre;
  if (l == 2)
    return i == 1 ? inner[k] : inner[next];
  if (l == 1)
    return i == 2 ? spokes[k] : j == 2 ? spokes[next] : middles[k];
  return i == 3 ? corners[k] : j == 3 ? corners[next] : sides[k][i == 2 ? 0 : 1];
}

Eigen::Matrix<double, 3, 12>
CloughTocher::value_and_gradient(const int piece, const Eigen::Vector3d &barycentric) const
{
  // f = sum 3!/(i! j! l!) b_ijl u^i v^j w^l; its derivative by a coordinate takes one power away.
  Row value                                  = Row::Zero();
  Eigen::Matrix<double, 3, 12> by_coordinate = Eigen::Matrix<double, 3, 12>::Zero();
  const auto factorial = [](const int n) { return n < 2 ? 1 : n == 2 ? 2 : 6; };
  const auto power     = [](const double x, const int n) {
    return n == 0 ? 1. : n == 1 ? x : n == 2 ? x * x : x * x * x;
  };
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; i + j <= 3; ++j)
    {
      const std::array<int, 3> powers = {i, j, 3 - i - j};
      const double multiplicity       = 6. / (factorial(i) * factorial(j) * factorial(3 - i - j));
      const Row &b                    = ordinate(piece, powers);
      double monomial                 = multiplicity;
      for (int r = 0; r < 3; ++r)
        monomial *= power(barycentric(r), powers[static_cast<std::size_t>(r)]);
      value += monomial * b;
      for (int r = 0; r < 3; ++r)
        if (powers[static_cast<std::size_t>(r)] > 0)
        {
          double derivative = multiplicity * powers[static_cast<std::size_t>(r)];
          for (int s = 0; s < 3; ++s)
            derivative *= power(barycentric(s), powers[static_cast<std::size_t>(s)] - (s == r));
          by_coordinate.row(r) += derivative * b;
        }
    }
  Eigen::Matrix<double, 3, 12> result;
  result.row(0)          = value;
  result.bottomRows<2>() = gradients[static_cast<std::size_t>(piece)] * by_coordinate;
  return result;
}

Eigen::Matrix<double, 3, 12>
CloughTocher::second_derivatives(const int piece, const Eigen::Vector3d &barycentric) const
{
  // d2f / du_p du_q = 6 sum_r u_r b_(e_r + e_p + e_q) in barycentric coordinates u.
  const auto &G                       = gradients[static_cast<std::size_t>(piece)];
  Eigen::Matrix<double, 3, 12> result = Eigen::Matrix<double, 3, 12>::Zero();
  for (int p = 0; p < 3; ++p)
    for (int q = p; q < 3; ++q)
    {
      Row second = Row::Zero();
      for (int r = 0; r < 3; ++r)
        if (barycentric(r) != 0.)
        {
          std::array<int, 3> powers = {0, 0, 0};
          for (const int s : {p, q, r})
            ++powers[static_cast<std::size_t>(s)];
          second += 6. * barycentric(r) * ordinate(piece, powers);
        }
      const double times = p == q ? 1. : 2.;
      result.row(0) += times * G(0, p) * G(0, q) * second;
      result.row(1) += times * G(1, p) * G(1, q) * second;
      result.row(2) += 0.5 * times * (G(0, p) * G(1, q) + G(0, q) * G(1, p)) * second;
    }
  return result;
}

std::array<Eigen::Matrix<double, 3, 12>, 3>
CloughTocher::second_derivatives_at_corners(const int piece) const
{
  const auto k = static_cast<std::size_t>(piece), next = (k + 1) % 3;
  const auto &G = gradients[k];
  // d2/dx2, d2/dy2 and d2/dxdy of the products u_p u_q of barycentric coordinates, twice those of
  // p < q.
  Eigen::Matrix<double, 3, 6> of_products;
  int column = 0;
  for (int p = 0; p < 3; ++p)
    for (int q = p; q < 3; ++q, ++column)
      of_products.col(column) << (p == q ? 6. : 12.) * G(0, p) * G(0, q),
        (p == q ? 6. : 12.) * G(1, p) * G(1, q),
        (p == q ? 3. : 6.) * (G(0, p) * G(1, q) + G(0, q) * G(1, p));
  using Ordinates = std::array<const Row *, 6>; // e_r + e_p + e_q of the products, in their order
  const std::array<Ordinates, 3> ordinates_of_corner = {
    Ordinates{&corners[k], &sides[k][0], &spokes[k], &sides[k][1], &middles[k], &inner[k]},
    Ordinates{&sides[k][0], &sides[k][1], &middles[k], &corners[next], &spokes[next], &inner[next]},
    Ordinates{&spokes[k], &middles[k], &inner[k], &spokes[next], &inner[next], &centre}};
  std::array<Eigen::Matrix<double, 3, 12>, 3> at_corners;
  for (std::size_t r = 0; r < 3; ++r)
  {
    at_corners[r].setZero();
    for (std::size_t m = 0; m < 6; ++m)
      for (int d = 0; d < 3; ++d)
        at_corners[r].row(d) +=
          of_products(d, static_cast<Eigen::Index>(m)) * *ordinates_of_corner[r][m];
  }
  return at_corners;
}

std::vector<WeightedPoint> points_of_pieces(const int n)
{
  const meshes::GaussRule rule = meshes::gauss_rule(n);
  std::vector<WeightedPoint> points;
  for (int piece = 0; piece < 3; ++piece)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
      {
        const double out = 0.5 * (1. + rule.points(i)), along = 0.5 * (1. + rule.points(j));
        PiecePoint point{piece, {out * (1. - along), out * along, 1. - out}, {}};
        point.in_triangle.setConstant((1. - out) / 3.);
        point.in_triangle(piece) += point.in_piece(0);
        point.in_triangle((piece + 1) % 3) += point.in_piece(1);
        points.push_back({point, rule.weights(i) * rule.weights(j) * out / 6.});
      }
  return points;
}
} // namespace homespun::homogenization
