// SPDX-License-Identifier: MIT
#include "verification/strain/ellipticity_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
constexpr double none = std::numeric_limits<double>::quiet_NaN();
} // namespace

double strain_of_loss(const std::vector<EllipticityRow> &rows)
{
  std::vector<EllipticityRow> sorted = rows;
  std::sort(sorted.begin(), sorted.end(),
            [](const EllipticityRow &a, const EllipticityRow &b) { return a.strain < b.strain; });
  double strain = 0., least = 1.;
  for (const EllipticityRow &row : sorted)
  {
    if (row.lost > 0)
      return strain + (row.strain - strain) * least / (least - row.least);
    strain = row.strain;
    least  = row.least;
  }
  return none;
}

double elliptic_up_to(const std::vector<EllipticityRow> &all, const std::string &cell,
                      const std::string &load, const std::string &reference)
{
  std::vector<std::string> parts;
  for (const EllipticityRow &row : all)
    if (std::find(parts.begin(), parts.end(), row.part) == parts.end())
      parts.push_back(row.part);
  double first = none;
  for (const std::string &part : parts)
  {
    std::vector<EllipticityRow> rows;
    for (const EllipticityRow &row : all)
      if (row.cell == cell && row.load == load && row.reference == reference && row.part == part)
        rows.push_back(row);
    first = std::fmin(first, strain_of_loss(rows));
  }
  return first;
}
} // namespace homespun::verification
