#pragma once
#include <optional>
#include <vector>

#include "framework/assembly/assembly_guide.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/contact_patch.h"
#include "framework/core/state/device_state.h"

namespace presa::view {

/// One moment of the run, copied from the ports: all that a picture is made of.
struct ViewFrame {
  double time = 0;                          ///< [s]
  std::vector<Pose> X_WB;                   ///< as Scene::bodies
  std::vector<bool> asleep;                 ///< as Scene::bodies
  const ContactPatches* patches = nullptr;  ///< of the port; null: there are none
  DeviceState device;
  ContactExchange contacts;
  ForceCommand forces;
  std::optional<Guidance> guidance;  ///< of scenes with an assembly
};

}  // namespace presa::view
