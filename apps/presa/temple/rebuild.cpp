#include "apps/presa/temple/rebuild.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "framework/plan/session.h"
#include "framework/scene/goal_pose.h"
#include "framework/schedule/clock.h"
#include "framework/schedule/executor.h"
#include "framework/state/assembly_state.h"
#include "framework/state/contact_exchange.h"

namespace presa::temple {
namespace {

constexpr double kLifted = 0.02;  // above where it was taken [m]
constexpr double kFalls = 0.5;    // [m/s]
constexpr double kLetGo = 2;      // for the fingers, once all stands [s]

/// Sees the run as it goes; read when it is over.
class Witness final : public Module {
 public:
  explicit Witness(std::size_t bodies) : Module("witness", RateGroup::kHaptic), taken_(bodies, kNotTaken) {}

  void step(const Tick&) noexcept override {
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

  const AssemblyState& assembly() const noexcept { return assembly_.value(); }
  const ObjectState& objects() const noexcept { return objects_.value(); }
  int drops() const noexcept { return drops_; }
  double meanFingertipDepth() const noexcept { return touches_ > 0 ? depth_ / static_cast<double>(touches_) : 0; }

 private:
  static constexpr double kNotTaken = -1e9;

  // Lifted and fast, downwards: out of the fingers.
  void noteFall(std::size_t i) noexcept {
    if (taken_[i] == kNotTaken) return;
    const BodyMotion& body = objects_->bodies[i];
    if (body.v_WB.z() > -kFalls || body.X_WB_end.p.z() < taken_[i] + kLifted) return;
    ++drops_;
    taken_[i] = kNotTaken;
  }

  In<ObjectState> objects_{*this, "object_state"};
  In<AssemblyState> assembly_{*this, "assembly_state"};
  In<ContactExchange> contact_{*this, "contact_exchange"};
  std::vector<double> taken_;  // by body: height at which a finger first touched it; kNotTaken
  int drops_ = 0;
  double depth_ = 0;
  std::uint64_t touches_ = 0;
};

void measure(const Assembly& assembly, const Witness& witness, Rebuilt& rebuilt) {
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
}

}  // namespace

Rebuilt rebuild(const Loaded& loaded, double limit, const RebuildProgress& progress) {
  const Assembly& assembly = *loaded.world->scene.assembly;
  Rebuilt rebuilt;
  rebuilt.pieces = static_cast<int>(assembly.goals.size());
  auto made = std::make_unique<Witness>(loaded.world->scene.bodies.size());
  const Witness& witness = *made;
  Session::Options options;
  options.more.push_back(std::move(made));
  RunControl control;
  Session session(loaded.world, loaded.plan, control, std::move(options));
  const auto executor = makeExecutor(false, session.graph(), RateTable(loaded.world->scene.rates), control);
  double done_at = limit;
  executor->onPoll([&] {
    const int placed = witness.assembly().filled;
    if (placed == rebuilt.pieces) done_at = std::min<double>(done_at, control.time);
    if (!progress(placed, rebuilt.pieces) || control.time > done_at + kLetGo) control.stop_requested = true;
  });
  const std::int64_t begin = monotonicNs();
  executor->run(limit);
  rebuilt.wall_seconds = static_cast<double>(monotonicNs() - begin) * 1e-9;
  rebuilt.simulated_seconds = control.time;
  measure(assembly, witness, rebuilt);
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
