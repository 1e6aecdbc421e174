// SPDX-License-Identifier: MIT
// What up-sampling is worth, apart from the coarse cloth it is done on, and the claims of kind
// method. The base of a method is its coarse cloth without microscopic displacement: against that
// one alone a gain is of up-sampling, and a cell of one material has none.
#pragma once

#include "verification/record/verdict.h"
#include "verification/strain/strain_tables.h"

#include <set>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The base of a row's method: of the rows of its level that have its terms but for `micro`, and,
/// where it has the term `p2`, of `affine+p2`, the one with the smaller error. Of `full` that is
/// the better of `full-micro` and `affine+p2`, because terms of edges clamp the coarse cloth beside
/// the drawn edge, which without microscopic displacement may err more than no term; of `localized`
/// it is `affine`.
/// @return nullptr where the rows have none with an error
const StrainRow *base_of(const std::vector<StrainRow> &rows, const StrainRow &of);

/// Rows of gains.csv, of every method with a base.
std::vector<GainRow> gain_rows(const std::vector<StrainRow> &rows);

/// The asked strains at which methods are judged: the one near 1 % and the largest up to 10 %.
std::set<double> strains_of_methods(const std::vector<double> &asked);

/// A claim for each level at which methods are judged, the asked one nearest to 1 % (within a
/// factor 1.5) and the largest up to 10 %, and each of these pairs that the study has: the method
/// that it speaks of is closer to the reference than its base, `localized` than `affine`, and the
/// former than `localized`; by more than the error bars of both, which hold whatever method and
/// reference share, so that their sum is safe by the triangle inequality. FAIL where it is farther
/// by more than that. Open within the bars; where one is not known or rests on distances that do
/// not fall along its ladder; where the base is not among the methods; and, with the
/// strain of loss or else the last strain that was reached as value, where the law is lost at this
/// level or the level was not reached.
/// @param rows of strain.csv, of_case one of them
/// @param asked strains of the study, ascending
/// @param methods of the study, which are spoken of where no level was reached
/// @param lost strain from which on the law is lost; not a number where it never is
std::vector<Verdict> method_verdicts(const std::vector<StrainRow> &rows, const StrainRow &of_case,
                                     const std::vector<double> &asked,
                                     const std::vector<std::string> &methods, double lost);

/// The same of a method that is none of the program's, at all its levels: that it is closer than
/// `affine`, and than `localized`.
std::vector<Verdict> verdicts_of_own_method(const std::vector<StrainRow> &rows,
                                            const StrainRow &of_case, double lost);
} // namespace homespun::verification
