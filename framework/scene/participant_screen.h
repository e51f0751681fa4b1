#pragma once
#include <string>

namespace presa {

/// What a participant of an experiment sees of a run. Without `measured` the picture is the same whatever fingers feel:
/// no force, contact state or penetration changes a pixel of it.
struct ParticipantScreen {
  bool bodies = true;      ///< of the scene
  bool fingertips = true;  ///< where the surfaces hold them
  bool measured = false;   ///< forces, friction cones, HIPs and figures, as an operator sees them
  bool fixation = false;   ///< a cross in the middle
  std::string text{};      ///< instruction or question
  bool operator==(const ParticipantScreen&) const = default;  ///< the same screen
};

}  // namespace presa
