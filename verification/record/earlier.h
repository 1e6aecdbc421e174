// SPDX-License-Identifier: MIT
#pragma once

namespace homespun::verification
{
/// What to do about an earlier run of other inputs, options or revision in the same folder.
enum class Earlier
{
  keep_work, ///< refuse where more than ten seconds of work would be lost
  resume,    ///< refuse: what is there must be of the same run
  overwrite  ///< remove it
};
} // namespace homespun::verification
