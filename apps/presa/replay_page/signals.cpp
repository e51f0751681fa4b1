#include "apps/presa/replay_page/signals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/common/joint_words.h"
#include "apps/presa/replay_page/packed.h"

namespace presa::replay_page {
namespace {

using nlohmann::json;
using Values = std::vector<double>;

constexpr std::size_t kFewestBins = 2000, kMaxHeights = 4, kMaxJoints = 6;
constexpr double kBytesOfBin = 4.0 * 4 / 3;  // min and max, as base64

struct Curve {
  std::string name, style;  ///< style: line, limit
  std::size_t color;
  Values values;
};
struct Panel {
  std::string title, unit, note;
  std::vector<Curve> curves;
};

/// The columns NAME_x, NAME_y, NAME_z of a table.
struct Vectors {
  const Values &x, &y, &z;
  Vectors(const RecordedTable& table, const std::string& name)
      : x(table.values(name + "_x")), y(table.values(name + "_y")), z(table.values(name + "_z")) {}
  Vec3 at(std::size_t row) const { return {x[row], y[row], z[row]}; }
  Values lengths() const {
    Values all(x.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = at(i).norm();
    return all;
  }
};

/// Static friction times normal force; NaN where nothing is touched.
Values limitOf(const RecordedTable& finger, const World& world, const std::vector<std::uint8_t>& changed) {
  const Values &normal = finger.values("normal_force"), &body = finger.values("body");
  Values limit(normal.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < normal.size(); ++i) {
    if (!(body[i] >= 0 && body[i] < static_cast<double>(world.scene.bodies.size()))) continue;
    const Material& material = world.scene.materialOf(world.scene.bodies[static_cast<std::size_t>(body[i])]);
    const bool other = i < changed.size() && changed[i] != 0 && material.changed_friction;
    limit[i] = normal[i] * (other ? material.changed_friction->mu_static : material.friction_static);
  }
  return limit;
}

/// Of the body that is gripped the hardest.
Values gripOf(const RecordedSamples& samples) {
  struct Finger {
    const Values &mode, &body;
    Vectors command, normal;
  };
  std::vector<Finger> fingers;
  for (const RecordedTable& t : samples.fingers)
    fingers.push_back({t.values("mode"), t.values("body"), {t, "f_command_W"}, {t, "nhat_W"}});
  Values grip(samples.time.size(), 0);
  for (std::size_t i = 0; i < grip.size(); ++i) {
    for (const Finger& first : fingers) {
      double pressed = 0;
      Vec3 net = Vec3::Zero();
      for (const Finger& finger : fingers) {
        if (finger.mode[i] <= 0 || finger.body[i] != first.body[i]) continue;
        const Vec3 normal = finger.normal.at(i);
        const double force = std::max(0.0, finger.command.at(i).dot(normal));
        pressed += force;
        net += force * normal;
      }
      grip[i] = std::max(grip[i], (pressed - net.norm()) / 2);
    }
  }
  return grip;
}

/// The bodies whose height is worth a curve: those that fingers touched, else those that rise or fall most.
std::vector<const RecordedTable*> risingBodies(const RecordedSamples& samples, const World* world) {
  std::set<std::string> touched;
  for (const RecordedTable& finger : samples.fingers) {
    const Values &mode = finger.values("mode"), &body = finger.values("body");
    for (std::size_t i = 0; world != nullptr && i < mode.size(); ++i) {
      const bool touches = mode[i] > 0 && body[i] >= 0 && body[i] < static_cast<double>(world->scene.bodies.size());
      if (touches) touched.insert(world->scene.bodies[static_cast<std::size_t>(body[i])].name);
    }
  }
  std::vector<std::pair<double, const RecordedTable*>> found;
  for (const RecordedTable& body : samples.bodies) {
    const auto [low, high] = std::ranges::minmax_element(body.values("p_WB_z"));
    // what was touched comes before all else
    if (std::isfinite(*high - *low)) found.emplace_back(*high - *low + (touched.contains(body.name) ? 1e9 : 0), &body);
  }
  std::ranges::stable_sort(found, std::greater{}, [](const auto& one) { return one.first; });
  const bool any_touched = !found.empty() && found.front().first >= 1e9;
  std::vector<const RecordedTable*> bodies;
  for (const auto& [rise, body] : found) {
    if (bodies.size() < kMaxHeights && (!any_touched || rise >= 1e9)) bodies.push_back(body);
  }
  return bodies;
}

Values millimetres(Values values) {
  for (double& value : values) value *= 1000;
  return values;
}

/// Positions of the joints, a panel for each unit.
std::vector<Panel> jointPanels(const RecordedSamples& samples, const World* world) {
  std::vector<Panel> panels;
  if (world == nullptr || world->scene.joints.empty()) return panels;
  const JointLog log = jointLogOf(samples, world->scene);
  for (const bool angles : {true, false}) {
    Panel panel{angles ? "Joint angle" : "Joint displacement", angles ? "deg" : "mm", "", {}};
    for (const JointLog::Position* position : mostMoved(log, angles, kMaxJoints)) {
      const Joint& joint = log.jointOf(*position);
      Values values = position->samples;
      for (double& value : values) value *= unitOf(joint, position->axis).factor;
      panel.curves.push_back({positionName(joint, position->axis), "line", panel.curves.size(), std::move(values)});
    }
    if (!panel.curves.empty()) panels.push_back(std::move(panel));
  }
  return panels;
}

std::vector<Panel> panelsOf(const RecordedSamples& samples, const World* world,
                            const std::vector<std::uint8_t>& changed) {
  Panel normal{"Normal force", "N", "rendered, before the output stage", {}},
      tangential{"Tangential force", "N", "", {}};
  Panel grip{"Grip", "N", "commanded", {}}, height{"Height", "mm", "", {}};
  for (std::size_t f = 0; f < samples.fingers.size(); ++f) {
    const RecordedTable& finger = samples.fingers[f];
    normal.curves.push_back({finger.name, "line", f, finger.values("normal_force")});
    tangential.curves.push_back({finger.name, "line", f, Vectors(finger, "tangential_force_W").lengths()});
    if (world != nullptr)
      tangential.curves.push_back({finger.name + ": limit", "limit", f, limitOf(finger, *world, changed)});
  }
  if (world != nullptr) tangential.note = "dashed: friction limit, \u03bc\u209b \u00d7 normal force";
  if (samples.fingers.size() > 1) grip.curves.push_back({"grip", "line", 6, gripOf(samples)});
  std::size_t color = 7;
  for (const RecordedTable* body : risingBodies(samples, world))
    height.curves.push_back({body->name, "line", color++, millimetres(body->values("p_WB_z"))});
  std::vector<Panel> panels;
  for (Panel* panel : {&normal, &tangential, &grip, &height})
    if (!panel->curves.empty()) panels.push_back(std::move(*panel));
  for (Panel& panel : jointPanels(samples, world)) panels.push_back(std::move(panel));
  return panels;
}

}  // namespace

json signalsOf(const RecordedSamples& samples, const World* world, const std::vector<std::uint8_t>& surfaces_changed) {
  const std::vector<Panel> panels = panelsOf(samples, world, surfaces_changed);
  std::size_t curves = samples.fingers.size();  // their states
  for (const Panel& panel : panels) curves += panel.curves.size();
  const double budget = kMaxSignalBytes / (kBytesOfBin * static_cast<double>(std::max<std::size_t>(curves, 1)));
  const Bins bins =
      binsOf(samples.time, samples.haptic_period, std::max(kFewestBins, static_cast<std::size_t>(budget)));

  json written = json::array(), states = json::array();
  for (const Panel& panel : panels) {
    json all = json::array();
    for (const Curve& curve : panel.curves) {
      json one = envelope(samples.time, curve.values, bins);
      one.update({{"name", curve.name}, {"style", curve.style}, {"color", curve.color}});
      all.push_back(std::move(one));
    }
    written.push_back({{"title", panel.title}, {"unit", panel.unit}, {"note", panel.note}, {"curves", all}});
  }
  for (const RecordedTable& finger : samples.fingers)
    states.push_back({{"name", finger.name}, {"seen", statesIn(samples.time, finger.values("mode"), bins)}});
  return {{"begin", bins.begin},           {"width", bins.width}, {"count", bins.count},
          {"every_tick", bins.every_tick}, {"panels", written},   {"states", states}};
}

json phasesOf(const RecordedSamples& samples, const std::vector<std::string>& names) {
  for (const RecordedTable& finger : samples.fingers) {
    const Values& phase = finger.values("phase");
    if (std::ranges::all_of(phase, [](double p) { return p < 0; })) continue;
    const std::vector<std::string>& known = finger.phases.empty() ? names : finger.phases;
    json phases = json::array();
    for (std::size_t i = 0; i < phase.size(); ++i) {
      const double end = samples.time[i] + samples.haptic_period;
      if (i > 0 && phase[i] == phase[i - 1]) {
        if (phase[i] >= 0) phases.back()["end"] = end;
      } else if (phase[i] >= 0) {
        const auto index = static_cast<std::size_t>(phase[i]);
        const std::string name = index < known.size() ? known[index] : "phase " + std::to_string(index + 1);
        phases.push_back({{"name", name}, {"begin", samples.time[i]}, {"end", end}});
      }
    }
    return phases;
  }
  return json::array();
}

}  // namespace presa::replay_page
