#include "devices/novint_falcon/falcon_device.h"

#include <array>
#include <cstdio>
#include <cstring>

#include "devices/novint_falcon/codes.h"
#include "devices/novint_falcon/finger.h"
#include "devices/novint_falcon/usb_transport.h"
#include "framework/core/schedule/clock.h"

namespace presa::falcon {
namespace {

[[noreturn]] void refuseAt(Code code, const SourceLocation& where, const std::string& message,
                           const std::string& help) {
  Diagnostics diagnostics;
  diagnostics.error(code, where, message, help);
  throw InputError(diagnostics);
}

/// Message of a fault, with details of a failed firmware upload.
std::string wordsOf(const LinkStatus& status, std::size_t firmware_size) {
  std::string words = describe(status.fault);
  std::array<char, 120> detail{};
  if (status.fault == LinkFault::kEchoMismatch) {
    std::snprintf(detail.data(), detail.size(), " (byte %zu of %zu: sent %02x, echoed %02x)", status.load.bytes,
                  firmware_size, status.load.expected, status.load.found);
  } else if (status.fault == LinkFault::kEchoMissing) {
    std::snprintf(detail.data(), detail.size(), " (after %zu of %zu bytes)", status.load.bytes, firmware_size);
  }
  words += detail.data();
  if (status.load.attempts > 0) words += ", in " + std::to_string(status.load.attempts) + " attempts";
  return words;
}

}  // namespace

std::unique_ptr<FalconTransport> connectOverUsb(const std::string& serial, const SourceLocation& where) {
  UsbFailure failure;
  UsbHandle handle = openFalcon(serial, failure);
  if (!handle) refuseAt(codeOf(failure.problem), where, describe(failure, serial), remedy(failure));
  return std::make_unique<UsbTransport>(std::move(handle));
}

void FalconDevice::open() {
  const std::string who = "role '" + settings_.role + "': ";
  if (!settings_.realtime)
    refuseAt(kNeedsRealTime, settings_.where, who + "a real device cannot be driven in virtual time", "add --realtime");
  io_ = std::make_unique<FalconIo>(connect_(), settings_.firmware, settings_.link);
  std::int64_t homing_since = 0;
  for (;; sleepUntilNs(monotonicNs() + 5'000'000)) {
    const LinkStatus status = io_->status();
    if (status.state == LinkState::kOperating) return;
    if (status.state == LinkState::kDead) {
      io_.reset();
      refuseAt(codeOf(status.fault), settings_.where, who + wordsOf(status, settings_.firmware.size()),
               remedy(status.fault));
    }
    if (status.state != LinkState::kHoming) continue;
    if (homing_since == 0) homing_since = monotonicNs();
    if (static_cast<double>(monotonicNs() - homing_since) * 1e-9 < settings_.homing_wait) continue;
    io_.reset();
    refuseUnhomed(status);
  }
}

void FalconDevice::refuseUnhomed(const LinkStatus& status) const {
  const std::string who = "role '" + settings_.role + "': ";
  std::string missing;
  for (int i = 0; i < 3; ++i)
    if ((status.homed & (1 << i)) == 0) missing += (missing.empty() ? "" : ", ") + std::to_string(i + 1);
  if (missing.empty())
    refuseAt(
        kUnevenReplies, settings_.where,
        who + "the grip is homed, but its replies leave gaps: " + std::to_string(status.replies) + " to " +
            std::to_string(status.requests) + " requests, never " + std::to_string(FalconLink::kHomedInARow) +
            " in a row",
        "this computer is too busy for 1 kHz, or the cable is bad: end other programs, give real-time rights (presa "
        "device doctor says how), use a port of the computer itself");
  refuseAt(
      kNotHomed, settings_.where, who + "the grip was not homed (no reference seen by encoder " + missing + ")",
      "while its light is blue, pull the grip all the way out, then push it in; homing_wait sets how long there is");
}

FingerInput FalconDevice::read(const Tick& tick) noexcept {
  if (!io_) return {};
  return fingerOf(io_->latest(tick), settings_.X_WD, settings_.scale);
}

void FalconDevice::write(const Wrench& F_H_W, const Tick&) noexcept {
  if (io_) io_->push(settings_.X_WD.q.conjugate() * F_H_W.f);
}

std::vector<std::string> FalconDevice::notes() const {
  if (!io_) return {};
  std::vector<std::string> notes{settings_.role + ": Novint Falcon; its newtons are uncalibrated (10 to 20 % at best)"};
  if (const int refused = io_->priorityRefused(); refused > 0)
    notes.push_back(settings_.role + ": the USB thread runs without SCHED_FIFO (" + std::strerror(refused) +
                    "): other programs may delay it");
  return notes;
}

}  // namespace presa::falcon
