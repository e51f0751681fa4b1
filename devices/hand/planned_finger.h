#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/hand/hand.h"
#include "devices/hand/hand_settings.h"
#include "devices/hand/pair_plan.h"

namespace presa {

/// One fingertip of a pair that follows a plan, on the spring of a hand.
struct PlannedFinger {
  std::unique_ptr<PairPlan> plan;
  double side = 1;  ///< -1: thumb, at the negative end of the line between the fingertips; 1: index
  HandSettings settings;
  std::vector<std::string> phases;  ///< names indexed by PairPlan::phase
  std::string model;                ///< Device::model
};
/// A hand that observes the bodies.
std::unique_ptr<Hand> makePlannedFinger(PlannedFinger finger);

}  // namespace presa
