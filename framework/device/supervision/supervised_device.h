#pragma once
#include <sys/types.h>

#include <memory>

#include "framework/device/device.h"
#include "framework/device/supervision/share.h"
#include "framework/device/supervision/shared_memory.h"
#include "framework/device/supervision/task.h"

namespace presa {

/// A device of real hardware that lives in a process of its own, its supervisor, which takes the force to zero when this process
/// stops or dies. read and write exchange the latest values with it, wait-free, without a system call.
class SupervisedDevice final : public Device {
 public:
  /// `driver`: the same device, never opened here; it answers what there is to know of it.
  SupervisedDevice(std::unique_ptr<Device> driver, const DeviceBinding& binding, std::string rig_file);
  ~SupervisedDevice() override { close(); }

  /// Starts the supervisor and waits until it has the device. Throws its findings; E498 it does not start, E499 it died.
  void open() override;
  /// The device is let go at zero force.
  void close() noexcept override;
  /// After the device or its supervisor was lost: the old one, if it still lives, ends, and a new one opens the device.
  void reopen(const std::atomic<bool>& stop) override;
  FingerInput read(const Tick& tick) noexcept override;
  void write(const Vec3& f_H_W, const Tick& tick) noexcept override;
  void rearm() noexcept override;

  std::string model() const override { return driver_->model(); }
  std::vector<DeviceFact> facts() const override { return driver_->facts(); }
  double damping() const override { return driver_->damping(); }
  std::vector<std::string> notes() const override { return notes_; }

  pid_t supervisor() const noexcept { return child_; }
  /// Any thread may not: haptic thread, or nobody runs. What the supervisor said last.
  const SupervisorReport& report() const noexcept { return live_.load()->report.value(); }

  static constexpr double kSilent = 2e-3;  ///< a supervisor that says nothing for so long has no sample [s]
  static constexpr double kDead = 20e-3;   ///< and for so long is lost [s]

 private:
  void start(const std::atomic<bool>& stop);
  void spawn();
  void end() noexcept;
  bool hasEnded() noexcept;
  [[noreturn]] void refuse(int code, const std::string& message, const std::string& help) const;

  std::unique_ptr<Device> driver_;
  SupervisorTask task_;
  SharedMemory<SupervisorShare> share_;                 // of the newest supervisor
  std::vector<SharedMemory<SupervisorShare>> retired_;  // the haptic thread may have been reading there
  std::atomic<SupervisorShare*> live_{nullptr};         // where it reads and writes
  std::vector<std::string> notes_;
  pid_t child_ = -1;
  int life_ = -1;  // while it is open, this process lives
  // haptic thread's
  SupervisorShare* seen_ = nullptr;
  double silence_ = 0;
  std::atomic<bool> lost_{false};  // told to the main thread
};

}  // namespace presa
