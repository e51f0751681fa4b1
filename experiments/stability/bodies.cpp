#include "experiments/stability/bodies.h"

#include <algorithm>
#include <stdexcept>

#include "experiments/study/box_penetration.h"

namespace presa::stability {
StudyRun::Observer atEachStep(std::function<void(const ObjectState&)> use) {
  return [use = std::move(use), last = std::uint64_t{0}](const HapticSample& sample) mutable {
    if (sample.objects == nullptr || sample.objects_version == last) return;
    last = sample.objects_version;
    use(*sample.objects);
  };
}

std::size_t bodyNamed(const World& world, const std::string& name) {
  const std::vector<Body>& bodies = world.scene.bodies;
  const auto found = std::find_if(bodies.begin(), bodies.end(), [&](const Body& body) { return body.name == name; });
  if (found == bodies.end()) throw std::logic_error("no body " + name + " in " + world.scene.file);
  return static_cast<std::size_t>(found - bodies.begin());
}

BoxStack::BoxStack(const World& world, const std::vector<std::string>& bodies) {
  for (const std::string& name : bodies) {
    const std::size_t i = bodyNamed(world, name);
    const Body& body = world.scene.bodies[i];
    const Pose& X_WLowest = world.scene.bodies[members_.empty() ? i : members_.front().body].X_WB;
    members_.push_back({i, std::get<Box>(body.physics.value().shape).size, X_WLowest.inverseTimes(body.X_WB.p)});
  }
}

double BoxStack::penetration(const ObjectState& state) const {
  double deepest = 0;
  for (std::size_t i = 1; i < members_.size(); ++i) {
    const Member &low = members_[i - 1], &high = members_[i];
    deepest = std::max(deepest, boxPenetration(low.size, state.bodies[low.body].X_WB_end, high.size,
                                               state.bodies[high.body].X_WB_end));
  }
  return deepest;
}

double BoxStack::shift(const ObjectState& state) const {
  double farthest = 0;
  for (const Member& member : members_) {
    const Pose& X_WLowest = state.bodies[members_.front().body].X_WB_end;
    const Vec3 p_Lowest = X_WLowest.inverseTimes(state.bodies[member.body].X_WB_end.p);
    farthest = std::max(farthest, (p_Lowest - member.p_Lowest).norm());
  }
  return farthest;
}

std::vector<Finding> runAndJudge(StudyRun& run, const BoxStack& stack, const std::string& top,
                                 const std::string& metric, const std::string& oracle) {
  const std::size_t highest = bodyNamed(run.world(), top);
  double deepest = 0, shift = 0;
  Curve height{top, {}, {}};
  run.observe(atEachStep([&](const ObjectState& state) {
    deepest = std::max(deepest, stack.penetration(state));
    shift = std::max(shift, stack.shift(state));
    height.x.push_back(state.time_end);
    height.y.push_back(1000 * state.bodies[highest].X_WB_end.p.z());
  }));
  run.run();

  Finding displacement = finding(metric, 1000 * shift, "mm", 1, oracle);
  displacement.plot_x = "time [s]";
  displacement.plot_y = "height of the highest box [mm]";
  displacement.curves.push_back(decimated(std::move(height)));
  return {finding("penetration", 1000 * deepest, "mm", 0.5, "rigid boxes do not overlap"), displacement};
}

}  // namespace presa::stability
