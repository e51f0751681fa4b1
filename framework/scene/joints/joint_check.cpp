#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "framework/scene/joints/joint_parts.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

using xml::Element;

enum JointCode {
  kJointName = 203,
  kJointBodies = 229,
  kJointAxes = 230,
  kJointDirection = 231,
  kJointLimits = 232,
  kEngineJoint = 235
};

constexpr double kSquare = 1e-3;   // cosine up to which two axes count as square
constexpr double kHalfTurn = 180;  // a turning axis has no limits beyond [deg]

struct AxisCount {
  std::size_t min = 0, max = 0;
};
AxisCount axisCountOf(const std::string& type) {
  if (type == "fixed") return {0, 0};
  if (type == "ball") return {0, 1};
  if (type == "universal" || type == "prismatic_rotary") return {2, 2};
  return {1, 1};
}

std::string numbered(std::size_t count) { return count == 1 ? "1 <axis>" : std::to_string(count) + " <axis>"; }

class JointCheck {
 public:
  JointCheck(const Element& root, Diagnostics& diagnostics) : diagnostics_(diagnostics) {
    for (const Element& body : root.children("body")) {
      names_.push_back(body.attribute("name"));
      fixed_[names_.back()] = body.boolean("fixed", false);
    }
  }

  void check(const Element& joint) {
    const std::string name = joint.attribute("name");
    if (!name.empty() && !joint.flawed("name") && !known_.insert(name).second)
      diagnostics_.error(kJointName, joint.where("name"), "a second joint is named " + quote(name));
    checkBodies(joint);
    if (!joint.hasAttribute("type") || joint.flawed("type")) return;
    const std::string type = joint.attribute("type");
    const std::vector<Element> axes = joint.children("axis");
    const AxisCount count = axisCountOf(type);
    if (axes.size() < count.min || axes.size() > count.max) {
      diagnostics_.error(kJointAxes, axes.size() > count.max ? axes[count.max].where() : joint.where(),
                         joint.label() + " is a " + type + " and has " + numbered(axes.size()),
                         count.min == count.max ? "a " + type + " has " + numbered(count.min)
                                                : "a ball has no <axis>, or one with friction and damping");
      return;
    }
    for (std::size_t i = 0; i < axes.size(); ++i) checkAxis(axes[i], type, i);
    if (axes.size() == 2) checkPair(axes, type);
  }

 private:
  bool isKnown(const Element& joint, const std::string& attribute) {
    const std::string body = joint.attribute(attribute);
    if (fixed_.contains(body)) return true;
    diagnostics_.error(
        kJointBodies, joint.where(attribute),
        joint.label() + " names the body " + quote(body) + ", which does not exist" + didYouMean(body, names_),
        attribute == "to" ? "a body of the scene; without 'to' the joint holds to the world" : "a body of the scene");
    return false;
  }

  void checkBodies(const Element& joint) {
    if (!joint.hasAttribute("body") || joint.flawed("body") || !isKnown(joint, "body")) return;
    const std::string body = joint.attribute("body");
    if (!joint.hasAttribute("to")) {
      if (fixed_[body])
        diagnostics_.error(kJointBodies, joint.where("body"),
                           joint.label() + " joins the fixed body " + quote(body) + " to the world: nothing can move",
                           "a free body in 'body' or in 'to'");
      return;
    }
    if (joint.flawed("to") || !isKnown(joint, "to")) return;
    const std::string to = joint.attribute("to");
    if (to == body) {
      diagnostics_.error(kJointBodies, joint.where("to"), joint.label() + " joins " + quote(body) + " to itself",
                         "two different bodies; without 'to' the joint holds to the world");
    } else if (fixed_[body] && fixed_[to]) {
      diagnostics_.error(
          kJointBodies, joint.where("to"),
          joint.label() + " joins two fixed bodies, " + quote(body) + " and " + quote(to) + ": nothing can move",
          "a free body in 'body' or in 'to'");
    }
  }

  void checkAxis(const Element& axis, const std::string& type, std::size_t i) {
    const bool turns = type != "slider" && !(type == "prismatic_rotary" && i == 0);
    if (type == "ball") {
      for (const std::string& name : axis.attributeNames()) {
        if (name == "friction" || name == "damping") continue;
        diagnostics_.error(kJointAxes, axis.where(name), quote(name) + " has no meaning for the axis of a ball",
                           "friction, damping");
      }
      return;
    }
    for (const std::string name : {"lower", "upper", "rest"}) {
      const std::string wrong = turns ? name : name + "_deg", right = turns ? name + "_deg" : name;
      if (!axis.hasAttribute(wrong)) continue;
      diagnostics_.error(
          kJointAxes, axis.where(wrong),
          "the axis " + std::string(turns ? "turns" : "slides") + ", so " + quote(wrong) + " has no meaning",
          quote(right) + (turns ? " [degrees]" : " [m]"));
    }
    if (!axis.hasAttribute("dir")) {
      diagnostics_.error(kJointDirection, axis.where(), axis.label() + " has no 'dir'",
                         "dir: x y z in the frame of 'body', such as \"0 0 1\"");
    } else if (!axis.flawed("dir") && length(axis) < 1e-9) {
      diagnostics_.error(kJointDirection, axis.where("dir"), "'dir' of " + axis.label() + " has length zero",
                         "dir: x y z in the frame of 'body', such as \"0 0 1\"; its length does not matter");
    }
    if (axis.hasAttribute("speed") && !axis.hasAttribute("max_force"))
      diagnostics_.error(kJointAxes, axis.where("speed"), "a motor needs a bound: 'speed' without 'max_force'",
                         std::string("max_force ") + (turns ? "[N m]" : "[N]"));
    checkLimits(axis, turns);
  }

