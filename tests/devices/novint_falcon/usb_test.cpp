// The USB side as far as it can be tested without a bus: packet bytes and messages.
#include <gtest/gtest.h>

#include "devices/novint_falcon/usb_transport.h"

namespace presa::falcon {
namespace {

std::vector<std::uint8_t> payloadOf(const std::vector<std::uint8_t>& received) {
  ByteRing<1024> ring;
  takePayload(received, ring);
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < ring.size(); ++i) bytes.push_back(ring[i]);
  return bytes;
}

// The converter puts two status bytes before every 64-byte packet; two bytes alone mean "no data".
TEST(FalconUsb, StatusBytesAreTakenOutOfEveryPacket) {
  EXPECT_TRUE(payloadOf({}).empty());
  EXPECT_TRUE(payloadOf({0x01}).empty());
  EXPECT_TRUE(payloadOf({0x01, 0x60}).empty());
  EXPECT_EQ(payloadOf({0x01, 0x60, '<', 'A'}), (std::vector<std::uint8_t>{'<', 'A'}));
  std::vector<std::uint8_t> received, expected;
  for (std::size_t i = 0; i < 150; ++i) {
    received.push_back(i % 64 < 2 ? 0xEE : static_cast<std::uint8_t>(i));
    if (i % 64 >= 2) expected.push_back(static_cast<std::uint8_t>(i));
  }
  EXPECT_EQ(payloadOf(received), expected);
  EXPECT_EQ(expected.size(), 62U + 62U + 20U);
}

TEST(FalconUsb, AByteRingKeepsTheNewest) {
  ByteRing<8> ring;
  for (std::uint8_t i = 0; i < 21; ++i) ring.push(i);
  ASSERT_EQ(ring.size(), 8U);
  for (std::uint8_t i = 0; i < 8; ++i) EXPECT_EQ(ring[i], 13 + i);
  ring.drop(3);
  EXPECT_EQ(ring[0], 16);
  EXPECT_EQ(ring.size(), 5U);
}

// When the device cannot be opened, the message contains the remedy, ready to paste.
TEST(FalconUsb, EveryProblemIsSaidAndAlmostEachHasARemedy) {
  UsbFailure failure{.problem = UsbProblem::kNoPermission, .node = "/dev/bus/usb/001/007"};
  EXPECT_NE(describe(failure, "").find("/dev/bus/usb/001/007"), std::string::npos);
  EXPECT_NE(remedy(failure).find(R"(ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", MODE="0664", GROUP="plugdev")"),
            std::string::npos);
  failure.present = {{.port = "1-2", .serial = "A7"}, {.port = "2-1.4"}};
  failure.problem = UsbProblem::kSeveral;
  EXPECT_EQ(describe(failure, ""), "which Novint Falcon? There are 2: A7, port 2-1.4");
  failure.problem = UsbProblem::kNotThisOne;
  EXPECT_EQ(describe(failure, "B3"), "no Novint Falcon has the serial number or port 'B3', found A7, port 2-1.4");
  for (int i = 1; i < static_cast<int>(UsbProblem::kFailed); ++i) {
    failure.problem = static_cast<UsbProblem>(i);
    EXPECT_FALSE(describe(failure, "x").empty()) << i;
    EXPECT_FALSE(remedy(failure).empty()) << i;
  }
}

}  // namespace
}  // namespace presa::falcon
