#include "devices/novint_falcon/packet.h"

#include <gtest/gtest.h>

#include <vector>

#include "framework/core/math/random.h"
#include "tests/devices/novint_falcon/hand_written_falcon.h"
#include "tests/support/effort.h"

namespace presa::falcon {
namespace {

/// Bytes from (value, count) pairs: {0x41, 12} is twelve times 0x41.
Bytes bytesOf(std::initializer_list<std::pair<int, int>> runs) {
  Bytes bytes;
  for (const auto& [value, count] : runs)
    bytes.insert(bytes.end(), static_cast<std::size_t>(count), static_cast<std::uint8_t>(value));
  return bytes;
}

Bytes sent(const Request& request) {
  const Packet packet = encode(request);
  return {packet.begin(), packet.end()};
}

std::vector<Reply> parsed(PacketParser& parser, const Bytes& bytes) {
  parser.push(bytes);
  std::vector<Reply> replies;
  for (Reply reply; parser.next(reply);) replies.push_back(reply);
  return replies;
}

// Reference vectors from the protocol description, independent of any program.
TEST(FalconPacket, GoldenVectorsOfRequests) {
  EXPECT_EQ(sent({.homing = false}), bytesOf({{0x3c, 1}, {0x41, 14}, {0x3e, 1}}));
  EXPECT_EQ(sent({.light = kGreen}), bytesOf({{0x3c, 1}, {0x41, 12}, {0x44, 1}, {0x41, 1}, {0x3e, 1}}));
  EXPECT_EQ(sent({.force = {1000, -1000, 4095}, .light = kRed, .homing = false}),
            (Bytes{0x3c, 0x49, 0x4f, 0x44, 0x41, 0x49, 0x42, 0x4d, 0x50, 0x50, 0x50, 0x50, 0x41, 0x49, 0x41, 0x3e}));
}

TEST(FalconPacket, GoldenVectorsOfReplies) {
  PacketParser parser;
  const auto replies =
      parsed(parser, {0x3c, 0x4e, 0x50, 0x50, 0x50, 0x49, 0x4f, 0x44, 0x41, 0x41, 0x41, 0x41, 0x49, 0xb1, 0x00, 0x3e});
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].encoders, (Counts{-3, 1000, -32768}));
  EXPECT_EQ(replies[0].homed, kAllHomed);
  EXPECT_EQ(replies[0].buttons, 0);
}

TEST(FalconPacket, ButtonsAndHomedFlagsAreSeparateBits) {
  for (int status = 0; status < 128; ++status) {
    PacketParser parser;
    const auto replies = parsed(parser, replyOf({}, 0x41 + status));
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_EQ(replies[0].buttons, status % 16);
    EXPECT_EQ(replies[0].homed, status / 16);
  }
}

// A device that uses the low 16 bits of 300 000 counts would push the wrong way.
TEST(FalconPacket, ACountOutOfRangeSendsNoForce) {
  for (const int bad : {4096, -4096, 65535, 300000, -300000, 1 << 30})
    EXPECT_EQ(sent({.force = {100, bad, -100}}), sent({})) << bad;
  EXPECT_NE(sent({.force = {100, 4095, -4095}}), sent({}));
}

TEST(FalconPacket, EveryEncoderValueComesBack) {
  PacketParser parser;
  for (int count = -32768; count < 32768; count += 7) {
    const auto replies = parsed(parser, replyOf({count, -count - 1, count / 2}, 0xB1));
    ASSERT_EQ(replies.size(), 1U);
    ASSERT_EQ(replies[0].encoders, (Counts{count, -count - 1, count / 2}));
  }
  EXPECT_EQ(parser.dropped(), 0U);
}

// Seen on devices: a reply of 14 bytes, whose '>' an old parser took for the end of 16 bytes, reading seven homed
// flags.
TEST(FalconPacket, AReplyOfFourteenBytesIsNone) {
  Bytes stream = replyOf({1, 2, 3}, 0x41);
  Bytes fourteen = replyOf({4, 5, 6}, 0xB1);
  fourteen.erase(fourteen.begin() + 13, fourteen.begin() + 15);
  ASSERT_EQ(fourteen.size(), 14U);
  stream.insert(stream.end(), fourteen.begin(), fourteen.end());
  const Bytes good = replyOf({7, 8, 9}, 0x51);
  stream.insert(stream.end(), good.begin(), good.end());
  PacketParser parser;
  const auto replies = parsed(parser, stream);
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_EQ(replies[0].encoders, (Counts{1, 2, 3}));
  EXPECT_EQ(replies[1].encoders, (Counts{7, 8, 9}));
  EXPECT_EQ(parser.dropped(), 14U);
}

TEST(FalconPacket, ARuleBrokenAtAnyByteIsFound) {
  for (std::size_t at = 0; at < kPacketSize; ++at) {
    for (int value = 0; value < 256; ++value) {
      Bytes bytes = replyOf({1, -1, 1}, 0xB1);
      bytes[at] = static_cast<std::uint8_t>(value);
      const bool allowed = at == 0    ? value == '<'
                           : at <= 12 ? value >= 0x41 && value <= 0x50
                           : at == 13 ? value >= 0x41 && value <= 0xC0
                           : at == 14 ? true
                                      : value == '>';
      PacketParser parser;
      EXPECT_EQ(parsed(parser, bytes).size(), allowed ? 1U : 0U) << at << ": " << value;
    }
  }
}

