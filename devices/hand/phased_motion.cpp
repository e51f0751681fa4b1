#include <algorithm>
#include <bit>
#include <cmath>

#include "devices/hand/motion.h"
#include "devices/hand/motion_schema.h"
#include "framework/scene/xml/xml.h"

namespace presa {

int Motion::phaseAt(double time) const noexcept {
  const auto after = std::upper_bound(phase_times.begin(), phase_times.end(), time);
  const auto index = static_cast<int>(after - phase_times.begin()) - 1;
  return std::clamp(index, 0, static_cast<int>(phase_names.size()) - 1);
}

std::uint32_t Motion::buttonsIn(int phase) const noexcept {
  const auto index = static_cast<std::size_t>(phase);  // -1 is beyond the end
  return index < phase_buttons.size() ? phase_buttons[index] : 0;
}

int Motion::buttons() const noexcept {
  int count = 0;
  for (const std::uint32_t held : phase_buttons) count = std::max(count, static_cast<int>(std::bit_width(held)));
  return count;
}

namespace {

class PhasedMotion final : public Motion {
 public:
  /// State of the hand at the end of a phase.
  struct Pose {
    Vec3 point = Vec3::Zero();  ///< centre of the grasp [m]
    double open = 0;            ///< distance of each fingertip from the surface [m]
    double grip = 0;            ///< [N]
  };

  PhasedMotion(const xml::Element& root, const MotionContext& context) : context_(context) {
    if (const auto finger = root.children("finger"); !finger.empty()) {
      impedance_.mass = finger[0].number("mass", impedance_.mass);
      impedance_.stiffness = finger[0].number("stiffness", impedance_.stiffness);
      impedance_.damping = finger[0].number("damping", 0);
    }
    const xml::Element grasp = root.children("grasp").at(0);
    axis_ = vec3(grasp, "axis").normalized();
    width_ = grasp.number("width", 0);
    Pose pose{vec3(grasp, "point"), grasp.number("open", 0.03), 0};
    knots_.push_back(pose);
    double time = 0;
    for (const xml::Element& phase : root.children("phase")) {
      if (phase.hasAttribute("move")) pose.point += vec3(phase, "move");
      pose.grip = phase.number("grip", pose.grip);
      // a gripping hand is closed; an opening releases the grip
      pose.open = phase.hasAttribute("open") ? phase.number("open", 0) : pose.grip > 0 ? 0.0 : pose.open;
      if (phase.hasAttribute("open") && pose.open > 0) pose.grip = 0;
      knots_.push_back(pose);
      phase_names.push_back(phase.attribute("name"));
      phase_intents.push_back(phaseIntentOf(phase.attribute("intent")).value_or(PhaseIntent::kNone));
      phase_buttons.push_back(phase.hasAttribute("press") ? 1U << static_cast<unsigned>(phase.number("press", 0)) : 0U);
      phase_times.push_back(time);
      time += phase.number("duration", 0);
    }
    phase_times.push_back(time);
  }

  FingerImpedance impedance() const override { return impedance_; }

  MotionTarget at(double time) const noexcept override {
    MotionTarget target;
    target.phase = phaseAt(time);
    const auto i = static_cast<std::size_t>(target.phase);
    const double duration = phase_times[i + 1] - phase_times[i];
    const double s = (time - phase_times[i]) / duration;
    const double part = minimumJerk(s), slope = minimumJerkSlope(s) / duration;
    const Pose &from = knots_[i], &to = knots_[i + 1];
    const Vec3 outward = context_.side * axis_;
    target.p_WT = from.point + part * (to.point - from.point) +
                  (width_ / 2 + context_.fingertip_radius + from.open + part * (to.open - from.open)) * outward;
    target.v_WT = slope * (to.point - from.point) + slope * (to.open - from.open) * outward;
    // linear force ramps: slip is measured against a constant rate of loosening
    target.grip = from.grip + std::clamp(s, 0.0, 1.0) * (to.grip - from.grip);
    if (from.grip > 0 || to.grip > 0) target.inward_W = -outward;
    return target;
  }

 private:
  static Vec3 vec3(const xml::Element& element, const std::string& attribute) {
    const std::vector<double> v = element.numbers(attribute);
    return v.size() == 3 ? Vec3(v[0], v[1], v[2]) : Vec3::Zero();
  }

  MotionContext context_;
  FingerImpedance impedance_;
  Vec3 axis_ = Vec3::UnitX();
  double width_ = 0;
  std::vector<Pose> knots_;  ///< one more than phases
};

}  // namespace

std::unique_ptr<Motion> readPhasedMotion(const std::string& file, const MotionContext& context,
                                         Diagnostics& diagnostics) {
  const auto document = xml::Document::load(file, diagnostics);
  if (!document || !document->validate(schemas::motion, diagnostics)) return nullptr;
  const xml::Element root = document->root();
  const xml::Element grasp = root.children("grasp").at(0);
  if (grasp.numbers("axis") == std::vector<double>{0, 0, 0}) {
    diagnostics.error(411, grasp.where("axis"), "the grasp axis has no direction: found '0 0 0'",
                      "give the direction from thumb to index, e.g. axis=\"1 0 0\"");
    return nullptr;
  }
  return std::make_unique<PhasedMotion>(root, context);
}

}  // namespace presa
