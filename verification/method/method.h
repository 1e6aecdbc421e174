// SPDX-License-Identifier: MIT
// Methods of a study: which of them differ under a law and load, and which one it speaks of.
#pragma once

#include "localization/method.h"
#include "verification/reference/loads.h"

#include <string>
#include <vector>

namespace homespun::verification
{
using localization::Method;
using localization::Term;
using meshes::Law;

/// A method without what has no meaning under a law and load. Loads act in the plane, where no
/// surface is curved. In an infinite cloth there are no edges, and the motion of the coarse cloth
/// is given: without micro nothing but `affine` is left.
Method under(const Method &method, Law law, const Load &load);

/// The methods of a list that differ under a law and load: of those with the same terms the first,
/// presets in their own order before others.
/// @throws BadInput as Method
std::vector<std::string> distinct_methods(const std::vector<std::string> &names, Law law,
                                          const Load &load);

/// Those that have a meaning under one of several laws.
std::vector<std::string> distinct_methods(const std::vector<std::string> &names,
                                          const std::vector<Law> &laws, const Load &load);

/// The method of a list that claims, range of validity and pages speak of: the highest of rank, of
/// several the one whose terms come last; `localized` where none has micro.
std::string main_method(const std::vector<std::string> &names);

/// The same of the rows of one case that were reached.
/// @param rows with the columns `cell`, `load`, `reference` and `method`
template <typename Row>
std::string main_method(const std::vector<Row> &rows, const Row &of_case)
{
  std::vector<std::string> methods;
  for (const Row &row : rows)
    if (row.is_reached() && row.cell == of_case.cell && row.load == of_case.load &&
        row.reference == of_case.reference)
      methods.push_back(row.method);
  return main_method(methods);
}
} // namespace homespun::verification
