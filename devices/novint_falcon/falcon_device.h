#pragma once
#include <functional>
#include <memory>

#include "devices/novint_falcon/io_thread.h"
#include "devices/novint_falcon/settings.h"
#include "framework/device/device.h"

namespace presa::falcon {

/// The grip of a Falcon as a finger of the world (finger.h).
class FalconDevice final : public Device {
 public:
  /// Finds and claims the device; throws InputError on failure.
  using Connect = std::function<std::unique_ptr<FalconTransport>()>;
  FalconDevice(FalconSettings settings, Connect connect)
      : settings_(std::move(settings)), connect_(std::move(connect)) {}

  /// Connects, loads firmware if none is running, and waits until the grip is homed. Throws InputError (codes.h).
  void open() override;
  void close() noexcept override { io_.reset(); }
  FingerInput read(const Tick& tick) noexcept override;
  int buttons() const override { return 4; }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override;
  std::vector<std::string> notes() const override;

  /// State of the link. Main thread.
  LinkStatus status() { return io_ ? io_->status() : LinkStatus{}; }
  void rearm() noexcept override {
    if (io_) io_->rearm();
  }

 private:
  [[noreturn]] void refuseUnhomed(const LinkStatus& status) const;

  FalconSettings settings_;
  Connect connect_;
  std::unique_ptr<FalconIo> io_;
};

/// Connects over USB; throws InputError E487..E491.
std::unique_ptr<FalconTransport> connectOverUsb(const std::string& serial, const SourceLocation& where);

}  // namespace presa::falcon
