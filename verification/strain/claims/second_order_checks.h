// SPDX-License-Identifier: MIT
// What a cell does at second order in strain, held against cells that are solved at finite strain,
// for a strain to which all ten numbers of the cubic energy and all quadratic modes contribute. The
// loads of a study see a few of them, one at a time.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/homogenized_cell.h"
#include "verification/record/verdict.h"

#include <vector>

namespace homespun::verification
{
/// Two claims of each law of which the homogenized cell has second order.
///
/// `second-order`: with S(e) the mean stress and w(e) the fluctuation of NonlinearCell,
///   [S(s e) + S(−s e)] / 2 s² -> dW3/de (e),   [w(s e) + w(−s e)] / 2 s² -> w2(e)   for s -> 0
/// with order 2, where e has all three components, W3 is the cubic energy and w2 what up-sampling
/// adds to a cloth that is stretched by 1 + s e and by 1 − s e, the mean of both over s². From two
/// s the limit is extrapolated; what that changes is the error of the last s. Open for cells of
/// more than 20,000 triangles.
///
/// `cubic-guard`: the coarse cloth keeps two thirds of its stiffness as far as the cubic energy is
/// undamped, and a tenth beyond, guarded_cubic.h; the least that is found over directions and
/// sizes.
std::vector<Verdict> second_order_checks(const homogenization::UnitCell &cell,
                                         const meshes::HomogenizedCell &homogenized);
} // namespace homespun::verification
