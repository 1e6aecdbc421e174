// SPDX-License-Identifier: MIT
#include "meshes/plain/fitted_modes.h"

namespace homespun::meshes
{
namespace
{
/// f_j of some strains abreast.
/// @tparam Numbers of Eigen, one for each strain
template <typename Numbers>
std::array<Numbers, FittedModes::n_functions> functions_of(const std::array<Numbers, 3> &strain,
                                                           const Eigen::Vector3d &knees)
{
  std::array<std::array<Numbers, 3>, 3> power; // s_1, s_2, s_3, each to 0, 1, 2
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double knee = knees(static_cast<Eigen::Index>(a));
    power[a][0].setOnes();
    power[a][1] =
      a == 2 ? Numbers(strain[a] / knee) : Numbers(strain[a] / (knee + strain[a].abs()));
    power[a][2] = power[a][1].square();
  }
  std::array<Numbers, FittedModes::n_functions> values;
  std::size_t j = 0;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t p = 0; p <= 2; ++p)
      for (std::size_t q = 0; p + q <= 2; ++q)
        for (std::size_t r = p + q == 0 ? 1 : 0; p + q + r <= 2; ++r)
          values[j++] = strain[a] * power[0][p] * power[1][q] * power[2][r];
  return values;
}
} // namespace

Eigen::Matrix<double, 1, FittedModes::n_functions> fitted_functions(const Eigen::Vector3d &strain,
                                                                    const Eigen::Vector3d &knees)
{
  using One         = Eigen::Array<double, 1, 1>;
  const auto values = functions_of<One>({One(strain(0)), One(strain(1)), One(strain(2))}, knees);
  Eigen::Matrix<double, 1, FittedModes::n_functions> row;
  for (std::size_t j = 0; j < values.size(); ++j)
    row(static_cast<Eigen::Index>(j)) = values[j].value();
  return row;
}

FittedResponse::FittedResponse(const FittedModes &fitted)
    : low(fitted.low)
    , high(fitted.high)
    , knees(fitted.knees)
{
  of_functions << fitted.of_strain, fitted.coefficients;
}

std::array<FittedResponse::Pack, FittedResponse::size>
FittedResponse::at(const std::array<Pack, 3> &strains) const
{
  std::array<Pack, 3> in_box;
  for (std::size_t a = 0; a < 3; ++a)
    in_box[a] =
      strains[a].max(low(static_cast<Eigen::Index>(a))).min(high(static_cast<Eigen::Index>(a)));
  const auto functions = functions_of(in_box, knees);
  std::array<Pack, size> sums;
  for (std::size_t k = 0; k < size; ++k)
    sums[k] = k < 3 ? strains[k] : Pack(Pack::Zero());
  for (std::size_t j = 0; j < functions.size(); ++j)
    for (std::size_t k = 0; k < size; ++k)
      sums[k] +=
        of_functions(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) * functions[j];
  return sums;
}

Eigen::Matrix<double, 1, FittedResponse::size>
FittedResponse::at(const Eigen::Vector3d &strain) const
{
  std::array<Pack, 3> strains;
  for (std::size_t a = 0; a < 3; ++a)
    strains[a].setConstant(strain(static_cast<Eigen::Index>(a)));
  const auto sums = at(strains);
  Eigen::Matrix<double, 1, size> row;
  for (std::size_t k = 0; k < size; ++k)
    row(static_cast<Eigen::Index>(k)) = sums[k](0);
  return row;
}
} // namespace homespun::meshes