  void checkLimits(const Element& axis, bool turns) {
    const std::string low = turns ? "lower_deg" : "lower", high = turns ? "upper_deg" : "upper";
    if (axis.flawed(low) || axis.flawed(high)) return;
    const double lower = axis.number(low, -1e300), upper = axis.number(high, 1e300);
    const auto refuse = [&](const std::string& attribute, const std::string& what, const std::string& allowed) {
      diagnostics_.error(kJointLimits, axis.where(attribute), what, allowed);
    };
    if (axis.hasAttribute(low) && axis.hasAttribute(high) && lower > upper) {
      refuse(low,
             quote(low) + " is above " + quote(high) + ", found " + axis.attribute(low) + " > " + axis.attribute(high),
             low + " <= 0 <= " + high);
      return;
    }
    const std::string start = "the position is 0 in the start pose";
    if (axis.hasAttribute(low) && lower > 0)
      refuse(low, start + ", below " + quote(low) + ", found " + axis.attribute(low), low + " <= 0");
    if (axis.hasAttribute(high) && upper < 0)
      refuse(high, start + ", above " + quote(high) + ", found " + axis.attribute(high), high + " >= 0");
    if (!turns) return;
    if (axis.hasAttribute(low) && lower < -kHalfTurn)
      refuse(low, quote(low) + " is beyond half a turn, found " + axis.attribute(low), low + " >= -180");
    if (axis.hasAttribute(high) && upper > kHalfTurn)
      refuse(high, quote(high) + " is beyond half a turn, found " + axis.attribute(high), high + " <= 180");
  }

  static double length(const Element& axis) {
    const std::vector<double> d = axis.numbers("dir");
    return d.size() == 3 ? Vec3(d[0], d[1], d[2]).norm() : 0;
  }

  void checkPair(const std::vector<Element>& axes, const std::string& type) {
    if (type != "universal") return;
    for (const Element& axis : axes) {
      if (!axis.hasAttribute("dir") || axis.flawed("dir") || length(axis) < 1e-9) return;
    }
    const std::vector<double> a = axes[0].numbers("dir"), b = axes[1].numbers("dir");
    const double cosine = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / length(axes[0]) / length(axes[1]);
    if (std::abs(cosine) < kSquare) return;
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
    diagnostics_.error(kJointDirection, axes[1].where("dir"),
                       "the axes of a universal joint stand square to each other, found an angle of " +
                           xml::numberText(std::round(10 * angle) / 10) + " degrees",
                       "90 degrees");
  }

  Diagnostics& diagnostics_;
  std::vector<std::string> names_;
  std::map<std::string, bool> fixed_;
  std::set<std::string> known_;
};

/// Whether the scene leaves its joints to the engine's own solver, as a method to compare with.
bool usesEngineSolver(const Element& root) {
  for (const Element& dynamics : root.children("dynamics")) {
    const std::string solver = dynamics.attribute("solver", "auto");
    if (solver == "direct" || solver == "iterative") return true;
    if (solver == "auto" && (dynamics.attribute("friction", "isotropic") != "isotropic" ||
                             dynamics.attribute("rotation", "exact") != "exact"))
      return true;
  }
  return false;
}

void refuseBeyondEngine(const Element& joint, Diagnostics& diagnostics) {
  const std::string type = joint.attribute("type");
  const std::string others =
      "Presa's own solvers: solver=\"auto\", \"newton\" or \"small_steps\" with the usual friction and rotation";
  const std::vector<Element> axes = joint.children("axis");
  if (type == "universal" || type == "prismatic_rotary" || (type == "ball" && !axes.empty()))
    diagnostics.error(kEngineJoint, joint.where(), "the engine's own solver has no such " + type, others);
  for (const Element& axis : axes) {
    for (const char* name : {"stiffness", "damping"}) {
      if (axis.hasAttribute(name) && axis.number(name, 0) > 0)
        diagnostics.error(kEngineJoint, axis.where(name), "the engine's own solver has no springs in joints", others);
    }
    if (axis.number("friction", 0) > 0 && axis.number("max_force", 0) > 0)
      diagnostics.error(kEngineJoint, axis.where("friction"),
                        "the engine's own solver has either friction or a motor in a joint", others);
  }
}

}  // namespace

void checkJoints(const Element& root, Diagnostics& diagnostics) {
  JointCheck check(root, diagnostics);
  const bool of_engine = usesEngineSolver(root);
  for (const Element& joint : root.children("joint")) {
    check.check(joint);
    if (of_engine) refuseBeyondEngine(joint, diagnostics);
  }
}

}  // namespace presa
