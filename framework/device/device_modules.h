#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "framework/core/exchange/event_ring.h"
#include "framework/core/graph/port.h"
#include "framework/core/schedule/executor.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/finger_neighbourhood.h"
#include "framework/core/state/object_state.h"
#include "framework/device/device.h"
#include "framework/device/output_stage.h"
#include "framework/device/sample_check.h"
#include "framework/scene/ages.h"

namespace presa {

/// A fault of the output stage during a run. A ring carries it to the main thread.
struct FaultEvent {
  double time = 0;           ///< [s]
  std::int32_t finger = -1;  ///< index into the scene's roles
  std::uint32_t status = 0;  ///< the OutputStatus bits that were newly set
};

/// First module of the haptic group: reads every device, checks each sample (SampleCheck) and writes the Device State.
class DeviceInput final : public Module {
 public:
  DeviceInput(DeviceList& devices, const RunControl& control);  ///< keeps references to both
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

/// Last module of the haptic group: passes each finger's force through its OutputStage and writes it to the device. The
/// ages of the sample, the neighbourhoods and the Object State decide how far the stage trusts the command.
class DeviceOutput final : public Module {
 public:
  /// `safety`: one entry per device. `rates`: the scene's. `realtime`: stop() paces its last fade by the clock.
  DeviceOutput(DeviceList& devices, const std::vector<FingerSafety>& safety, const Rates& rates, bool realtime);
  void step(const Tick& tick) noexcept override;
  /// After the last tick: takes every force down to zero within the slew limit.
  void stop() override;
  std::vector<std::string> stages() const override;

  /// Main thread: the next fault or watchdog event; false when there is none.
  bool nextEvent(FaultEvent& event) noexcept { return events_.pop(event); }

  /// A device without samples is at zero force after this time [s], if the slew limit allows it.
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
  const double neighbourhood_age_;  ///< a neighbourhood older than this is dropped [s]
  Tick last_tick_;
  EventRing<FaultEvent> events_{256};
  In<DeviceState> device_{*this, "device_state"};
  In<ContactExchange> contact_{*this, "contact_exchange"};
  In<FingerNeighbourhoods> neighbourhoods_{*this, "contact_patches", In<FingerNeighbourhoods>::Optional{},
                                           WhenOld::kFadeToZero, neighbourhood_age_};
  In<ObjectState> objects_;
  Out<ForceCommand> command_{*this, "force_command"};
};

}  // namespace presa
