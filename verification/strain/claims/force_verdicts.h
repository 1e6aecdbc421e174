// SPDX-License-Identifier: MIT
// Claims on forces.csv that hold whatever the cell: what theory says of the forces of a load, and
// of how far it moves.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/record/verdict.h"
#include "verification/strain/strain_options.h"
#include "verification/strain/strain_tables.h"

#include <vector>

namespace homespun::verification
{
/// The smallest strain and the next one that is at least twice as large, both up to 1 %; empty
/// where there are no two.
std::vector<double> small_strains(const std::vector<double> &asked);

/// The force per width of a row with these keys; not a number where there is none [N/m].
double per_width_of(const std::vector<ForceRow> &rows, const ForceRow &of);

/// For every cell and sheet load in linear theory: the reference pulls back, with a force no larger
/// than that of the affine motion, which is one of the motions it may choose.
std::vector<Verdict> verdicts_of_forces(const std::vector<ForceRow> &rows);

/// Whether the law is not lost up to the strain of a row, and its case has no equilibrium up to
/// there that is no minimum or that another one was taken for.
bool is_sound_up_to(const std::vector<LevelRow> &levels, const ForceRow &of);

/// Whether a study asks for verdicts_of_laws() on a law.
bool has_claim_on_laws(const StrainStudyOptions &options, Law law);

/// Every law is that of linear theory at rest: at the smallest strain s1 the forces of the resolved
/// cloth, of the coarse one and of the affine motion differ from those of linear theory by a term
/// of first order. It is as large as what changes up to the next strain s2 says, times the factor
/// of safety of two levels, and may be s1 in any case. A claim for every load and law, the worst of
/// the three; open where one of them has no small term of first order, where C^H or a phase is so
/// anisotropic that s2 is not small, where the law is lost or the cloth unstable up to s2, or where
/// a strain was not reached.
/// @param stiffness C^H
std::vector<Verdict> verdicts_of_laws(const std::vector<ForceRow> &rows,
                                      const std::vector<LevelRow> &levels,
                                      const StrainStudyOptions &options,
                                      const homogenization::UnitCell &cell,
                                      const Eigen::Matrix3d &stiffness);

/// What the forces r that references leave, 1e-9 of all, may change of a stress: r.u, hence up to
/// sqrt(contrast) rows 1e-9 of it, with so many rows of triangles along a cell.
double left_in_stress(const homogenization::UnitCell &cell);

/// Nothing turns an infinite cloth: with its mean nominal stress P the moment P Fᵀ is symmetric, in
/// linear theory P itself. A claim for every load that gives F, the worst of all laws, strains and
/// cloths.
std::vector<Verdict> verdicts_of_moments(const std::vector<ForceRow> &rows,
                                         const StrainStudyOptions &options,
                                         const homogenization::UnitCell &cell);

/// Under every sheet load the moving clamp has moved by strain times the distance of the clamps,
/// read off the positions of the resolved and the coarse cloth; open where strains are so small
/// that rounding of positions is more than 1e-7 of the motion.
/// @param cell whose lattice makes the sheet
std::vector<Verdict> verdicts_of_travel(const std::vector<ForceRow> &rows,
                                        const StrainStudyOptions &options,
                                        const homogenization::UnitCell &cell);
} // namespace homespun::verification
