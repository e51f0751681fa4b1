#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/common/run_result.h"

namespace presa {

/// What one finger did while the object was held and let go.
struct FingerGrasp {
  std::size_t contact_point = 0;      ///< index into RunResult::contact_points
  double stick_fraction = 0;          ///< part of the hold phase in stick on the object, 0 … 1
  double offset_range = 0;            ///< diagonal of the box that the proxy kept to in object coordinates [m]
  double mean_normal_force = 0;       ///< over the hold phase [N]
  double weight_share = 0;            ///< mean upward force on the object over m g / n; 1 for a fair share
  std::optional<double> grip_ripple;  ///< peak to peak over mean of the normal force, last 2 s of hold
  std::optional<SlipOnset> slip;      ///< first slip from the object after loosening began
};

/// The figures of a grasp–hold–release run, from its trace.
struct GraspFigures {
  std::size_t object = 0;               ///< index into RunResult::objects
  double hold_begin = 0, hold_end = 0;  ///< part of the hold phase that was run [s]
  double loosen_begin = 0;              ///< [s]
  double lift_height = 0;               ///< mean height of the object's origin during hold above its start [m]
  double held_in_stick = 0;             ///< longest unbroken time in hold with every holding finger in stick [s]
  /// Normal force per finger at which friction stops carrying the weight, m g / (n mu_s), for n equal fingers on
  /// upright faces [N].
  double slip_limit = 0;
  std::vector<FingerGrasp> fingers;  ///< those that held the object
};

/// Nothing unless the run has a trace, phases named "hold" and "loosen", and a traced object that at least two
/// fingers touched at once during the hold. With several, the one touched longest.
std::optional<GraspFigures> graspFigures(const RunResult& result);

}  // namespace presa
