#pragma once
#include <array>
#include <memory>

#include "devices/novint_falcon/byte_ring.h"
#include "devices/novint_falcon/transport.h"
#include "devices/novint_falcon/usb_bus.h"

struct libusb_transfer;

namespace presa::falcon {

/// What a converter's bulk packets carry: the first two bytes of every 64 are its own. Appends the rest to `ring`.
template <std::size_t kCapacity>
void takePayload(std::span<const std::uint8_t> received, ByteRing<kCapacity>& ring) noexcept {
  constexpr std::size_t kUsbPacket = 64, kStatusBytes = 2;
  for (std::size_t i = 0; i < received.size(); ++i)
    if (i % kUsbPacket >= kStatusBytes) ring.push(received[i]);
}

/// A Falcon over libusb: transfers are made once and sent again and again, two reads always on their way. Nothing waits but
/// control requests and the end. libusb itself takes some memory at each sending, so this is not for the haptic thread.
/// Thread: one.
class UsbTransport final : public FalconTransport {
 public:
  explicit UsbTransport(UsbHandle handle);
  ~UsbTransport() override;
  UsbTransport(const UsbTransport&) = delete;
  UsbTransport& operator=(const UsbTransport&) = delete;

  bool control(Control control, double now) noexcept override;
  bool write(std::span<const std::uint8_t> bytes, double now) noexcept override;
  std::size_t read(std::span<std::uint8_t> buffer, double now) noexcept override;
  bool lost() const noexcept override { return lost_; }

 private:
  /// A transfer, its bytes, and whether the bus has it.
  struct Slot {
    UsbTransport* owner = nullptr;
    libusb_transfer* transfer = nullptr;
    std::array<std::uint8_t, 64> bytes{};  // exactly one packet: other sizes caused faults on some hosts
    bool on_its_way = false;
    bool halted = false;
  };

  static void onDone(libusb_transfer* transfer) noexcept;
  std::unique_ptr<Slot> makeSlot(std::uint8_t endpoint, unsigned timeout_ms);
  void submit(Slot& slot) noexcept;
  void handleEvents() noexcept;
  void keepReading() noexcept;
  void watchForUnplugging() noexcept;

  UsbHandle handle_;
  std::array<std::unique_ptr<Slot>, 2> in_;
  std::unique_ptr<Slot> out_;
  int watch_ = 0;  // number of the hotplug callback, when watching_
  bool watching_ = false, closing_ = false, lost_ = false;
  ByteRing<1024> received_;
};

}  // namespace presa::falcon
