#pragma once
#include <cstdint>

#include "framework/core/math/spatial.h"

namespace presa {

/// What a user wants of the frames of a rig while keys or buttons are held.
struct FrameWish {
  Vec3 walk = Vec3::Zero();  ///< share of the speed along the frame's axes: x ahead, y to the left, z up; -1 to 1
  double turn = 0;           ///< share of the rate about z; -1 to 1
  double zoom = 0;           ///< 1: to the larger scale, -1: to the smaller
  bool clutch = false;       ///< held: the frame slides back under the hand
};

/// Button of a stylus that key p presses: it puts tools down and picks them up.
inline constexpr int kPickUpButton = 1;

/// Name of the port that carries a PointerState.
inline constexpr const char* kPointerPort = "pointer_state";

/// Pose that the user at the window wants for a pair of fingertips, or for a stylus. Each value is complete: a reader
/// may miss some. Written by: view thread.
struct PointerState {
  std::uint64_t sequence = 0;  ///< grows with every change; 0: no input yet
  Vec3 p_WT = Vec3::Zero();    ///< midpoint between the fingertips' centres; tip of a stylus [m]
  double yaw = 0;              ///< angle from +x to the horizontal line thumb to index, about +z [rad]; unbounded;
                               ///< direction in which a stylus leans
  double closing = 0;          ///< 0: wide open; 1: closed as hard as the pair may
  double tilt = 0;             ///< of a stylus, from upright [rad]
  double wheel = 0;  ///< sum of all steps of closing, unbounded: counts them also where `closing` is at its end
  FrameWish frames;  ///< of the frames of the rig that a user moves
  std::uint32_t buttons = 0;  ///< pressed now, bits as in FingerInput::buttons
};

}  // namespace presa
