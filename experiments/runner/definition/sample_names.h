#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "experiments/runner/definition/expression.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/scene.h"

namespace presa::experiment {

/// Variables of every haptic tick that phases and measures may use, in SI units, world frame:
///   t (since the start of the trial), t_phase, signal (1 while the participant presses a button on any device);
///   ROLE.x .y .z .vx .vy .vz (fingertip) .fx .fy .fz (force sent to the device) .fn .ft (normal and tangential
///   contact force) .depth .state (0 none, 1 stick, 2 slip);
///   BODY.x .y .z .vx .vy .vz .speed of every free body, and .lift, its height above its start position.
SymbolTable sampleNames(const Scene& scene);

/// Fills one sample. `values` has the size of sampleNames(scene). Thread: haptic; nonblocking.
class SampleReader {
 public:
  /// `asked`, by slot: a free body without a used slot is skipped, and its slots keep their values.
  SampleReader(const Scene& scene, const std::vector<bool>& asked);
  void read(double time, const DeviceState& device, const ContactExchange& contact, const ForceCommand& command,
            const ObjectState* objects, std::span<double> values) const noexcept;

  static constexpr std::size_t kTime = 0, kPhaseTime = 1, kSignal = 2;  // slots

 private:
  struct FreeBody {
    std::size_t index, slot;
    double start_z;
  };
  std::vector<FreeBody> bodies_;
  std::size_t roles_;
};

}  // namespace presa::experiment
