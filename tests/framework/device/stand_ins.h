#pragma once
#include "framework/core/graph/module.h"
#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/finger_neighbourhood.h"
#include "framework/core/state/object_state.h"

// Test modules that replace the modules before the output stage.
namespace presa::test {

/// Replaces the rendering: commands a given wrench to every finger.
class Commands final : public Module {
 public:
  explicit Commands(const Wrench& wish = {}, std::size_t fingers = 1)
      : Module("rendering", RateGroup::kHaptic), wanted(wish) {
    out.value = ContactExchange(fingers);
  }
  void step(const Tick& tick) noexcept override {
    if (stalled) return;
    out.value.time = tick.time;
    for (auto& finger : out.value.fingers) {
      finger.f_H_W = wanted.f;
      finger.t_H_W = wanted.t;
    }
  }
  Wrench wanted;
  bool stalled = false;  ///< keeps the last contact, with its old time
  Out<ContactExchange> out{*this, "contact_exchange"};
};

/// Replaces the dynamics: reports a fault, or stops, on request.
class Objects final : public Module {
 public:
  Objects() : Module("objects", RateGroup::kDynamics) {}
  void step(const Tick& tick) noexcept override {
    out.value.time_begin = tick.time;
    out.value.faults = fault ? std::uint32_t{kFaultBodyFrozen} : 0U;
  }
  bool fault = false;
  Out<ObjectState> out{*this, "object_state"};
};

/// Replaces the collision thread.
class Neighbourhoods final : public Module {
 public:
  Neighbourhoods() : Module("patches", RateGroup::kCollision) {}
  void step(const Tick& tick) noexcept override { out.value.time = tick.time; }
  Out<FingerNeighbourhoods> out{*this, "contact_patches"};
};

}  // namespace presa::test
