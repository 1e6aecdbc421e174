// SPDX-License-Identifier: MIT
// The two failures that a user of homespun can meet: input that makes no sense, and a solver that
// did not converge. The program turns them into exit status 2 and
// 3. A std::logic_error is a bug of homespun, found by one of its own audits.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace homespun::meshes
{
/// Input that cannot be used. Carries one message per fault, so that a user mends all at once; each
/// says which file, key or element, what was found, what was expected and what to do.
class BadInput : public std::runtime_error
{
public:
  explicit BadInput(std::vector<std::string> faults);
  explicit BadInput(const std::string &fault);

  const std::vector<std::string> &faults() const
  {
    return all_faults;
  }

private:
  std::vector<std::string> all_faults;
};

/// An iteration that stopped before its tolerance. Carries the norm of the residual after each
/// iteration, so that a stall can be told from a slow start.
class NotConverged : public std::runtime_error
{
public:
  NotConverged(const std::string &what, std::vector<double> residuals);

  const std::vector<double> &residual_history() const
  {
    return residuals;
  }

private:
  std::vector<double> residuals;
};

/// "a, b or c": what was expected, in messages.
std::string one_of(const std::vector<std::string> &names);
} // namespace homespun::meshes
