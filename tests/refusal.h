// SPDX-License-Identifier: MIT
// What homespun says to bad input, for tests of the text.
#pragma once

#include "meshes/plain/errors.h"

#include <string>

namespace homespun::tests
{
/// The message of the BadInput or NotConverged that an action throws; empty where it throws
/// neither.
template <typename Action>
std::string refusal(const Action &action)
{
  try
  {
    action();
    return "";
  }
  catch (const meshes::BadInput &bad)
  {
    return bad.what();
  }
  catch (const meshes::NotConverged &failure)
  {
    return failure.what();
  }
}
} // namespace homespun::tests
