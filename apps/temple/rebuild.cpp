#include "apps/temple/rebuild.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "framework/scene/goal_pose.h"

namespace presa::temple {
namespace {

constexpr double kLifted = 0.02;  // min height above the first touch of a lifted block [m]
constexpr double kFalls = 0.5;    // min downward speed of a falling block [m/s]

}  // namespace

BlockWatch::BlockWatch(std::shared_ptr<const World> world) : world_(std::move(world)) {
  std::vector<char> belongs(world_->scene.bodies.size());
  for (const AssemblyGoal& goal : world_->scene.assembly->goals) {
    for (const std::size_t body : goal.bodies) belongs[body] = 1;
  }
  for (std::size_t body = 0; body < belongs.size(); ++body) {
    if (belongs[body] != 0) blocks_.push_back(body);
  }
  outside_.resize(blocks_.size());
}

void BlockWatch::see(const ObjectState& objects) noexcept {
  const double period = objects.time_end - seen_;
  if (!(period > 0)) return;
  seen_ = objects.time_end;
  notePenetration(objects, period);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    outside_[b] = isOutside(objects.bodies[blocks_[b]].X_WB_end.p) ? outside_[b] + period : 0;
    longest_outside_ = std::max(longest_outside_, outside_[b]);
  }
}

void BlockWatch::notePenetration(const ObjectState& objects, double period) noexcept {
  const BodyPenetration& in = objects.penetration;
  known_ = known_ && in.points != BodyPenetration::kUnknown;
  if (!known_) return;
  depths_ += in.points * in.mean;
  points_ += static_cast<std::uint64_t>(in.points);
  window_ += period;
  deepest_ += period * in.worst;
  if (window_ < kPenetrationOver) return;
  worst_ = std::max(worst_, deepest_ / window_);
  window_ = deepest_ = 0;
}

// The workspace box begins at the ground, so a block below the ground is outside too.
bool BlockWatch::isOutside(const Vec3& p_WB) const noexcept {
  const auto& workspace = world_->scene.assembly->workspace;
  if (!p_WB.allFinite()) return true;
  return workspace && !((p_WB - workspace->centre).array().abs() <= workspace->size.array() / 2).all();
}

double BlockWatch::meanPenetration() const noexcept {
  if (!known_) return std::numeric_limits<double>::quiet_NaN();
  return points_ > 0 ? depths_ / static_cast<double>(points_) : 0;
}

int BlockWatch::lost() const noexcept {
  return static_cast<int>(std::ranges::count_if(outside_, [](double since) { return since > 0; }));
}

RebuildObserver::RebuildObserver(std::shared_ptr<const World> world)
    : Module("witness", RateGroup::kHaptic), blocks_(world), taken_(world->scene.bodies.size(), kNotTaken) {}

void RebuildObserver::step(const Tick&) noexcept {
  if (!objects_.hasValue() || !assembly_.hasValue()) return;
  blocks_.see(objects_.value());
  for (std::size_t f = 0; f < contact_->fingers.size(); ++f) {
    const FingerContact& finger = contact_->fingers[f];
    if (finger.mode == ContactMode::kNone) continue;
    depth_ += finger.depth;
    ++touches_;
    double& height = taken_[static_cast<std::size_t>(finger.body)];
    if (height == kNotTaken) height = objects_->bodies[static_cast<std::size_t>(finger.body)].X_WB_end.p.z();
  }
  for (std::size_t i = 0; i < taken_.size(); ++i) noteFall(i);
}

// A lifted block that moves down fast was dropped.
void RebuildObserver::noteFall(std::size_t i) noexcept {
  if (taken_[i] == kNotTaken) return;
  const BodyMotion& body = objects_->bodies[i];
  if (body.v_WB.z() > -kFalls || body.X_WB_end.p.z() < taken_[i] + kLifted) return;
  ++drops_;
  taken_[i] = kNotTaken;
}

Rebuilt measure(const Assembly& assembly, const RebuildObserver& rebuild_observer) {
  Rebuilt rebuilt;
  rebuilt.pieces = static_cast<int>(assembly.goals.size());
  rebuilt.placed = rebuild_observer.assembly().filled;
  for (std::size_t g = 0; g < rebuild_observer.assembly().goals.size(); ++g) {  // empty before the first step
    const GoalState& state = rebuild_observer.assembly().goals[g];
    if (state.status != GoalState::Status::kFilled) continue;
    const Pose& X_WB = rebuild_observer.objects().bodies[static_cast<std::size_t>(state.body)].X_WB_end;
    const PoseDifference way =
        poseDifference(nearestTurn(assembly.goals[g].X_WB, assembly.goals[g].fold, X_WB.q), X_WB);
    rebuilt.worst_position_error = std::max(rebuilt.worst_position_error, way.distance);
    rebuilt.worst_angle_error = std::max(rebuilt.worst_angle_error, way.angle);
  }
  rebuilt.drops = rebuild_observer.drops();
  rebuilt.mean_fingertip_depth = rebuild_observer.meanFingertipDepth();
  rebuilt.mean_penetration = rebuild_observer.blocks().meanPenetration();
  rebuilt.worst_penetration = rebuild_observer.blocks().worstPenetration();
  rebuilt.lost = rebuild_observer.blocks().lost();
  rebuilt.longest_outside = rebuild_observer.blocks().longestOutside();
  rebuilt.faults = rebuild_observer.objects().faults;
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
                                       {"mean_penetration_m", r.mean_penetration},
                                       {"worst_penetration_m", r.worst_penetration},
                                       {"lost", r.lost},
                                       {"longest_outside_s", r.longest_outside},
                                       {"simulated_s", r.simulated_seconds},
                                       {"wall_s", r.wall_seconds},
                                       {"faults", r.faults}};
  return summary.dump(2) + "\n";
}

}  // namespace presa::temple
