#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "framework/core/exchange/event_ring.h"
#include "framework/core/graph/port.h"
#include "framework/core/schedule/executor.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/contact_patch.h"
#include "framework/core/state/object_state.h"
#include "framework/device/device.h"
#include "framework/device/output_stage.h"
#include "framework/device/sample_check.h"
#include "framework/scene/ages.h"

namespace presa {

/// The devices of a run, in the order of the scene's roles. Opened and closed by the program's main thread.
using DeviceList = std::vector<std::unique_ptr<Device>>;

/// Something went wrong while running. Carried to the main thread by a ring.
struct FaultEvent {
  double time = 0;  ///< [s]
  std::int32_t finger = -1;
  std::uint32_t status = 0;  ///< the OutputStatus bit that came up
};

/// First module of the haptic group: reads every device into one Device State, and believes none of them unchecked.
class DeviceInput final : public Module {
 public:
  DeviceInput(DeviceList& devices, const RunControl& control);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override;

 private:
  DeviceList& devices_;
  const RunControl& control_;
  std::vector<SampleCheck> checks_;
  std::optional<In<ObjectState>> seen_;      // only when a device looks
  std::optional<In<PointerState>> pointer_;  // only when a device points
  Out<DeviceState> state_{*this, "device_state"};
};

/// The output stages and the devices behind them. Reads the ages of what the command was made from.
class DeviceOutput final : public Module {
 public:
  /// `safety`: as `devices`. `rates`: of the scene. `realtime`: the last fade, after the run, keeps the pace of the clock.
  DeviceOutput(DeviceList& devices, const std::vector<FingerSafety>& safety, const Rates& rates, bool realtime);
  void step(const Tick& tick) noexcept override;
  /// Takes every force down to zero within the slew limit, then lets go.
  void stop() override;
  std::vector<std::string> stages() const override;

  /// Main thread: the next fault or watchdog event; false when there is none.
  bool nextEvent(FaultEvent& event) noexcept { return events_.pop(event); }

  /// A device that gives no sample is at zero force after this [s], where slew allows it.
  static constexpr double kSilentZero = 0.005;

 private:
  OutputStage::Trust trust(std::size_t finger, const Tick& tick) const noexcept;
  void send(std::size_t finger, const Tick& tick) noexcept;
  void report(std::size_t finger, std::uint32_t before, std::uint32_t now, double time) noexcept;

  DeviceList& devices_;
  std::uint32_t rearms_ = 0;
  std::vector<OutputStage> stages_;
  std::vector<double> watchdog_;  ///< [s] per finger
  std::vector<std::uint32_t> reported_;
  bool realtime_;
  const double patch_age_;  ///< a contact patch older than this is dropped [s]
  Tick last_tick_;
  EventRing<FaultEvent> events_{256};
  In<DeviceState> device_{*this, "device_state"};
  In<ContactExchange> contact_{*this, "contact_exchange"};
  In<ContactPatches> patches_{*this, "contact_patches", In<ContactPatches>::Optional{}, WhenOld::kFadeToZero,
                              patch_age_};
  In<ObjectState> objects_;
  Out<ForceCommand> command_{*this, "force_command"};
};

}  // namespace presa
