// The emulated bus as libusb sees it, without the driver.
#include <gtest/gtest.h>
#include <libusb.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "tests/devices/novint_falcon/usb/emulated_bus.h"

namespace presa::falcon_model::test {
namespace {

/// A device opened by libusb, closed at the end.
struct Opened {
  explicit Opened(int port = 1) {
    libusb_init(&context);
    libusb_device** list = nullptr;
    const auto count = libusb_get_device_list(context, &list);
    for (int i = 0; i < count; ++i) {
      libusb_device_descriptor descriptor{};
      libusb_get_device_descriptor(list[i], &descriptor);
      if (descriptor.idVendor != 0x0403 || descriptor.idProduct != 0xCB48) continue;
      if (libusb_get_port_number(list[i]) != port) continue;
      libusb_open(list[i], &handle);
    }
    libusb_free_device_list(list, 1);
  }
  ~Opened() {
    if (handle != nullptr) libusb_close(handle);
    libusb_exit(context);
  }
  int control(std::uint8_t request, std::uint16_t value) const {
    return libusb_control_transfer(handle, 0x40, request, value, 0, nullptr, 0, 500);
  }
  int write(Frame frame) const {
    int sent = 0;
    return libusb_bulk_transfer(handle, 0x02, frame.data(), static_cast<int>(frame.size()), &sent, 500);
  }
  /// Reads packets until there are 16 bytes of data.
  int read(std::vector<std::uint8_t>& bytes) const {
    for (int tries = 0; tries < 2000 && bytes.size() < kFrame; ++tries) {
      std::array<std::uint8_t, 64> packet{};
      int length = 0;
      const int result = libusb_bulk_transfer(handle, 0x81, packet.data(), 64, &length, 500);
      if (result != 0) return result;
      bytes.insert(bytes.end(), packet.begin() + std::min(2, length), packet.begin() + length);
    }
    return 0;
  }
  libusb_context* context = nullptr;
  libusb_device_handle* handle = nullptr;
};

ModelSettings ready() {
  ModelSettings settings;
  settings.has_firmware = settings.homed = true;
  return settings;
}

TEST(EmulatedUsb, LibusbFindsIt) {
  EmulatedBus bus;
  bus.add(ready());
  const Opened falcon;
  ASSERT_NE(falcon.handle, nullptr);
  unsigned char text[64] = {};
  EXPECT_GT(libusb_get_string_descriptor_ascii(falcon.handle, 2, text, sizeof text), 0);
  EXPECT_STREQ(reinterpret_cast<char*>(text), "FALCON HAPTIC");
}

TEST(EmulatedUsb, ExchangesPacketsWithTheModel) {
  EmulatedBus bus;
  EmulatedFalcon& device = bus.add(ready());
  const Opened falcon;
  ASSERT_NE(falcon.handle, nullptr);
  ASSERT_EQ(libusb_claim_interface(falcon.handle, 0), 0);
  for (const auto& [request, value] : {std::pair{9, 1}, {3, 2}, {0, 1}, {0, 2}}) {
    EXPECT_EQ(falcon.control(static_cast<std::uint8_t>(request), static_cast<std::uint16_t>(value)), 0);
  }
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(falcon.write(frameOf(Request{.red = true})), 0);
    std::vector<std::uint8_t> bytes;
    ASSERT_EQ(falcon.read(bytes), 0);
    const auto status = statusOf(bytes);
    ASSERT_TRUE(status);
    EXPECT_EQ(status->homed, 7U);
  }
  device.with([](FalconModel& model, double) {
    EXPECT_EQ(model.requests(), 20);
    EXPECT_TRUE(model.received().red);
  });
}

TEST(EmulatedUsb, WhatItDoesNotKnowStalls) {
  EmulatedBus bus;
  EmulatedFalcon& device = bus.add(ready());
  const Opened falcon;
  ASSERT_EQ(libusb_claim_interface(falcon.handle, 0), 0);
  EXPECT_EQ(falcon.control(7, 0), LIBUSB_ERROR_PIPE);
  EXPECT_EQ(falcon.control(9, 1), 0);
  device.stallBulk(true);
  EXPECT_EQ(falcon.write(frameOf(Request{})), LIBUSB_ERROR_PIPE);
}

TEST(EmulatedUsb, OneProgramHasIt) {
  EmulatedBus bus;
  bus.add(ready());
  const Opened second;
  {
    const Opened first;
    ASSERT_EQ(libusb_claim_interface(first.handle, 0), 0);
    EXPECT_EQ(libusb_claim_interface(second.handle, 0), LIBUSB_ERROR_BUSY);
  }
  // closing releases the claim; the system notices a moment later
  int result = LIBUSB_ERROR_BUSY;
  for (int i = 0; i < 500 && result != 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    result = libusb_claim_interface(second.handle, 0);
  }
  EXPECT_EQ(result, 0);
}

TEST(EmulatedUsb, PulledOutItIsGoneAndComesBack) {
  EmulatedBus bus;
  EmulatedFalcon& one = bus.add(ready());
  bus.add(ready());
  {
    const Opened falcon(1), other(2);
    ASSERT_NE(other.handle, nullptr);
    ASSERT_EQ(libusb_claim_interface(falcon.handle, 0), 0);
    ASSERT_EQ(libusb_claim_interface(other.handle, 0), 0);
    one.unplug();
    EXPECT_EQ(falcon.write(frameOf(Request{})), LIBUSB_ERROR_NO_DEVICE);
    EXPECT_EQ(other.control(9, 1), 0);
    EXPECT_EQ(Opened(1).handle, nullptr);
    EXPECT_NE(Opened(2).handle, nullptr);
  }
  one.plug();
  const Opened again(1);
  ASSERT_NE(again.handle, nullptr);
  EXPECT_EQ(libusb_claim_interface(again.handle, 0), 0);
}

}  // namespace
}  // namespace presa::falcon_model::test
