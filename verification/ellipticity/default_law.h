// SPDX-License-Identifier: MIT
// The law that a cell is studied under where none is asked for: `biot`, that of the coarse cloth's
// corotational element, unless it is no law for the cell's phases at the strains of a study.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/ellipticity/first_loss.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Strains up to which a cloth is up-sampled: a law that is lost below is none for it.
constexpr double largest_strain_of_cloth = 0.2;

/// Where a phase, pulled along one of its yarns, loses ellipticity under `biot`.
struct PhaseLoss
{
  std::string phase;
  double angle  = 0.; ///< of the yarn that is lost first, from axis 1 of the phase [deg], 0 to 180
  double ratio  = 0.; ///< E along that yarn over G in the same axes
  double strain = never; ///< (4 G/E) / (1 − 4 G/E) for E/G > 4
};

/// The same of any stiffness: without a name, the angle from the x axis.
/// @param C (3,3) [N/m], Voigt 11, 22, 12 with engineering shear
PhaseLoss loss_of_biot(const Eigen::Matrix3d &C);

/// "its axis 1", "its axis 2", or how many degrees from axis 1.
std::string axis_text(const PhaseLoss &loss);

/// @return `never` of a phase that is alike in all directions: `biot` is never lost in tension
PhaseLoss loss_of_biot(const homogenization::Phase &phase);

/// The phase that is lost first; `never` where none is, or none has yarns.
PhaseLoss first_loss_of_biot(const homogenization::UnitCell &cell);

/// `yarn` where a phase loses ellipticity under `biot` in tension before 20 %, else `biot`.
///
/// The phases are asked, not C^H: the resolved sheet has minimisers where the law of its triangles
/// has, and it is they that have yarns. Where C^H alone is lost, as that of a lattice of isotropic
/// bars may be, it is the structure of the cell that gives way, which is a result and no fault of
/// the law.
Law default_law(const homogenization::UnitCell &cell);

/// The laws that were asked for, or else the default one.
std::vector<std::string> laws_for(const homogenization::UnitCell &cell,
                                  const std::vector<std::string> &asked);

constexpr std::size_t n_default_references = 3;

/// Names of the laws that a study of this cell has where none are asked for: linear, the default
/// law, green.
std::vector<std::string> default_references(const homogenization::UnitCell &cell);

/// What a coarse cloth that is corotational loses of ellipticity before 20 %: a sentence; empty
/// where nothing.
/// @param C C^H (3,3) [N/m]
std::string note_on_corotational_cloth(const Eigen::Matrix3d &C);

/// A sentence on the default law: which, and why.
std::string note_on_default_law(const homogenization::UnitCell &cell);

/// A sentence on the default references: which, and why yarn or biot is among them.
std::string note_on_default_references(const homogenization::UnitCell &cell);
} // namespace homespun::verification
