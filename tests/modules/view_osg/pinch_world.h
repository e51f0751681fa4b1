#pragma once
#include <memory>
#include <string>

#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"
#include "framework/session/view.h"

/// A cube held by two fingers above a table, built in code, without a scene file or other modules.
namespace presa::view_test {

inline constexpr double kCubeEdge = 0.07;  ///< [m]

struct PinchRun {
  std::shared_ptr<World> world;
  RunOptions options;
};
PinchRun makePinchRun(RunOptions::View view, const std::string& screenshot);

/// The states that other modules would publish.
struct PinchStates {
  DeviceState device;
  ContactExchange contacts;
  ForceCommand forces;
  ObjectState objects;
};
/// The thumb sticks, the index slips; the cube's centre is at `p_WO`, rotated by `yaw` about z.
PinchStates makePinchStates(const World& world, const Vec3& p_WO, double yaw = 0);

/// Feeds a view's ports like the graph.
class Feed {
 public:
  explicit Feed(Module& view);
  ~Feed();
  void publish(const PinchStates& states, double time);

 private:
  struct Bridges;
  std::unique_ptr<Bridges> bridges_;
};

}  // namespace presa::view_test
