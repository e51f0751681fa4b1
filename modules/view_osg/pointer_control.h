#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "framework/core/state/device_state.h"
#include "framework/device/pointer_state.h"
#include "modules/view_osg/camera_control.h"

namespace presa::view {

/// Target pose of a pair of fingers or of a stylus, moved by mouse and keys. It starts at the fingers' own position.
class PointerControl {
 public:
  static constexpr double kStep = 0.005;                   ///< per arrow key [m]
  static constexpr double kTurnStep = 0.0872664625997165;  ///< per key, five degrees [rad]
  static constexpr double kCloseStep = 0.04;               ///< per wheel notch or key
  static constexpr double kLead = 0.1;                     ///< max vertical distance of target and fingers [m]
  static constexpr double kMaxTilt = 1.4;                  ///< [rad]
  static constexpr int kPressed = 3;                       ///< frames for which a key presses a button

  /// Indices into DeviceState::fingers.
  explicit PointerControl(std::vector<std::size_t> fingers) : fingers_(std::move(fingers)) {}

  /// Takes the start position as soon as all fingers deliver samples; no effect afterwards.
  void begin(const DeviceState& device);
  /// Keeps the target within kLead of the fingers' height, so that a drag against the ground, or against help, need not
  /// be undone by one of the same length; releases a button. Call once per frame.
  void heed(const DeviceState& device);

  /// Mouse drag in halves of the picture's height: moves the pair in a level plane, under the mouse.
  void dragLevel(double right, double up, const CameraControl& camera);
  /// As above, in the upright plane that faces the camera.
  void dragUpright(double right, double up, const CameraControl& camera);
  /// Moves to the camera's right, level away from it, and up [m].
  void move(double right, double away, double up, const CameraControl& camera);
  void turn(double angle);
  /// Wheel notches or keys: a pair closes by kCloseStep, a stylus tilts by kTurnStep.
  void close(double steps);
  /// Presses the button kPickUpButton for some frames.
  void press();

  const PointerState& state() const { return state_; }

 private:
  std::optional<Vec3> middle(const DeviceState& device) const;
  void changed() { ++state_.sequence; }

  std::vector<std::size_t> fingers_;
  bool begun_ = false;
  bool stylus_ = false;  ///< the tool measures its orientation
  int pressed_ = 0;      ///< frames until the button is released
  PointerState state_;
};

}  // namespace presa::view
