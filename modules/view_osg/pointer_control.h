#pragma once
#include <cstddef>
#include <vector>

#include "framework/core/state/device_state.h"
#include "framework/device/pointer_state.h"
#include "modules/view_osg/camera_control.h"

namespace presa::view {

/// Where the user wants the pair of fingers. It starts where the fingers are, and moves by what mouse and keys ask for.
class PointerControl {
 public:
  static constexpr double kStep = 0.005;                   ///< of an arrow key [m]
  static constexpr double kTurnStep = 0.0872664625997165;  ///< of a key, five degrees [rad]
  static constexpr double kCloseStep = 0.04;               ///< of a notch of the wheel or a key

  /// Indices into DeviceState::fingers.
  explicit PointerControl(std::vector<std::size_t> fingers) : fingers_(std::move(fingers)) {}

  /// Takes the start from the fingers, as soon as all of them give samples; does nothing from then on.
  void begin(const DeviceState& device);

  /// The mouse went so far, in halves of the picture's height: over the ground the pair stays under the mouse.
  void dragLevel(double right, double up, const CameraControl& camera);
  /// The same in the upright plane that faces the camera.
  void dragUpright(double right, double up, const CameraControl& camera);
  /// To the camera's right, level away from it, up [m].
  void move(double right, double away, double up, const CameraControl& camera);
  void turn(double angle);
  void close(double amount);

  const PointerState& state() const { return state_; }

 private:
  void changed() { ++state_.sequence; }

  std::vector<std::size_t> fingers_;
  bool begun_ = false;
  PointerState state_;
};

}  // namespace presa::view
