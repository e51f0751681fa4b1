#include "devices/novint_falcon/loader.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/devices/novint_falcon/hand_written_falcon.h"

namespace presa::falcon {
namespace {

using Result = FalconLoader::Result;

Bytes someFirmware(std::size_t size) {
  Bytes bytes{0xaa, 0x08, 0x00, 0x00};
  while (bytes.size() < size) bytes.push_back(static_cast<std::uint8_t>(bytes.size() * 37 % 251));
  bytes.resize(size);
  return bytes;
}

struct Started {
  explicit Started(HandWrittenFalcon& falcon, Bytes bytes = {}) : firmware(std::move(bytes)), loader(falcon, firmware) {
    falcon.expects = firmware.size();
  }

  /// Runs until it is done, for at most `limit` seconds of virtual time.
  Result run(double limit = 600, double tick = 1e-3) {
    loader.start(0);
    Result result = Result::kBusy;
    for (std::int64_t i = 1; result == Result::kBusy && static_cast<double>(i) * tick < limit; ++i)
      result = loader.step(time = static_cast<double>(i) * tick);
    return result;
  }

  Bytes firmware;
  FalconLoader loader;
  double time = 0;
};

bool allZero(const HandWrittenFalcon& falcon) {
  return std::all_of(falcon.sent.begin(), falcon.sent.end(), [](const auto& s) { return s.well_formed && s.zero(); });
}

// Numbers of the converter's requests; all use bmRequestType 0x40 and wIndex 0.
TEST(FalconControl, RequestsOfTheConverter) {
  const std::map<Control, FtdiRequest> expected{
      {Control::kReset, {0, 0}},          {Control::kPurgeReceive, {0, 1}},      {Control::kPurgeTransmit, {0, 2}},
      {Control::kDtrHigh, {1, 0x0101}},   {Control::kDtrLow, {1, 0x0100}},       {Control::kRtsLow, {1, 0x0200}},
      {Control::kNoFlowControl, {2, 0}},  {Control::kBaud9600, {3, 0x4138}},     {Control::kBaud140000, {3, 0x0015}},
      {Control::kBaud1500000, {3, 0x02}}, {Control::kEightBitsNoParity, {4, 8}}, {Control::kLatency16ms, {9, 16}},
      {Control::kLatency1ms, {9, 1}},
  };
  for (const auto& [control, request] : expected) EXPECT_EQ(ftdiRequestOf(control), request) << request.value;
}

TEST(FalconLoader, ADeviceWhoseFirmwareRunsGetsNone) {
  HandWrittenFalcon falcon;
  Started start(falcon, someFirmware(200));
  EXPECT_EQ(start.run(), Result::kReady);
  EXPECT_EQ(falcon.attempts, 0);
  EXPECT_EQ(falcon.sent.size(), 1U);
  EXPECT_TRUE(allZero(falcon));
  using enum Control;
  EXPECT_EQ(falcon.controls, (std::vector<Control>{kPurgeReceive, kPurgeTransmit, kLatency1ms, kBaud1500000,
                                                   kPurgeReceive, kPurgeTransmit}));
}

TEST(FalconLoader, WithoutFirmwareASilentDeviceIsSaidSo) {
  HandWrittenFalcon falcon;
  falcon.loaded = false;
  Started start(falcon);
  EXPECT_EQ(start.run(), Result::kFailed);
  EXPECT_EQ(start.loader.fault(), LinkFault::kNoFirmware);
  EXPECT_EQ(falcon.sent.size(), 10U);
}

class FalconLoading : public testing::TestWithParam<bool> {};

// 8492 bytes is the size of a real firmware file.
TEST_P(FalconLoading, EveryByteArrivesInChunksThatFitOnePacket) {
  HandWrittenFalcon falcon;
  falcon.loaded = false;
  falcon.zero_first = GetParam();
  Started start(falcon, someFirmware(8492));
  EXPECT_EQ(start.run(), Result::kReady);
  EXPECT_EQ(falcon.firmware, start.firmware);
  EXPECT_LE(*std::max_element(falcon.chunks.begin(), falcon.chunks.end()), 62U);
  EXPECT_EQ(falcon.attempts, 1);
  EXPECT_EQ(start.loader.report().attempts, 0);
  EXPECT_TRUE(allZero(falcon));
  using enum Control;
  const std::vector<Control> loader_part{kPurgeReceive,      kPurgeTransmit, kLatency16ms,  kBaud9600,
                                         kEightBitsNoParity, kNoFlowControl, kRtsLow,       kDtrLow,
                                         kDtrHigh,           kDtrLow,        kBaud140000,   kLatency1ms,
                                         kBaud1500000,       kPurgeReceive,  kPurgeTransmit};
  EXPECT_EQ(std::vector<Control>(falcon.controls.begin() + 6, falcon.controls.end()), loader_part);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutAZeroFirst, FalconLoading, testing::Bool());

// "Upload often fails the first one to three times": nine failures are tolerated, ten are not.
TEST(FalconLoader, NineFailuresAreForgivenTenAreNot) {
  for (const int failures : {1, 3, 9, 10}) {
    HandWrittenFalcon falcon;
    falcon.loaded = false;
    falcon.garble = [&](int attempt, std::size_t at, Bytes echo) {
      if (attempt <= failures && at == 124) echo[5] ^= 0x10;
      return echo;
    };
    Started start(falcon, someFirmware(300));
    EXPECT_EQ(start.run(), failures < 10 ? Result::kReady : Result::kFailed) << failures;
    EXPECT_EQ(start.loader.report().attempts, failures);
    EXPECT_TRUE(allZero(falcon));
    if (failures < 10) continue;
    EXPECT_EQ(falcon.attempts, 10);
    EXPECT_EQ(start.loader.fault(), LinkFault::kEchoMismatch);
    EXPECT_EQ(start.loader.report().bytes, 129U);
    EXPECT_EQ(start.loader.report().expected, start.firmware[129]);
    EXPECT_EQ(start.loader.report().found, start.firmware[129] ^ 0x10);
  }
}

// The echo is the only checksum: a longer or shorter echo is as wrong as a different one.
TEST(FalconLoader, AnEchoOfAnotherLengthIsWrong) {
  for (const bool longer : {true, false}) {
    HandWrittenFalcon falcon;
    falcon.loaded = false;
    falcon.garble = [&](int, std::size_t at, Bytes echo) {
      if (at == 62 && longer) echo.insert(echo.end(), 500, 0x55);
      if (at == 62 && !longer) echo.pop_back();
      return echo;
    };
    Started start(falcon, someFirmware(300));
    EXPECT_EQ(start.run(), Result::kFailed);
    EXPECT_EQ(start.loader.fault(), longer ? LinkFault::kEchoMismatch : LinkFault::kEchoMissing);
    EXPECT_EQ(falcon.attempts, 10);
  }
}

// Even the correct next byte is no valid echo before it was sent.
TEST(FalconLoader, AnEchoOfWhatWasNotSentYetIsWrong) {
  HandWrittenFalcon falcon;
  falcon.loaded = false;
  const Bytes firmware = someFirmware(300);
  falcon.garble = [&](int, std::size_t at, Bytes echo) {
    if (at == 62) echo.push_back(firmware[124]);
    return echo;
  };
  Started start(falcon, firmware);
  EXPECT_EQ(start.run(), Result::kFailed);
  EXPECT_EQ(start.loader.fault(), LinkFault::kEchoMismatch);
  EXPECT_EQ(start.loader.report().bytes, 124U);
}

TEST(FalconLoader, ADeafLoaderIsGreetedAHundredTimes) {
  for (const int deaf : {99, 100}) {
    HandWrittenFalcon falcon;
    falcon.loaded = false;
    falcon.deaf_greetings = deaf;
    Started start(falcon, someFirmware(100));
    EXPECT_EQ(start.run(), deaf == 99 ? Result::kReady : Result::kFailed);
    EXPECT_EQ(falcon.greetings, 100);
    if (deaf == 100) {
      EXPECT_EQ(start.loader.fault(), LinkFault::kNoLoader);
    }
  }
}

TEST(FalconLoader, ALoaderThatDoesNotFollowTheSpeedIsTriedTenTimes) {
  HandWrittenFalcon falcon;
  falcon.loaded = false;
  falcon.deaf_to_speed = true;
  Started start(falcon, someFirmware(100));
  EXPECT_EQ(start.run(), Result::kFailed);
  EXPECT_EQ(start.loader.fault(), LinkFault::kEchoMissing);
  EXPECT_EQ(falcon.greetings, 10);
}

TEST(FalconLoader, FirmwareThatDoesNotRunIsSaidSo) {
  HandWrittenFalcon falcon;
  falcon.loaded = false;
  falcon.wont_run = true;
  Started start(falcon, someFirmware(100));
  EXPECT_EQ(start.run(), Result::kFailed);
  EXPECT_EQ(start.loader.fault(), LinkFault::kFirmwareSilent);
  EXPECT_EQ(falcon.attempts, 10);
}

TEST(FalconLoader, ARefusedSettingEndsIt) {
  HandWrittenFalcon falcon;
  falcon.refuses = true;
  Started start(falcon);
  EXPECT_EQ(start.run(1), Result::kFailed);
  EXPECT_EQ(start.loader.fault(), LinkFault::kControlRefused);
}

// Unplugged at any moment of an upload: reported at the next step, and nothing more is sent.
TEST(FalconLoader, UnpluggedAtAnyMomentIsNoticedAtOnce) {
  for (int pulled = 0; pulled < 900; pulled += 7) {
    HandWrittenFalcon falcon;
    falcon.loaded = false;
    Started start(falcon, someFirmware(2000));
    start.loader.start(0);
    Result result = Result::kBusy;
    for (int i = 1; i <= pulled && result == Result::kBusy; ++i) result = start.loader.step(i * 1e-3);
    if (result != Result::kBusy) break;
    falcon.unplugged = true;
    EXPECT_EQ(start.loader.step((pulled + 1) * 1e-3), Result::kFailed);
    EXPECT_EQ(start.loader.fault(), LinkFault::kLost);
  }
}

TEST(FalconLoader, ABusyTransportDelaysAndLosesNothing) {
  HandWrittenFalcon falcon;
  falcon.loaded = false;
  Started start(falcon, someFirmware(1000));
  start.loader.start(0);
  Result result = Result::kBusy;
  for (int i = 1; i < 100'000 && result == Result::kBusy; ++i) {
    falcon.busy = i % 7 != 0;
    result = start.loader.step(i * 1e-3);
  }
  EXPECT_EQ(result, Result::kReady);
  EXPECT_EQ(falcon.firmware, start.firmware);
  EXPECT_EQ(start.loader.report().attempts, 0);
}

}  // namespace
}  // namespace presa::falcon
