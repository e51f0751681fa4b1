// Bytes from the protocol description, in both directions.
#include <gtest/gtest.h>

#include <algorithm>

#include "devices/falcon_model/processor.h"

namespace presa::falcon_model {
namespace {

constexpr std::uint8_t A = 0x41;
constexpr Frame kZero{0x3C, A, A, A, A, A, A, A, A, A, A, A, A, A, A, 0x3E};
constexpr Frame kGreenHoming{0x3C, A, A, A, A, A, A, A, A, A, A, A, A, 0x44, A, 0x3E};
constexpr Frame kWords{0x3C, 0x49, 0x4F, 0x44, 0x41, 0x49, 0x42, 0x4D, 0x50, 0x50, 0x50, 0x50, 0x41, 0x49, 0x41, 0x3E};

TEST(FalconFrames, RequestsReadAsWrittenDown) {
  const auto zero = requestOf(kZero), homing = requestOf(kGreenHoming), words = requestOf(kWords);
  ASSERT_TRUE(zero && homing && words);
  EXPECT_EQ(zero->counts, (std::array{0, 0, 0}));
  EXPECT_FALSE(zero->homing || zero->green || zero->blue || zero->red);
  EXPECT_TRUE(homing->homing && homing->green);
  EXPECT_FALSE(homing->blue || homing->red);
  EXPECT_EQ(words->counts, (std::array{1000, -1000, 4095}));
  EXPECT_TRUE(words->red);
  EXPECT_FALSE(words->homing || words->green || words->blue);
}

TEST(FalconFrames, RequestsAreWrittenAsWrittenDown) {
  EXPECT_EQ(frameOf(Request{}), kZero);
  EXPECT_EQ(frameOf(Request{.homing = true, .green = true}), kGreenHoming);
  EXPECT_EQ(frameOf(Request{.counts = {1000, -1000, 4095}, .red = true}), kWords);
}

TEST(FalconFrames, RepliesSayAllHomedAndMinusThree) {
  const Frame frame = frameOf(Status{.counters = {-3, 0, 0}, .homed = 7}, 0x55);
  EXPECT_EQ(frame[13], 0xB1);
  EXPECT_TRUE(std::equal(frame.begin() + 1, frame.begin() + 5, std::begin({0x4E, 0x50, 0x50, 0x50})));
  const auto back = statusOf(frame);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->counters[0], -3);
  EXPECT_EQ(back->homed, 7U);
  EXPECT_EQ(statusOf(std::span(frame).first(14)), std::nullopt);
}

TEST(FalconFrames, AnyByteOutOfRangeIsNoRequest) {
  for (std::size_t i = 0; i < kFrame; ++i) {
    if (i == 14) continue;  // has no meaning
    for (const int bad : {0x40, 0x51, 0x00, 0xFF}) {
      Frame frame = kWords;
      frame[i] = static_cast<std::uint8_t>(bad);
      EXPECT_FALSE(requestOf(frame)) << i;
    }
  }
}

}  // namespace
}  // namespace presa::falcon_model
