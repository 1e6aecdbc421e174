// SPDX-License-Identifier: MIT
#include "verification/method/coarse_parts.h"

#include "meshes/plain/errors.h"

namespace homespun::verification
{
namespace
{
std::vector<meshes::CubicForm> cubic_of(const meshes::HomogenizedCell &cell, const Method &method,
                                        const Law law)
{
  if (!method.is_of_second_order(law))
    return {};
  const auto found = cell.second_order.find(name_of(law));
  if (found == cell.second_order.end())
    throw meshes::BadInput("method " + method.name +
                           ": the cell has no second order under the law `" + name_of(law) +
                           "`: make its cell.h5 again with `homespun homogenize`, or leave the "
                           "method out");
  if (!method.has(Term::cubic))
    return {};
  return {found->second.energy};
}
} // namespace

template <int dim>
CoarseParts<dim>::CoarseParts(const CellModel &cell, const meshes::Sheet &sheet,
                              const Method &method, const Law law, const EdgeKinds &kinds,
                              const std::optional<Quads> &quads)
    : space(sheet, element_of(method), quads)
    , cubic(cubic_of(cell.cell, method, law))
    , options(options_of(method, law, cell, kinds))
{
  if (method.has(Term::edges))
    edges.emplace(cell, sheet, space, kinds, law);
}

template struct CoarseParts<2>;
template struct CoarseParts<3>;
} // namespace homespun::verification
