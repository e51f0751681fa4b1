#include <gtest/gtest.h>

#include "tests/devices/falcon_model/host.h"

namespace presa::falcon_model::test {
namespace {

std::vector<std::uint8_t> bytesOf(const Request& request) {
  const Frame frame = frameOf(request);
  return {frame.begin(), frame.end()};
}

// 16 bytes of ten bits at 1.5 Mbaud: 106.7 us each way, then the wait for the latency timer.
TEST(FalconWire, BytesTakeTheirTime) {
  FalconModel model(running());
  Host host(model);
  host.toOperation();
  host.now = 0.0100;
  host.readFor(0.001);  // the timer ends at whole milliseconds
  std::vector<double> received;
  model.onRequest([&](const Received& request) { received.push_back(request.time); });
  const double sent = host.now;
  host.write(bytesOf({}));
  EXPECT_EQ(host.readFor(0.75e-3).size(), 0U) << "ready after 0.23 ms, kept until the timer ends";
  EXPECT_EQ(host.readFor(0.25e-3).size(), 16U);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_NEAR(received[0] - sent, 16 * 10 / 1.5e6, 1e-12);
}

// A full packet does not wait for the latency timer.
TEST(FalconWire, SixtyTwoBytesGoAtOnce) {
  SerialLine line;
  line.request(9, 16, 0);
  line.request(3, 2, 0);
  line.processorWrites(std::vector<std::uint8_t>(70, 0x55), 1.5e6, 0, 0);
  const auto full = line.toHost(1, 0), rest = line.toHost(1, 0);
  ASSERT_TRUE(full && rest);
  EXPECT_EQ(full->bytes.size(), 62U);
  EXPECT_NEAR(full->time, 62 * 10 / 1.5e6, 1e-12);
  EXPECT_EQ(rest->bytes.size(), 8U);
  EXPECT_NEAR(rest->time, full->time + 0.016, 1e-12);
}

TEST(FalconWire, AFullConverterTakesNoMore) {
  FalconModel model(running());
  Host host(model);
  host.control({Control::kBaud9600});
  const std::vector<std::uint8_t> chunk(62, 0);
  EXPECT_TRUE(host.write(chunk));
  EXPECT_TRUE(host.write(chunk));
  EXPECT_FALSE(host.write(chunk));
  host.readFor(0.1);
  EXPECT_TRUE(host.write(chunk));
}

TEST(FalconWire, OneReplyForEachRequest) {
  FalconModel model(running());
  Host host(model);
  host.toOperation();
  std::size_t bytes = 0;
  for (int i = 0; i < 1000; ++i) {
    host.write(bytesOf({}));
    bytes += host.readFor(1e-3).size();
  }
  bytes += host.readFor(2e-3).size();
  EXPECT_EQ(bytes, 16000U);
  EXPECT_EQ(model.requests(), 1000);
}

TEST(FalconWire, ARequestCutShortIsDroppedAndTheNextOneCounts) {
  FalconModel model(running());
  Host host(model);
  host.toOperation();
  auto cut = bytesOf({});
  cut.resize(9);
  host.write(cut);
  host.cycles({.red = true}, 2);
  EXPECT_EQ(model.requests(), 2);
  EXPECT_EQ(model.processor().badFrames(), 1);
  EXPECT_TRUE(model.received().red);
}

/// Number of bytes that return with the fault on every reply.
std::size_t returned(const std::function<void(ReplyFate&)>& fault, int requests) {
  FalconModel model(running());
  Host host(model);
  host.toOperation();
  model.onReply(fault);
  std::size_t bytes = 0;
  for (int i = 0; i < requests; ++i) {
    host.write(bytesOf({}));
    bytes += host.readFor(1e-3).size();
  }
  return bytes + host.readFor(5e-3).size();
}

TEST(FalconWire, RepliesMayBeShortSplitMergedOrMissing) {
  RandomStream random(1, "replies");
  EXPECT_EQ(returned([&](ReplyFate& reply) { shorten(reply, random); }, 100), 1400U);
  int n = 0;
  const auto some_split = [&](ReplyFate& reply) {
    if (++n % 3 == 0) split(reply, random);
  };
  EXPECT_EQ(returned(some_split, 100), 1600U);
  EXPECT_EQ(returned([&](ReplyFate& reply) { flipBits(reply, random, 3); }, 100), 1600U);
  EXPECT_EQ(returned([n = 0](ReplyFate& reply) mutable { reply.waits = ++n % 2 == 1; }, 100), 1600U);
  FalconModel model(running());
  Host host(model);
  host.toOperation();
  model.mute(0.010, 0.020);
  int answered = 0;
  for (int i = 0; i < 40; ++i) answered += host.cycle({}) ? 1 : 0;
  EXPECT_EQ(model.requests(), 40);
  EXPECT_NEAR(answered, 30, 1);  // the last reply is still on its way
  model.deafen(host.now, host.now + 0.0105);
  host.cycles({}, 20);
  EXPECT_EQ(model.requests(), 49);
}

TEST(FalconWire, SameSeedSameBytes) {
  const auto run = [](std::uint64_t seed) {
    ModelSettings settings = running();
    settings.seed = seed;
    FalconModel model(settings);
    Host host(model);
    host.toOperation();
    std::vector<std::uint8_t> all;
    for (int i = 0; i < 50; ++i) {
      host.write(bytesOf({.counts = {i, -i, 2 * i}}));
      const auto part = host.readFor(1e-3);
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  };
  EXPECT_EQ(run(3), run(3));
  EXPECT_NE(run(3), run(4)) << "byte 14";
}

}  // namespace
}  // namespace presa::falcon_model::test
