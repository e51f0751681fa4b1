#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/common/grasp_turn.h"
#include "apps/common/run_result.h"

namespace presa {

/// Figures of one finger while the object was held and released.
struct FingerGrasp {
  std::size_t contact_point = 0;      ///< index into RunResult::contact_points
  double stick_fraction = 0;          ///< part of the hold phase in stick on the object, 0 … 1
  double offset_range = 0;            ///< diagonal of the proxy's bounding box in object coordinates [m]
  double mean_normal_force = 0;       ///< over the hold phase [N]
  double weight_share = 0;            ///< mean upward force on the object over m g / n; 1 for a fair share
  std::optional<double> grip_ripple;  ///< peak to peak over mean of the normal force, last 2 s of hold
  std::optional<SlipOnset> slip;      ///< first slip from the object after the release began
  double slip_step = 0;               ///< fall of the normal force in the dynamics period before that slip [N]
};

/// The figures of a grasp–hold–release run, from its trace.
struct GraspFigures {
  std::size_t object = 0;               ///< index into RunResult::objects
  double hold_begin = 0, hold_end = 0;  ///< the hold phase, as far as it was run [s]
  double release_begin = 0;             ///< of the first phase that lets go; infinity: none does [s]
  bool lifted = false;                  ///< the motion has a phase that lifts
  double lift_height = 0;               ///< mean height of the object's origin during hold above its start [m]
  double held_in_stick = 0;             ///< longest unbroken time in hold with every holding finger in stick [s]
  bool carried =
      true;  ///< by the fingers alone; else a joint or a body effect takes part, and turn and slip_limit are left out
  std::optional<GraspTurn> turn;  ///< of object and hand, from the begin of the grasp to the end of the hold
  /// Normal force per finger at which friction stops carrying the weight, m g / (n mu_s), for n equal fingers on
  /// upright faces [N].
  double slip_limit = 0;
  std::vector<FingerGrasp> fingers;  ///< fingers that held the object
};

/// None unless the run has a trace, a phase whose intent is to hold, and a traced object that at least two fingers
/// touched at once during the hold. Of several objects, takes the one touched longest.
std::optional<GraspFigures> graspFigures(const RunResult& result);

}  // namespace presa
