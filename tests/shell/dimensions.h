// SPDX-License-Identifier: MIT
// Typed tests of what is written once for the plane and for space.
#pragma once

#include <gtest/gtest.h>

namespace homespun::tests
{
template <int dim>
struct Dimension
{
  static constexpr int value = dim;
};

template <typename Dim>
struct InPlaneAndSpace : ::testing::Test
{
};

using Dimensions = ::testing::Types<Dimension<2>, Dimension<3>>;
} // namespace homespun::tests
