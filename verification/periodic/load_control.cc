// SPDX-License-Identifier: MIT
#include "verification/periodic/load_control.h"

#include "homogenization/cell/parameter_text.h"
#include "meshes/plain/errors.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
constexpr std::array<const char *, 3> names = {"11", "22", "12"};

/// A number, or a percentage where that has a meaning; not a number where the text is neither.
double number_of(const std::string &text, const bool is_percentage)
{
  const auto found = homogenization::numbers(text.substr(0, text.size() - (is_percentage ? 1 : 0)));
  if (!found || found->size() != 1)
    return std::numeric_limits<double>::quiet_NaN();
  return is_percentage ? (*found)[0] / 100. : (*found)[0];
}

/// What is wrong with a strain; empty where nothing is.
std::string fault_of_strain(const std::string &name, const double value, const bool is_percentage)
{
  if (name != "12" && value <= -1.)
    return short_text(value) + "; expected more than -1, where nothing is left of the cloth";
  if (!is_percentage && std::abs(value) >= 0.5)
    return short_text(value) + ", which is " + short_text(100. * value) +
           " %; if percent was meant, write " + name + "=" + short_text(value) + "%, and else " +
           name + "=" + short_text(100. * value) + "%";
  return "";
}

/// Reads one option into a control.
void read(LoadControl &control, const std::string &option, const std::vector<std::string> &entries,
          std::vector<std::string> &faults)
{
  const bool is_stress = option == "--stress";
  for (const std::string &entry : entries)
  {
    const std::size_t sign = entry.find('=');
    const auto name        = std::find(names.begin(), names.end(), entry.substr(0, sign));
    if (sign == std::string::npos || name == names.end())
    {
      faults.push_back(option + ": found `" + entry +
                       "`; expected COMPONENT=VALUE with the component 11, 22 or 12, like " +
                       (is_stress ? "11=50 in N/m" : "22=0.02 or 22=2%"));
      continue;
    }
    const auto k             = static_cast<std::size_t>(name - names.begin());
    const std::string text   = entry.substr(sign + 1);
    const bool is_percentage = !is_stress && !text.empty() && text.back() == '%';
    const double value       = number_of(text, is_percentage);
    const std::string what   = option + ", component " + *name + ": found ";
    if (!std::isfinite(value))
      faults.push_back(what + "`" + text + "`; expected a number with a decimal point" +
                       (is_stress ? " in N/m" : ", or a percentage like 2%"));
    else if (control.is_given[k])
      faults.push_back(option + ": found component " + *name +
                       " a second time; expected its stress or its strain, once");
    else if (!is_stress)
      if (const std::string fault = fault_of_strain(*name, value, is_percentage); !fault.empty())
        faults.push_back(what + fault);
    control.is_given[k]                 = true;
    control.is_stress[k]                = is_stress;
    control.value(static_cast<long>(k)) = value;
  }
}
} // namespace

int LoadControl::place(const int component) const
{
  return component == 0 ? 0 : component == 1 ? 3 : axis == 1 ? 1 : 2;
}

Eigen::Matrix2d LoadControl::gradient(const Eigen::Vector3d &strain) const
{
  Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
  for (int k = 0; k < 3; ++k)
    F(place(k) / 2, place(k) % 2) += strain(k);
  return F;
}

Eigen::Vector3d LoadControl::strain(const Eigen::Matrix2d &F) const
{
  Eigen::Vector3d e;
  for (int k = 0; k < 3; ++k)
    e(k) = F(place(k) / 2, place(k) % 2) - (k < 2 ? 1. : 0.);
  return e;
}

Eigen::Vector3d LoadControl::stress(const Eigen::Vector4d &P) const
{
  return {P(place(0)), P(place(1)), P(place(2))};
}

DeadLoads LoadControl::dead_loads(const double factor) const
{
  const long n = std::count(is_stress.begin(), is_stress.end(), true);
  DeadLoads loads{Eigen::Matrix<double, 4, Eigen::Dynamic>::Zero(4, n), Eigen::VectorXd(n)};
  long column = 0;
  for (int k = 0; k < 3; ++k)
    if (is_stress[static_cast<std::size_t>(k)])
    {
      loads.directions(place(k), column) = 1.;
      loads.stresses(column++)           = factor * value(k);
    }
  return loads;
}

std::string LoadControl::text() const
{
  std::string words;
  for (std::size_t k = 0; k < names.size(); ++k)
  {
    const double amount = value(static_cast<long>(k));
    words += words.empty() ? "" : ", ";
    if (is_stress[k] && amount == 0.)
      words += std::string(names[k]) + " free of stress";
    else
      words += (is_stress[k] ? "stress " : "strain ") + std::string(names[k]) + " = " +
               short_text(amount) + (is_stress[k] ? " N/m" : "");
  }
  return words;
}

LoadControl load_control(const Load &load)
{
  if (!load.is_periodic())
    throw meshes::BadInput("load: found `" + load.name +
                           "`, which is one of a sheet; expected one of an infinite cloth: "
                           "periodic-11, periodic-22, periodic-12, uniaxial-1 or uniaxial-2");
  LoadControl control;
  control.axis      = load.axis() + 1;
  control.is_stress = {false, false, false};
  if (load.has_free_sides())
  {
    control.is_stress          = {load.axis() != 0, load.axis() != 1, true};
    control.value(load.axis()) = 1.;
  }
  else
    control.value = control.strain(load.gradient(1.));
  return control;
}

LoadControl load_control(const std::vector<std::string> &stresses,
                         const std::vector<std::string> &strains, const int axis)
{
  LoadControl control;
  control.axis = axis;
  std::vector<std::string> faults;
  read(control, "--stress", stresses, faults);
  read(control, "--strain", strains, faults);
  if (faults.empty() && control.value == Eigen::Vector3d::Zero())
    faults.push_back("--stress, --strain: found nothing but zeros; expected at least one value, "
                     "like --strain 11=0.1");
  if (!faults.empty())
    throw meshes::BadInput(faults);
  if (axis == 0)
    control.axis = control.value(0) == 0. && control.value(1) != 0. ? 2 : 1;
  return control;
}
} // namespace homespun::verification
