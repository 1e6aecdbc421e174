// SPDX-License-Identifier: MIT
// The two sides of a comparison at one level: the resolved sheet, and the method.
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/method/edge_terms.h"
#include "verification/method/fluctuation.h"
#include "verification/method/lightweight_cloth.h"
#include "verification/reference/fine_reference.h"
#include "verification/strain/reference_uncertainty.h"
#include "verification/strain/strain_output.h"

#include <map>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The resolved sheet at one level.
struct ResolvedLevel
{
  const meshes::Sheet &sheet;
  const ReferenceStep &fine;
  unsigned long n_dofs;
  unsigned int n_ranks;
  ReferenceBar bar; ///< of its positions [m] and of its force
  Stability stability;
  double seconds_stability;
};

/// The method, and what its error is measured by.
struct MethodOnSheet
{
  const meshes::HomogenizedCell &cell;
  LightweightCloth cloth;
  FluctuationMeasure fluctuation;
  std::vector<Eigen::Matrix3d> stiffness_of_phase; ///< of the resolved sheet [N/m]
  std::vector<std::string> phases = {};            ///< their names
  /// Other coarse cloths that methods ask for.
  std::map<CoarseChoice, LightweightCloth> others = {};
  /// Of the methods with terms of edges, by name; without those that nobody asked for, and empty
  /// where the cell has no terms of edges, and then why.
  std::map<std::string, EdgedSheet> edged = {};
  std::string why_no_edges                = {};
  /// By law, where a method asks for them.
  std::map<Law, meshes::FittedModes> fitted = {};
};

/// A sheet under a load, with what holds the method against the reference there.
struct LoadedSheet
{
  const homogenization::UnitCell &cell;
  const meshes::Sheet &sheet;
  const Load &load;
  const ReferenceUncertainty &uncertainty;
  FineReference &reference;
  MethodOnSheet &method;
  bool has_budget; ///< that can be measured
};
} // namespace homespun::verification
