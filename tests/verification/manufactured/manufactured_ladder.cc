// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"
#include "tests/verification/manufactured/manufactured_cases.h"

#include <cmath>
#include <limits>

namespace homespun::verification
{
ManufacturedLadder climb(const ManufacturedCase &manufactured, const MPI_Comm communicator)
{
  ManufacturedLadder ladder;
  Eigen::MatrixXd finest;
  try
  {
    for (const int size : manufactured.sizes)
    {
      const ManufacturedSolution solution =
        manufactured.solve(size, manufactured_tolerance, communicator);
      ladder.h.push_back(manufactured.extent / size);
      ladder.L2.push_back(solution.error.L2 / (manufactured_side * manufactured_side));
      ladder.H1.push_back(solution.error.H1 / manufactured_side);
      ladder.n_dofs.push_back(solution.n_dofs);
      finest = solution.positions;
    }
    // Where the last step of Newton's method jumps below both tolerances the iterates are the same,
    // and nothing is measured: then the one before is asked for. If that has a residual of more
    // than 1e8 tolerances, what it is wrong by has fallen by as much in the step.
    constexpr double jump = 1e8;
    for (double loosening = 100.;
         manufactured.has_tolerance && loosening <= 1e14 && !(ladder.algebraic_error > 0.);
         loosening *= 100.)
    {
      const Eigen::MatrixXd loose =
        manufactured
          .solve(manufactured.sizes.back(), loosening * manufactured_tolerance, communicator)
          .positions;
      const double difference =
        std::sqrt((loose - finest).squaredNorm() / static_cast<double>(finest.rows())) /
        manufactured_side;
      if (difference > 0.)
        ladder.algebraic_error = loosening <= jump ? difference : difference / jump;
    }
  }
  catch (const meshes::NotConverged &failure)
  {
    ladder.unfinished = failure.what();
  }
  return ladder;
}

ManufacturedClaims judge(const ManufacturedCase &manufactured, const ManufacturedLadder &ladder)
{
  ManufacturedClaims claims;
  claims.L2              = judge_errors(ladder.h, ladder.L2, manufactured.L2);
  claims.algebraic_share = ladder.L2.empty() ? std::numeric_limits<double>::quiet_NaN()
                                             : ladder.algebraic_error / ladder.L2.back();
  if (manufactured.has_H1)
    claims.H1 = judge_errors(ladder.h, ladder.H1, manufactured.H1);
  if (manufactured.has_tolerance && !(claims.algebraic_share <= largest_algebraic_share))
    for (OrderJudgement *claim : {&claims.L2, &claims.H1})
      if (claim->outcome == Outcome::pass)
      {
        claim->outcome = Outcome::inconclusive;
        claim->why     = std::isnan(claims.algebraic_share)
                           ? "the algebraic error could not be measured"
                           : "the algebraic error is no hundred times below the smallest L2 error";
      }
  return claims;
}
} // namespace homespun::verification
