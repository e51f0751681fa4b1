#include "apps/presa/temple/rebuild.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "framework/scene/goal_pose.h"

namespace presa::temple {
namespace {

constexpr double kLifted = 0.02;  // above where it was taken [m]
constexpr double kFalls = 0.5;    // [m/s]

}  // namespace

Witness::Witness(std::size_t bodies) : Module("witness", RateGroup::kHaptic), taken_(bodies, kNotTaken) {}

void Witness::step(const Tick&) noexcept {
  if (!objects_.hasValue() || !assembly_.hasValue()) return;
  for (std::size_t f = 0; f < static_cast<std::size_t>(contact_->count); ++f) {
    const FingerContact& finger = contact_->fingers[f];
    if (finger.mode == ContactMode::kNone) continue;
    depth_ += finger.depth;
    ++touches_;
    double& height = taken_[static_cast<std::size_t>(finger.body)];
    if (height == kNotTaken) height = objects_->bodies[static_cast<std::size_t>(finger.body)].X_WB_end.p.z();
  }
  for (std::size_t i = 0; i < taken_.size(); ++i) noteFall(i);
}

// Lifted and fast, downwards: out of the fingers.
void Witness::noteFall(std::size_t i) noexcept {
  if (taken_[i] == kNotTaken) return;
  const BodyMotion& body = objects_->bodies[i];
  if (body.v_WB.z() > -kFalls || body.X_WB_end.p.z() < taken_[i] + kLifted) return;
  ++drops_;
  taken_[i] = kNotTaken;
}

Rebuilt measure(const Assembly& assembly, const Witness& witness) {
  Rebuilt rebuilt;
  rebuilt.pieces = static_cast<int>(assembly.goals.size());
  rebuilt.placed = witness.assembly().filled;
  for (std::size_t g = 0; g < assembly.goals.size(); ++g) {
    const GoalState& state = witness.assembly().goals[g];
    if (state.status != GoalState::Status::kFilled) continue;
    const Pose& X_WB = witness.objects().bodies[static_cast<std::size_t>(state.body)].X_WB_end;
    const Way way = wayBetween(nearestTurn(assembly.goals[g].X_WB, assembly.goals[g].fold, X_WB.q), X_WB);
    rebuilt.worst_position_error = std::max(rebuilt.worst_position_error, way.distance);
    rebuilt.worst_angle_error = std::max(rebuilt.worst_angle_error, way.angle);
  }
  rebuilt.drops = witness.drops();
  rebuilt.mean_fingertip_depth = witness.meanFingertipDepth();
  rebuilt.faults = witness.objects().faults;
  return rebuilt;
}

std::string summaryText(const Rebuilt& r, const std::string& size, std::uint64_t seed) {
  const nlohmann::ordered_json summary{{"size", size},
                                       {"seed", seed},
                                       {"pieces", r.pieces},
                                       {"placed", r.placed},
                                       {"worst_position_error_m", r.worst_position_error},
                                       {"worst_angle_error_deg", r.worst_angle_error * 180 / std::numbers::pi},
                                       {"drops", r.drops},
                                       {"mean_fingertip_depth_m", r.mean_fingertip_depth},
                                       {"simulated_s", r.simulated_seconds},
                                       {"wall_s", r.wall_seconds},
                                       {"faults", r.faults}};
  return summary.dump(2) + "\n";
}

}  // namespace presa::temple