TEST(FalconPacket, AReplyMayComeInPieces) {
  const Bytes bytes = replyOf({100, 200, 300}, 0xB1);
  PacketParser parser;
  for (std::size_t i = 0; i + 1 < bytes.size(); ++i) ASSERT_TRUE(parsed(parser, {bytes[i]}).empty());
  EXPECT_EQ(parsed(parser, {bytes.back()}).size(), 1U);
}

TEST(FalconPacket, TooMuchAtOnceKeepsTheNewest) {
  Bytes stream;
  for (int i = 0; i < 100; ++i) {
    const Bytes reply = replyOf({i, 0, 0}, 0xB1);
    stream.insert(stream.end(), reply.begin(), reply.end());
  }
  PacketParser parser;
  const auto replies = parsed(parser, stream);
  ASSERT_EQ(replies.size(), PacketParser::kCapacity / kPacketSize);
  EXPECT_EQ(replies.back().encoders[0], 99);
}

TEST(FalconPacket, AfterAResetNothingOldIsRead) {
  const Bytes bytes = replyOf({}, 0xB1);
  PacketParser parser;
  parser.push(Bytes(bytes.begin(), bytes.begin() + 8));
  parser.reset();
  EXPECT_TRUE(parsed(parser, Bytes(bytes.begin() + 8, bytes.end())).empty());
}

/// A stream of four replies with one to three typical transmission faults.
Bytes mutated(RandomStream& random) {
  Bytes stream;
  for (int i = 0; i < 4; ++i) {
    Bytes reply = replyOf({static_cast<int>(random.below(65536)), static_cast<int>(random.below(65536)), 0},
                          0x41 + static_cast<int>(random.below(128)), static_cast<int>(random.below(256)));
    if (random.below(4) == 0) reply.erase(reply.begin() + 13, reply.begin() + 15);  // the truncated reply
    stream.insert(stream.end(), reply.begin(), reply.end());
  }
  for (std::uint64_t faults = 1 + random.below(3); faults > 0 && stream.size() > 2; --faults) {
    const auto at = static_cast<std::ptrdiff_t>(random.below(stream.size()));
    const auto count =
        std::min<std::ptrdiff_t>(1 + static_cast<std::ptrdiff_t>(random.below(20)), std::ssize(stream) - at);
    switch (random.below(5)) {
      case 0:
        stream.erase(stream.begin() + at);
        break;
      case 1:
        stream.insert(stream.begin() + at, static_cast<std::uint8_t>(random.below(256)));
        break;
      case 2:
        stream[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1U << random.below(8));
        break;
      case 3:
        stream.erase(stream.begin() + at, stream.begin() + at + count);
        break;    // two packets merged
      default: {  // a piece repeated
        const Bytes piece(stream.begin() + at, stream.begin() + at + count);
        stream.insert(stream.begin() + at, piece.begin(), piece.end());
      }
    }
  }
  return stream;
}

/// True if a valid frame starts at this position; every accepted reply must be one of these.
bool obeysRules(const Bytes& stream, std::size_t at) {
  if (at + kPacketSize > stream.size() || stream[at] != '<' || stream[at + 15] != '>') return false;
  for (std::size_t i = 1; i <= 12; ++i)
    if (stream[at + i] < 'A' || stream[at + i] > 'P') return false;
  return stream[at + 13] >= 0x41 && stream[at + 13] <= 0xC0;
}

int valueAt(const Bytes& stream, std::size_t at) {
  int value = 0;
  for (std::size_t n = 4; n-- > 0;) value = 16 * value + stream[at + n] - 'A';
  return value >= 32768 ? value - 65536 : value;
}

// For a million damaged streams: no invalid frame is accepted, no valid one is missed unless it overlaps an accepted
// one, and both good packets after the damage are read.
TEST(FalconPacket, AMillionDamagedStreamsDeceiveNobody) {
  RandomStream random(20261, "falcon packets");
  const Bytes last = replyOf({1234, -4321, 77}, 0xB3);
  for (int stream_index = 0; stream_index < unlessSanitized(1'000'000, 50'000); ++stream_index) {
    Bytes stream = mutated(random);
    const std::size_t damaged = stream.size();
    for (int i = 0; i < 2; ++i) stream.insert(stream.end(), last.begin(), last.end());

    PacketParser parser;
    std::size_t at = 0;   // where the next accepted frame may start
    std::size_t fed = 0;  // in pieces of random size, like reads
    int recovered = 0;
    while (fed < stream.size()) {
      const std::size_t piece = std::min<std::size_t>(1 + random.below(62), stream.size() - fed);
      parser.push({stream.data() + fed, piece});
      fed += piece;
      for (Reply reply; parser.next(reply);) {
        while (at < stream.size() && !obeysRules(stream, at)) ++at;
        ASSERT_LT(at, stream.size()) << "a frame out of nothing, stream " << stream_index;
        ASSERT_EQ(reply.encoders, (Counts{valueAt(stream, at + 1), valueAt(stream, at + 5), valueAt(stream, at + 9)}));
        ASSERT_EQ(reply.buttons + 16 * reply.homed, stream[at + 13] - 0x41);
        recovered += at == damaged || at == damaged + kPacketSize ? 1 : 0;
        at += kPacketSize;
      }
    }
    while (at < stream.size() && !obeysRules(stream, at)) ++at;
    ASSERT_EQ(at, stream.size()) << "a good frame was missed, stream " << stream_index;
    ASSERT_EQ(recovered, 2) << stream_index;
  }
}

}  // namespace
}  // namespace presa::falcon
