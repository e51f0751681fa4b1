#include "framework/scene/joints/joint_words.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "framework/scene/joints/joint_motion.h"

namespace presa {
namespace {

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value == 0 ? 0.0 : value);
  return text.data();
}

std::string direction(const Vec3& d) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += (i > 0 ? " " : "") + number(std::abs(d[i]) < 1e-12 ? 0 : d[i]);
  return text;
}

std::string rangeText(const Joint& joint, std::size_t i) {
  const JointAxis& axis = joint.axes[i];
  if (axis.lower && axis.upper)
    return ", from " + positionText(joint, i, *axis.lower) + " to " + positionText(joint, i, *axis.upper);
  if (axis.lower) return ", from " + positionText(joint, i, *axis.lower) + " on";
  if (axis.upper) return ", up to " + positionText(joint, i, *axis.upper);
  return "";
}

// Spring, damping, friction and motor of an axis, as far as it has them.
std::string forcesText(const Joint& joint, std::size_t i) {
  const JointAxis& axis = joint.axes[i];
  const bool turns = isAngle(joint, i);
  std::string text;
  if (axis.stiffness > 0)
    text += ", spring " + number(axis.stiffness) + (turns ? " N m/rad" : " N/m") + " at rest at " +
            positionText(joint, i, axis.rest);
  if (axis.damping > 0) text += ", damping " + number(axis.damping) + (turns ? " N m s/rad" : " N s/m");
  if (axis.friction > 0) text += ", friction " + number(axis.friction) + (turns ? " N m" : " N");
  if (axis.max_force > 0)
    text += ", motor to " + number(axis.speed) + (turns ? " rad/s" : " m/s") + " with up to " + number(axis.max_force) +
            (turns ? " N m" : " N");
  return text;
}

std::string wordOf(JointType type) {
  if (type == JointType::kHinge || type == JointType::kSlider) return nameOf(type);
  return type == JointType::kPrismaticRotary ? "prismatic-rotary joint" : std::string(nameOf(type)) + " joint";
}

}  // namespace

std::string positionText(const Joint& joint, std::size_t i, double position) {
  const bool angle = isAngle(joint, i);
  const double value = angle ? position * 180 / std::numbers::pi : 1e3 * position;
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), angle ? "%.1f\u00b0" : "%.1f mm", std::abs(value) < 0.05 ? 0.0 : value);
  return text.data();
}

std::string describeJoint(const Scene& scene, const Joint& joint) {
  std::string text = wordOf(joint.type) + " of " + scene.bodies[joint.body].name + " to " +
                     (joint.to == Joint::kWorld ? "the world" : scene.bodies[joint.to].name);
  for (std::size_t i = 0; i < joint.axes.size(); ++i) {
    if (i > 0) text += "; and";
    if (joint.type != JointType::kBall)
      text += (joint.axes[i].turns ? " about " : " along ") + direction(joint.axes[i].dhat_B);
    text += rangeText(joint, i) + forcesText(joint, i);
  }
  if (joint.collide) text += "; the two collide with each other";
  return text;
}

}  // namespace presa
