#include "experiments/runner/psychophysics/axis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace presa::psychophysics {
namespace {

// Standard 0.8; steps of -0.1, of ln 1.5, and of -6.0206 dB (a factor of two).
TEST(Axis, LevelsBecomeValuesAndBack) {
  EXPECT_DOUBLE_EQ((Axis{Unit::kLinear, 0.8}.valueAt(-0.1)), 0.7);
  EXPECT_DOUBLE_EQ((Axis{Unit::kLnRatio, 0.8}.valueAt(std::log(1.5))), 1.2);
  EXPECT_NEAR((Axis{Unit::kDecibel, 0.8}.valueAt(-6.020599913)), 0.4, 1e-10);
  for (const Unit unit : {Unit::kLinear, Unit::kLnRatio, Unit::kDecibel}) {
    const Axis axis{unit, 0.8};
    EXPECT_NEAR(axis.levelAt(axis.valueAt(-0.3)), -0.3, 1e-15);
    EXPECT_EQ(axis.valueAt(0), 0.8);
  }
}

}  // namespace
}  // namespace presa::psychophysics
