#include <algorithm>
#include <map>
#include <numbers>

#include "framework/scene/joints/joint_parts.h"

namespace presa {
namespace {

using xml::Element;

constexpr double kDegree = std::numbers::pi / 180;

JointType typeOf(const Element& joint) {
  const std::string word = joint.attribute("type");
  for (const JointType type :
       {JointType::kFixed, JointType::kSlider, JointType::kBall, JointType::kUniversal, JointType::kPrismaticRotary}) {
    if (word == nameOf(type)) return type;
  }
  return JointType::kHinge;
}

/// `name` in metres, or `name`_deg in radians.
std::optional<double> placeOf(const Element& axis, const std::string& name, bool turns) {
  const std::string attribute = turns ? name + "_deg" : name;
  if (!axis.hasAttribute(attribute)) return std::nullopt;
  return (turns ? kDegree : 1) * axis.number(attribute, 0);
}

JointAxis readAxis(const Element& element, bool turns) {
  JointAxis axis;
  axis.turns = turns;
  const std::vector<double> dir = element.numbers("dir");
  if (dir.size() == 3) axis.dhat_B = Vec3(dir[0], dir[1], dir[2]).normalized();
  axis.lower = placeOf(element, "lower", turns);
  axis.upper = placeOf(element, "upper", turns);
  axis.rest = placeOf(element, "rest", turns).value_or(0);
  axis.stiffness = element.number("stiffness", 0);
  axis.damping = element.number("damping", 0);
  axis.friction = element.number("friction", 0);
  axis.speed = element.number("speed", 0);
  axis.max_force = element.number("max_force", 0);
  return axis;
}

}  // namespace

bool axisTurns(JointType type, std::size_t i) {
  return type != JointType::kSlider && !(type == JointType::kPrismaticRotary && i == 0);
}

std::vector<Joint> readJoints(const Element& root, const std::vector<Body>& bodies) {
  std::map<std::string, std::size_t> indices;
  for (std::size_t i = 0; i < bodies.size(); ++i) indices.try_emplace(bodies[i].name, i);
  std::vector<Joint> joints;
  for (const Element& element : root.children("joint")) {
    Joint& joint = joints.emplace_back();
    joint.name = element.attribute("name");
    joint.type = typeOf(element);
    joint.body = indices.at(element.attribute("body"));
    if (element.hasAttribute("to")) joint.to = indices.at(element.attribute("to"));
    const std::vector<double> pos = element.numbers("pos");
    if (pos.size() == 3) joint.p_BJ = {pos[0], pos[1], pos[2]};
    for (const Element& axis : element.children("axis"))
      joint.axes.push_back(readAxis(axis, axisTurns(joint.type, joint.axes.size())));
    joint.collide = element.boolean("collide", false);
    joint.where = element.where();
  }
  return joints;
}

}  // namespace presa
