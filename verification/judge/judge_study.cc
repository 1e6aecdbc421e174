// SPDX-License-Identifier: MIT
#include "verification/judge/judge_study.h"

#include "verification/judge/judged_frames.h"
#include "verification/judge/judged_levels.h"
#include "verification/record/on_root.h"

namespace homespun::verification
{
std::vector<Verdict> judge(const JudgeOptions &options, const MPI_Comm communicator)
{
  if (!is_root(communicator))
    return {};
  JudgedRun given(options);
  return given.run["command"] == "strain" ? judge_levels(given) : judge_frames(given);
}
} // namespace homespun::verification
