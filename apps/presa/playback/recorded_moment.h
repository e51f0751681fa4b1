#pragma once
#include <array>
#include <optional>

#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "framework/record/recording.h"
#include "framework/scene/frame_state.h"
#include "framework/scene/world.h"

namespace presa {

/// The states of a recorded run at its ticks, as far as a view needs them.
class RecordedMoment {
 public:
  /// Both must outlive this; the world is that of the recording.
  RecordedMoment(const RecordedSamples& samples, const World& world);

  double begin() const { return samples_.time.front(); }
  double end() const { return samples_.time.back(); }
  /// Sets the states to the last tick at or before this time.
  void fill(double time, ObjectState& objects, DeviceState& device, ContactExchange& contacts,
            ForceCommand& command) const;
  /// The frames of the rig, which the recording has from format 10 on.
  bool hasFrames() const { return !frames_.empty(); }
  void fillFrames(double time, FrameState& state) const;

 private:
  /// Column indices of one table, looked up once.
  using Column = const std::vector<double>*;
  using Vector = std::array<Column, 3>;
  struct FingerColumns {
    Vector p_WH, v_WH, p_WP, p_BP, p_BC, nhat_W, tangential, rendered, command;
    Column depth, normal, phase, valid, mode, body;
    std::optional<std::array<Column, 4>> q_WT;  ///< of an oriented tool
  };
  struct BodyColumns {
    std::size_t body;
    Vector p_WB, v_WB, w_WB;
    std::array<Column, 4> q_WB;
  };
  struct FrameColumns {
    Vector p_WF;
    std::array<Column, 4> q_WF;
    Column zoom, doing, uses, refusals;
  };
  std::size_t rowAt(double time) const;
  void fillFinger(const FingerColumns& finger, std::size_t row, const ObjectState& objects, FingerInput& input,
                  FingerContact& contact) const;

  const RecordedSamples& samples_;
  const World& world_;
  std::vector<FingerColumns> fingers_;
  std::vector<BodyColumns> moved_;
  std::vector<FrameColumns> frames_;
};

}  // namespace presa
