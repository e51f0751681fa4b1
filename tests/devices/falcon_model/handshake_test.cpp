#include <gtest/gtest.h>

#include "tests/devices/falcon_model/host.h"

namespace presa::falcon_model::test {
namespace {

using State = Processor::State;
using Bytes = std::vector<std::uint8_t>;

ModelSettings bare() {
  ModelSettings settings;
  settings.loader.firmware = firmware();
  return settings;
}

// After power-on the device does not answer the operating protocol.
TEST(FalconHandshake, WithoutFirmwareThereIsNoReply) {
  FalconModel model(bare());
  Host host(model);
  host.toOperation();
  EXPECT_FALSE(host.cycle({}));
  EXPECT_EQ(model.requests(), 0);
}

TEST(FalconHandshake, FirmwareIsEchoedByteForByteAndRuns) {
  FalconModel model(bare());
  Host host(model);
  ASSERT_TRUE(host.greet());
  EXPECT_EQ(host.answer, (Bytes{0x0A, 0x44, 0x2C, 0x0D}));
  EXPECT_EQ(host.upload(firmware()), firmware());
  EXPECT_EQ(model.state(), State::kOperating);
  host.toOperation();
  host.readFor(0.01);
  host.cycles({}, 3);
  ASSERT_TRUE(host.last);
  EXPECT_EQ(host.last->homed, 0U);
}

TEST(FalconHandshake, TheAnswerMayBeginWithAZero) {
  ModelSettings settings = bare();
  settings.loader.zero_before = true;
  FalconModel model(settings);
  Host host(model);
  EXPECT_TRUE(host.greet());
  EXPECT_EQ(host.answer, (Bytes{0x00, 0x0A, 0x44, 0x2C, 0x0D}));
}

TEST(FalconHandshake, SomeGreetingsMayGoUnheard) {
  ModelSettings settings = bare();
  settings.loader.deaf_greetings = 2;
  FalconModel model(settings);
  Host host(model);
  EXPECT_FALSE(host.greet());
  EXPECT_FALSE(host.greet());
  EXPECT_TRUE(host.greet());
}

// Each stage has its baud rate; bytes at another rate are noise.
TEST(FalconHandshake, GreetingsAtTheWrongRateAreNoise) {
  FalconModel model(bare());
  Host host(model);
  host.control({Control::kLatency1ms, Control::kBaud140000, Control::kEightBitsNoParity, Control::kRtsLow,
                Control::kDtrLow, Control::kDtrHigh});
  host.write({0x0A, 0x43, 0x0D});
  EXPECT_EQ(host.readFor(0.1), Bytes{});
  EXPECT_EQ(model.processor().garbled(), 3);
}

TEST(FalconHandshake, WithoutTheEdgeOfDtrNobodyListens) {
  FalconModel model(bare());
  Host host(model);
  host.control({Control::kBaud9600, Control::kEightBitsNoParity});
  host.write({0x0A, 0x43, 0x0D});
  EXPECT_EQ(host.readFor(0.1), Bytes{});
}

TEST(FalconHandshake, HalfOfTheFirmwareDoesNotRun) {
  FalconModel model(bare());
  Host host(model);
  ASSERT_TRUE(host.greet());
  Bytes half = firmware();
  half.resize(500);
  EXPECT_EQ(host.upload(half), half);
  EXPECT_EQ(model.state(), State::kUpload);
  host.toOperation();
  EXPECT_FALSE(host.cycle({}));
}

TEST(FalconHandshake, OtherFirmwareIsEchoedAndHangs) {
  FalconModel model(bare());
  Host host(model);
  ASSERT_TRUE(host.greet());
  Bytes other = firmware();
  other[700] ^= 1;
  EXPECT_EQ(host.upload(other), other);
  EXPECT_EQ(model.state(), State::kHung);
  EXPECT_TRUE(host.greet()) << "a new edge of DTR starts over";
  EXPECT_EQ(host.upload(firmware()), firmware());
  EXPECT_EQ(model.state(), State::kOperating);
}

TEST(FalconHandshake, EachUploadFaultShowsInTheEcho) {
  ModelSettings settings = bare();
  settings.loader.faults = {{0, 5, UploadFault::Kind::kCorruptByte},
                            {1, 63, UploadFault::Kind::kWrongEcho},
                            {2, 999, UploadFault::Kind::kLostEcho}};
  FalconModel model(settings);
  Host host(model);
  const Bytes good = firmware();
  for (const std::size_t byte : {5UL, 63UL}) {
    ASSERT_TRUE(host.greet());
    const Bytes echo = host.upload(good);
    ASSERT_EQ(echo.size(), good.size());
    for (std::size_t i = 0; i < good.size(); ++i) EXPECT_EQ(echo[i] != good[i], i == byte);
    EXPECT_EQ(model.state(), byte == 5 ? State::kHung : State::kOperating);
  }
  ASSERT_TRUE(host.greet());
  EXPECT_EQ(host.upload(good).size(), good.size() - 1);
  EXPECT_EQ(model.processor().uploads(), 3);
}

// Firmware is lost with the power, and with a new edge of DTR.
TEST(FalconHandshake, FirmwareIsLostWithThePower) {
  FalconModel model(running());
  {
    Host host(model);
    host.toOperation();
    host.cycles({}, 2);
    ASSERT_TRUE(host.last);
    EXPECT_EQ(host.last->homed, 7U);
    model.unplug(host.now);
    EXPECT_TRUE(host.transport->lost());
    EXPECT_FALSE(host.write({0x3C}));
    model.plug(1);
    EXPECT_TRUE(host.transport->lost()) << "who had it before does not get it back";
    EXPECT_FALSE(host.control({Control::kReset}));
  }
  Host host(model);
  ASSERT_TRUE(host.transport);
  host.now = 1;
  host.toOperation();
  EXPECT_FALSE(host.cycle({}));
}

TEST(FalconHandshake, OneProgramHasIt) {
  FalconModel model(running());
  auto first = ModelTransport::open(model);
  ASSERT_TRUE(first);
  EXPECT_FALSE(ModelTransport::open(model));
  first.reset();
  EXPECT_TRUE(ModelTransport::open(model));
}

TEST(FalconHandshake, WhatTheConverterDoesNotKnowIsRefused) {
  FalconModel model(running());
  EXPECT_FALSE(model.vendorRequest(7, 0, 0));
  EXPECT_FALSE(model.vendorRequest(3, 0x0001, 0));
  EXPECT_TRUE(model.vendorRequest(3, 0x4138, 0));
  EXPECT_NEAR(model.line().baud(), 9600, 1e-9);  // 3 MHz / 312.5
  model.refuseRequests(2);
  EXPECT_TRUE(model.vendorRequest(9, 1, 0));
  EXPECT_FALSE(model.vendorRequest(9, 1, 0));
  EXPECT_TRUE(model.vendorRequest(9, 1, 0));
}

}  // namespace
}  // namespace presa::falcon_model::test
