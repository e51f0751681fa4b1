#include "devices/novint_falcon/usb_transport.h"

#include <libusb-1.0/libusb.h>

#include <algorithm>
#include <new>

namespace presa::falcon {
namespace {

constexpr std::uint8_t kIn = 0x81, kOut = 0x02;
constexpr std::uint8_t kVendorOut = 0x40;
constexpr unsigned kControlTimeout = 100, kWriteTimeout = 100;  // [ms]
constexpr int kMaxClosingRounds = 100;                          // of 10 ms

}  // namespace

UsbTransport::UsbTransport(UsbHandle handle) : handle_(std::move(handle)) {
  for (auto& slot : in_) slot = makeSlot(kIn, 0);
  out_ = makeSlot(kOut, kWriteTimeout);
  watchForUnplugging();
  keepReading();
}

UsbTransport::~UsbTransport() {
  closing_ = true;
  if (watching_) libusb_hotplug_deregister_callback(handle_.context(), watch_);
  const std::array slots{&in_[0], &in_[1], &out_};
  for (auto* slot : slots)
    if ((*slot)->on_its_way) libusb_cancel_transfer((*slot)->transfer);
  const auto under_way = [](auto* slot) { return (*slot)->on_its_way; };
  for (int round = 0; round < kMaxClosingRounds && std::any_of(slots.begin(), slots.end(), under_way); ++round) {
    timeval wait{.tv_sec = 0, .tv_usec = 10'000};
    libusb_handle_events_timeout_completed(handle_.context(), &wait, nullptr);
  }
  for (auto* slot : slots) {
    if (under_way(slot))
      static_cast<void>(slot->release());  // leak it: the bus may still write to it
    else
      libusb_free_transfer((*slot)->transfer);
  }
}

std::unique_ptr<UsbTransport::Slot> UsbTransport::makeSlot(std::uint8_t endpoint, unsigned timeout_ms) {
  auto slot = std::make_unique<Slot>();
  slot->owner = this;
  slot->transfer = libusb_alloc_transfer(0);
  if (slot->transfer == nullptr) throw std::bad_alloc();
  libusb_fill_bulk_transfer(slot->transfer, handle_.get(), endpoint, slot->bytes.data(),
                            static_cast<int>(slot->bytes.size()), onDone, slot.get(), timeout_ms);
  return slot;
}

void UsbTransport::watchForUnplugging() noexcept {
  if (libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG) == 0) return;
  const auto left = [](libusb_context*, libusb_device* device, libusb_hotplug_event, void* data) {
    auto& self = *static_cast<UsbTransport*>(data);
    if (device == libusb_get_device(self.handle_.get())) self.lost_ = true;
    return 0;
  };
  watching_ =
      libusb_hotplug_register_callback(handle_.context(), LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT, 0, kVendor, kProduct,
                                       LIBUSB_HOTPLUG_MATCH_ANY, left, this, &watch_) == LIBUSB_SUCCESS;
}

void UsbTransport::submit(Slot& slot) noexcept {
  const int error = libusb_submit_transfer(slot.transfer);
  slot.on_its_way = error == 0;
  if (error == LIBUSB_ERROR_NO_DEVICE) lost_ = true;
}

// Called within handleEvents, on the same thread.
void UsbTransport::onDone(libusb_transfer* transfer) noexcept {
  Slot& slot = *static_cast<Slot*>(transfer->user_data);
  UsbTransport& self = *slot.owner;
  slot.on_its_way = false;
  if (self.closing_) return;
  if (transfer->status == LIBUSB_TRANSFER_NO_DEVICE) self.lost_ = true;
  if (transfer->status == LIBUSB_TRANSFER_STALL) slot.halted = true;
  if (transfer->endpoint != kIn) return;
  if (transfer->status == LIBUSB_TRANSFER_COMPLETED) {
    takePayload({slot.bytes.data(), static_cast<std::size_t>(transfer->actual_length)}, self.received_);
    self.submit(slot);
  }
}

void UsbTransport::handleEvents() noexcept {
  timeval now{};
  if (libusb_handle_events_timeout_completed(handle_.context(), &now, nullptr) == LIBUSB_ERROR_NO_DEVICE) lost_ = true;
}

void UsbTransport::keepReading() noexcept {
  for (const auto& slot : in_) {
    if (slot->on_its_way || lost_) continue;
    if (slot->halted && libusb_clear_halt(handle_.get(), kIn) == LIBUSB_ERROR_NO_DEVICE) lost_ = true;
    slot->halted = false;
    submit(*slot);
  }
}

bool UsbTransport::control(Control control, double) noexcept {
  if (lost_) return false;
  const FtdiRequest request = ftdiRequestOf(control);
  const int result = libusb_control_transfer(handle_.get(), kVendorOut, request.request, request.value, 0, nullptr, 0,
                                             kControlTimeout);
  if (result == LIBUSB_ERROR_NO_DEVICE) lost_ = true;
  if (control == Control::kPurgeReceive) {
    handleEvents();
    received_.drop(received_.size());
  }
  return result >= 0;
}

bool UsbTransport::write(std::span<const std::uint8_t> bytes, double) noexcept {
  if (bytes.empty() || bytes.size() > kMaxWrite || lost_) return false;
  if (out_->on_its_way) handleEvents();
  if (out_->on_its_way || lost_) return false;
  if (out_->halted && libusb_clear_halt(handle_.get(), kOut) == LIBUSB_ERROR_NO_DEVICE) lost_ = true;
  out_->halted = false;
  std::copy(bytes.begin(), bytes.end(), out_->bytes.begin());
  out_->transfer->length = static_cast<int>(bytes.size());
  submit(*out_);
  return out_->on_its_way;
}

std::size_t UsbTransport::read(std::span<std::uint8_t> buffer, double) noexcept {
  handleEvents();
  keepReading();
  const std::size_t count = std::min(buffer.size(), received_.size());
  for (std::size_t i = 0; i < count; ++i) buffer[i] = received_[i];
  received_.drop(count);
  return count;
}

}  // namespace presa::falcon
