#pragma once
#include <array>
#include <memory>

#include "devices/novint_falcon/byte_ring.h"
#include "devices/novint_falcon/transport.h"
#include "devices/novint_falcon/usb_bus.h"

struct libusb_transfer;

namespace presa::falcon {

/// Appends the payload of the converter's bulk packets to `ring`; the first two bytes of every 64 are status.
template <std::size_t kCapacity>
void takePayload(std::span<const std::uint8_t> received, ByteRing<kCapacity>& ring) noexcept {
  constexpr std::size_t kUsbPacket = 64, kStatusBytes = 2;
  for (std::size_t i = 0; i < received.size(); ++i)
    if (i % kUsbPacket >= kStatusBytes) ring.push(received[i]);
}

/// A Falcon over libusb. Transfers are allocated once and resubmitted; two reads are always pending. Only control
/// requests and the destructor wait. libusb allocates at each submission, so this is not for the haptic thread.
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
  /// A transfer with its buffer and its state.
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
  int watch_ = 0;  // handle of the hotplug callback, when watching_
  bool watching_ = false, closing_ = false, lost_ = false;
  ByteRing<1024> received_;
};

}  // namespace presa::falcon
