#pragma once
#include <sys/types.h>

#include <memory>

#include "framework/device/device.h"
#include "framework/device/supervision/share.h"
#include "framework/device/supervision/shared_memory.h"
#include "framework/device/supervision/task.h"

namespace presa {

/// Proxy of a hardware device that runs in a process of its own, its supervisor, which takes the force to zero when
/// this process stops or dies. read and write exchange the latest values with it, wait-free, without a system call.
class SupervisedDevice final : public Device {
 public:
  /// `driver`: the same device, never opened here; it answers model(), facts(), damping(), mass() and
  /// measuresOrientation().
  SupervisedDevice(std::unique_ptr<Device> driver, const DeviceBinding& binding, std::string rig_file);
  ~SupervisedDevice() override { close(); }

  /// Starts the supervisor and waits until it has opened the device. Throws InputError with the supervisor's findings,
  /// E498 when it does not start, E499 when it ended.
  void open() override;
  /// Ends the supervisor, which takes the force to zero before it closes the device; kills it after a second.
  void close() noexcept override;
  /// After the device or its supervisor was lost: ends the old supervisor and starts a new one, which opens the device.
  void reopen(const std::atomic<bool>& stop) override;
  FingerInput read(const Tick& tick) noexcept override;
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override;
  void rearm() noexcept override;

  std::string model() const override { return driver_->model(); }
  std::vector<DeviceFact> facts() const override { return driver_->facts(); }
  bool measuresOrientation() const override { return driver_->measuresOrientation(); }
  double damping() const override { return driver_->damping(); }
  double turnDamping() const override { return driver_->turnDamping(); }
  double mass() const override { return driver_->mass(); }
  std::vector<std::string> notes() const override { return notes_; }

  pid_t supervisor() const noexcept { return child_; }  ///< its process; -1: none
  /// The supervisor's last report. Haptic thread only, or while no thread runs.
  const SupervisorReport& report() const noexcept { return live_.load()->report.value(); }

  static constexpr double kSilent = 2e-3;  ///< without a report for longer, the sample is not valid [s]
  static constexpr double kDead = 20e-3;   ///< without a report for longer, the device is lost [s]

 private:
  void start(const std::atomic<bool>& stop);
  void spawn();
  void end() noexcept;
  bool hasEnded() noexcept;
  [[noreturn]] void refuse(int code, const std::string& message, const std::string& help) const;

  std::unique_ptr<Device> driver_;
  SupervisorTask task_;
  SharedMemory<SupervisorShare> share_;                 // of the newest supervisor
  std::vector<SharedMemory<SupervisorShare>> retired_;  // kept mapped: the haptic thread may still read them
  std::atomic<SupervisorShare*> live_{nullptr};         // the one that read and write use
  std::vector<std::string> notes_;
  pid_t child_ = -1;
  int life_ = -1;  // our end of the pipe: the supervisor sees it close when this process dies
  // haptic thread only
  SupervisorShare* seen_ = nullptr;
  double silence_ = 0;
  std::atomic<bool> lost_{false};  // read by the main thread
};

}  // namespace presa
