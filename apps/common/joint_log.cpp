#include "apps/common/joint_log.h"

#include <algorithm>
#include <array>
#include <map>

namespace presa {
namespace {

struct PoseColumns {
  std::array<const std::vector<double>*, 7> columns;
  explicit PoseColumns(const RecordedTable& t)
      : columns{&t.values("p_WB_x"), &t.values("p_WB_y"), &t.values("p_WB_z"), &t.values("q_WB_w"),
                &t.values("q_WB_x"), &t.values("q_WB_y"), &t.values("q_WB_z")} {}
  Pose at(std::size_t row) const {
    const auto value = [&](std::size_t i) { return (*columns[i])[row]; };
    return {{value(0), value(1), value(2)}, Quat(value(3), value(4), value(5), value(6)).normalized()};
  }
};

}  // namespace

JointLog::JointLog(const Scene& scene, std::size_t capacity, std::size_t stride)
    : scene_(scene), motion_(scene), capacity_(capacity), stride_(std::max<std::size_t>(1, stride)) {
  times_.reserve(capacity);
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    for (std::size_t i = 0; i < positionCount(scene.joints[j]); ++i)
      positions_.emplace_back(Position{j, i, {}, {}}).samples.reserve(capacity);
}

void JointLog::keep(double time, double span) noexcept {
  const bool first = count_ == 0, sampled = count_++ % stride_ == 0 && times_.size() < capacity_;
  if (sampled) times_.push_back(time);
  for (Position& position : positions_) {
    const double now = motion_.position(position.joint, position.axis);
    JointTravel& travel = position.travel;
    if (first) travel.start = travel.min = travel.max = now;
    travel.min = std::min(travel.min, now);
    travel.max = std::max(travel.max, now);
    travel.end = now;
    if (sampled) position.samples.push_back(now);
    const Joint& joint = jointOf(position);
    if (position.axis >= joint.axes.size()) continue;
    const JointAxis& axis = joint.axes[position.axis];
    const double near = isAngle(joint, position.axis) ? kAtStopAngle : kAtStop;
    if (axis.lower && now <= *axis.lower + near) travel.at_lower += span;
    if (axis.upper && now >= *axis.upper - near) travel.at_upper += span;
  }
}

JointLog jointLogOf(const RecordedSamples& samples, const Scene& scene) {
  std::map<std::string, PoseColumns> tables;
  for (const RecordedTable& table : samples.bodies) tables.try_emplace(table.name, table);
  std::vector<const PoseColumns*> moved;
  for (const Body& body : scene.bodies) {
    const auto table = tables.find(body.name);
    moved.push_back(table != tables.end() ? &table->second : nullptr);
  }
  JointLog log(scene, samples.time.size(), 1);
  for (std::size_t row = 0; row < samples.time.size(); ++row) {
    const double span = row > 0 ? samples.time[row] - samples.time[row - 1] : 0;
    log.add(samples.time[row], span,
            [&](std::size_t body) { return moved[body] != nullptr ? moved[body]->at(row) : scene.bodies[body].X_WB; });
  }
  return log;
}

}  // namespace presa
