#pragma once
#include <optional>
#include <vector>

#include "framework/assembly/assembly_guide.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/finger_neighbourhood.h"
#include "framework/scene/frame_state.h"
#include "framework/scene/joints/joint_positions.h"
#include "framework/scene/tool_state.h"

namespace presa::view {

/// One moment of the run, copied from the ports: the input of a picture.
struct ViewFrame {
  double time = 0;                                       ///< [s]
  std::vector<Pose> X_WB;                                ///< in the order of Scene::bodies
  std::vector<bool> asleep;                              ///< in the order of Scene::bodies
  const FingerNeighbourhoods* neighbourhoods = nullptr;  ///< value of the port; null: not connected
  const JointPositions* joint_positions = nullptr;       ///< value of the port; null: not connected
  DeviceState device;
  ContactExchange contacts;
  ForceCommand forces;
  const ToolStates* tools = nullptr;   ///< value of the port; null: not connected
  const FrameState* frames = nullptr;  ///< value of the port; null: the rig has no frames
  std::optional<Guidance> guidance;    ///< only in scenes with an assembly
};

}  // namespace presa::view
