#pragma once
#include <cstdint>
#include <string>

#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"

namespace presa {

/// The states at one haptic tick, after the output stage. The references are valid during the call only.
struct HapticSample {
  const Tick& tick;
  const DeviceState& device;
  const ContactExchange& contact;
  const ForceCommand& command;
  const ObjectState* objects;     ///< newest state, null without dynamics; poseAt(body, tick.time) is the current pose
  std::uint64_t objects_version;  ///< increases by one per dynamics step
};

/// A module that sees every haptic tick after the output stage and changes nothing: monitor, status line, trial, study.
/// In ports, all optional (a scene without fingers has none): device_state, contact_exchange, force_command,
/// object_state, shown_objects. Thread: haptic; nonblocking.
class HapticObserver : public Module {
 public:
  explicit HapticObserver(std::string name) : Module(std::move(name), RateGroup::kHaptic) {}
  virtual void observe(const HapticSample& sample) noexcept = 0;
  void step(const Tick& tick) noexcept final {
    const In<ObjectState>& objects = shown_.connected() ? shown_ : objects_;
    observe({tick, device_.value(), contact_.value(), command_.value(),
             objects_.connected() && objects_.hasValue() ? &objects.value() : nullptr, objects_.version()});
  }

 private:
  In<DeviceState> device_{*this, "device_state", In<DeviceState>::Optional{}};
  In<ContactExchange> contact_{*this, "contact_exchange", In<ContactExchange>::Optional{}};
  In<ForceCommand> command_{*this, "force_command", In<ForceCommand>::Optional{}};
  In<ObjectState> objects_{*this, "object_state", In<ObjectState>::Optional{}};
  In<ObjectState> shown_{*this, kShownObjectsPort, In<ObjectState>::Optional{}};
};

}  // namespace presa
