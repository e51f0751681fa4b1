#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "framework/core/state/limits.h"
#include "framework/scene/ages.h"
#include "framework/scene/joints/joint_parts.h"
#include "framework/scene/manifest.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/listed.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

using xml::Element;
using xml::numberText;

enum SceneCode {
  kDuplicateName = 203,
  kUnknownMaterial = 204,
  kNoMaterial = 205,
  kNoPhysics = 206,
  kMassOrDensity = 207,
  kFriction = 208,
  kRates = 209,
  kCapacity = 210,
  kTwoOrientations = 211,
  kZeroQuat = 212,
  kNoBodies = 213,
  kMassOfFixed = 220,
  kNoGeometry = 221,
  kWatchdog = 222,
  kSlowDynamics = 223,
  kTwoLaws = 224,
  kOtherRenderer = 225,
  kNotAtHapticRate = 228,
  kInertia = 276
};

// Between two dynamics steps a held body moves on in a straight line. The scripted grasp of 20 and 200 g at 0.5 to 4
// N/mm agrees within 0.5 mm for rates from 40 Hz up; at 25 and 20 Hz a stiff body drifts up to 16 mm in the fingers, at
// 10 Hz one reaches 13 m/s.
constexpr double kHeldBadlyBelow = 40, kHeldNowhereBelow = 20;  // [Hz]

/// Distinct values of one attribute, in document order.
std::vector<std::string> valuesOf(const std::vector<Element>& elements, const std::string& attribute) {
  std::vector<std::string> values;
  std::set<std::string> known;
  for (const Element& element : elements) {
    const std::string value = element.attribute(attribute);
    if (element.hasAttribute(attribute) && known.insert(value).second) values.push_back(value);
  }
  return values;
}

std::string lineText(const SourceLocation& where) {
  return where.line > 0 ? "line " + std::to_string(where.line) : where.file;
}

class SceneCheck {
 public:
  SceneCheck(const Element& root, Diagnostics& diagnostics)
      : root_(root),
        diagnostics_(diagnostics),
        materials_(materialElements(root)),
        material_names_(valuesOf(materials_, "name")),
        known_materials_(material_names_.begin(), material_names_.end()) {}

  void run() {
    const std::vector<Element> bodies = root_.children("body"), devices = deviceElements(root_);
    unique(materials_, "name", "material");
    unique(bodies, "name", "body");
    unique(devices, "role", "device role");
    capacity(bodies, kMaxBodies, "bodies");
    capacity(devices, kMaxFingers, "devices");
    for (const Element& rates : root_.children("rates")) checkRates(rates);
    const auto moves = [](const Element& body) { return !body.flawed("fixed") && !body.boolean("fixed", false); };
    if (!devices.empty() && std::any_of(bodies.begin(), bodies.end(), moves)) checkDynamics(devices);
    for (const Element& dynamics : root_.children("dynamics")) checkCoupling(dynamics);
    for (const Element& material : materials_) checkFriction(material);
    for (const Element& haptics : root_.children("haptics")) checkRenderer(haptics);
    if (bodies.empty())
      diagnostics_.error(kNoBodies, root_.where(), "the scene has no <body>", "a scene needs at least one body");
    if (materials_.empty() && !bodies.empty()) {
      diagnostics_.error(kNoMaterial, root_.where(), "the scene has no <material>, and bodies need one",
                         "add <materials><material name=\"rubber\" stiffness=\"1000\"/></materials>");
    }
    for (const Element& body : bodies) checkBody(body);
    forEachMaterialNamed(root_, [this](const Element& element, const std::string& name) { checkNamed(element, name); });
  }

 private:
  void unique(const std::vector<Element>& elements, const std::string& attribute, const std::string& kind) {
    std::map<std::string, SourceLocation> first;
    for (const Element& element : elements) {
      if (!element.hasAttribute(attribute) || element.flawed(attribute)) continue;
      const std::string name = element.attribute(attribute);
      const auto [found, is_new] = first.try_emplace(name, element.where(attribute));
      if (is_new) continue;
      diagnostics_.error(kDuplicateName, element.where(attribute), "a second " + kind + " is named " + quote(name),
                         "the first is in " + lineText(found->second));
    }
  }

  void capacity(const std::vector<Element>& elements, int limit, const std::string& kind) {
    if (elements.size() <= static_cast<std::size_t>(limit)) return;
    diagnostics_.error(kCapacity, elements[static_cast<std::size_t>(limit)].where(),
                       "the scene has " + std::to_string(elements.size()) + " " + kind + ", at most " +
                           std::to_string(limit) + " are possible");
  }

  void checkRates(const Element& rates) {
    const Rates defaults;
    if (rates.flawed("haptic")) return;
    const double haptic = rates.number("haptic", defaults.haptic);
    wholeRatio(rates, haptic, "collision", defaults.collision);
    wholeRatio(rates, haptic, "dynamics", defaults.dynamics);
  }

  // For scenes with fingers and free bodies.
  void checkDynamics(const std::vector<Element>& devices) {
    double dynamics = Rates().dynamics;
    for (const Element& rates : root_.children("rates")) {
      if (rates.flawed("dynamics")) return;
      dynamics = rates.number("dynamics", dynamics);
      if (dynamics < kHeldNowhereBelow) {
        diagnostics_.error(kSlowDynamics, rates.where("dynamics"),
                           "at this dynamics rate no finger can hold a body: must be " + shortText(kHeldNowhereBelow) +
                               " Hz or more where there are devices and bodies that move, found " + shortText(dynamics),
                           shortText(kHeldBadlyBelow) + " Hz or more holds without a warning; 200 is usual");
        return;  // the watchdog check would only repeat this
      }
      if (dynamics < kHeldBadlyBelow) {
        diagnostics_.warning(kSlowDynamics, rates.where("dynamics"),
                             "at a dynamics rate of " + shortText(dynamics) +
                                 " Hz a body with a stiff surface drifts in the fingers that hold it",
                             shortText(kHeldBadlyBelow) + " Hz or more avoids this; 200 is usual");
      }
    }
    for (const Element& device : devices) checkWatchdog(device, dynamics);
  }

  void checkWatchdog(const Element& device, double dynamics) {
    for (const Element& limits : device.children("limits")) {
      if (!limits.hasAttribute("watchdog_ms") || limits.flawed("watchdog_ms")) continue;
      const double watchdog = 1e-3 * limits.number("watchdog_ms", 0), shortest = ages::shortestWatchdog(dynamics);
      if (watchdog >= shortest * (1 - 1e-9)) continue;
      diagnostics_.error(
          kWatchdog, limits.where("watchdog_ms"),
          "the force of " + device.label() + " would fade although the dynamics is on time: " + quote("watchdog_ms") +
              " must be at least two periods of the dynamics, found " + shortText(1e3 * watchdog) + " ms at " +
              shortText(dynamics) + " Hz",
          "write watchdog_ms=" + quoted(shortText(std::ceil(1e3 * shortest))) +
              " or more, or leave it out; or rates/dynamics=" + quoted(shortText(ages::kPeriods / watchdog)) +
              " or more");
    }
  }

  static std::string quoted(const std::string& text) { return "\"" + text + "\""; }

  void wholeRatio(const Element& rates, double haptic, const std::string& name, double fallback) {
    if (rates.flawed(name)) return;
    const double rate = rates.number(name, fallback);
    const double ratio = haptic / rate;
    // 1e-9: 333.3333333333 is accepted as a third, 333 is not
    const bool is_whole = ratio > 0.5 && std::abs(ratio - std::round(ratio)) <= 1e-9 * ratio;
    if (is_whole) return;
    const std::string culprit = rates.hasAttribute(name) ? name : "haptic";
    diagnostics_.error(kRates, rates.where(culprit),
                       "haptic / " + name + " must be a whole number, found " + numberText(haptic) + " / " +
                           numberText(rate) + " = " + shortText(ratio),
                       "nearest " + name + " rates that fit: " + fittingRates(haptic, ratio));
  }

  static std::string shortText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
  }

  /// The nearest slower and the nearest faster rate that divide `haptic` and have few digits.
  static std::string fittingRates(double haptic, double ratio) {
    const auto is_short = [&](double n) { return std::abs(haptic / n * 1000 - std::round(haptic / n * 1000)) < 1e-9; };
    std::vector<std::string> rates;
    double slower = std::max(1.0, std::ceil(ratio));
    while (slower < haptic && !is_short(slower)) ++slower;
    if (is_short(slower)) rates.push_back(shortText(haptic / slower));
    double faster = std::floor(ratio);
    while (faster > 1 && !is_short(faster)) --faster;
    if (faster >= 1) rates.push_back(shortText(haptic / faster));
    return listed(rates);
  }

  void checkCoupling(const Element& dynamics) {
    if (dynamics.flawed("coupling") || dynamics.attribute("coupling") != "haptic_rate") return;
    for (const CouplingObstacle& obstacle : obstaclesToHapticRate(root_))
      diagnostics_.error(kNotAtHapticRate, obstacle.where,
                         "the coupling 'haptic_rate' does not go with " + obstacle.found, obstacle.allowed);
  }

  void checkFriction(const Element& material) {
    for (const Element& friction : material.children("friction")) {
      checkCoefficients(friction, material.label());
      checkLaws(friction, material.label());
      for (const Element& changed : friction.children("changed"))
        checkCoefficients(changed, material.label() + " after its change");
    }
  }

  /// Every other child of <friction> than <changed> is the element of a friction law.
  void checkLaws(const Element& friction, const std::string& whose) {
    std::vector<Element> laws = friction.children();
    std::erase_if(laws, [](const Element& child) { return child.name() == "changed"; });
    if (laws.size() < 2) return;
    diagnostics_.error(
        kTwoLaws, laws[1].where(),
        "friction of " + whose + " names two laws, <" + laws[0].name() + "> and <" + laws[1].name() + ">",
        "one law for each material");
  }

  /// The children of <haptics> are the settings of renderers.
  void checkRenderer(const Element& haptics) {
    if (haptics.flawed("renderer")) return;
    if (haptics.flawed("tools")) return;
    const std::string name = haptics.attribute("renderer", kDefaultRenderer),
                      of_tools = haptics.attribute("tools", kDefaultToolRenderer);
    for (const Element& settings : haptics.children()) {
      const auto belongs_to = [&](const std::string& renderer) {
        const Manifest* manifest = findManifest(renderer);
        return manifest != nullptr && std::ranges::any_of(manifest->elements, [&](const Manifest::Element& own) {
                 return own.name == settings.name();
               });
      };
      if (belongs_to(name) || belongs_to(of_tools)) continue;
      diagnostics_.error(kOtherRenderer, settings.where(),
                         "<" + settings.name() + "> has settings of another renderer than " + quote(name),
                         "remove it, or write <haptics renderer=\"…\"> with the renderer that it belongs to");
    }
  }

  void checkCoefficients(const Element& friction, const std::string& whose) {
    const bool has_both = friction.hasAttribute("static") && friction.hasAttribute("dynamic");
    if (!has_both || friction.flawed("static") || friction.flawed("dynamic")) return;
    if (friction.number("dynamic", 0) <= friction.number("static", 0)) return;
    diagnostics_.error(kFriction, friction.where("dynamic"),
                       "dynamic friction of " + whose + " must not be above static friction, found " +
                           friction.attribute("dynamic") + " > " + friction.attribute("static"));
  }

  void checkBody(const Element& body) {
    checkOrientation(body, diagnostics_);
    for (const Element& geometry : body.children()) {
      checkOrientation(geometry, diagnostics_);
      for (const Element& shape : geometry.children()) checkOrientation(shape, diagnostics_);
    }
    checkMaterial(body);
    const std::vector<Element> physics = body.children("physics");
    if (body.boolean("fixed", false)) {
      for (const Element& one : physics) checkFixedPhysics(one);
    } else if (!body.flawed("fixed")) {
      checkFreePhysics(body, physics);
    }
    if (body.children().empty() && body.boolean("fixed", false)) {
      diagnostics_.warning(kNoGeometry, body.where(), body.label() + " has no geometry: it is neither seen nor felt");
    }
  }

  void checkMaterial(const Element& body) {
    if (materials_.empty() || body.flawed("material")) return;
    if (!body.hasAttribute("material")) {
      if (materials_.size() == 1) return;
      diagnostics_.error(kNoMaterial, body.where(), body.label() + " has no 'material', and there are several",
                         "materials: " + listed(material_names_));
      return;
    }
    checkNamed(body, "material");
  }

  void checkNamed(const Element& element, const std::string& attribute) {
    const std::string material = element.attribute(attribute);
    if (known_materials_.contains(material)) return;
    diagnostics_.error(kUnknownMaterial, element.where(attribute),
                       element.label() + " has " + attribute + " " + quote(material) + ", which does not exist" +
                           didYouMean(material, material_names_),
                       "materials: " + listed(material_names_));
  }

  void checkFixedPhysics(const Element& physics) {
    for (const char* attribute : {"mass", "density", "inertia", "center"}) {
      if (!physics.hasAttribute(attribute)) continue;
      diagnostics_.warning(kMassOfFixed, physics.where(attribute),
                           quote(attribute) + " of " + physics.label() + " has no effect: the body is fixed");
    }
  }

  void checkFreePhysics(const Element& body, const std::vector<Element>& physics) {
    if (physics.empty()) {
      diagnostics_.error(kNoPhysics, body.where(), body.label() + " is free to move, but has no <physics>",
                         "add <physics mass=\"...\"> with a shape, or fixed=\"true\"");
      return;
    }
    checkInertia(physics[0]);
    const bool has_mass = physics[0].hasAttribute("mass"), has_density = physics[0].hasAttribute("density");
    if (has_mass != has_density) return;
    if (!has_mass && isMisplaced(body, physics[0])) return;
    diagnostics_.error(
        kMassOrDensity, has_mass ? physics[0].where("density") : physics[0].where(),
        physics[0].label() + " needs one of 'mass' and 'density', found " + (has_mass ? "both" : "neither"),
        "mass [kg] or density [kg/m^3]; a body that never moves has fixed=\"true\"");
  }

  /// An inertia belongs to a mass, a centre to an inertia: one alone would be mixed with that of the shapes.
  void checkInertia(const Element& physics) {
    for (const auto& [given, needed] : {std::pair{"inertia", "mass"}, {"center", "inertia"}}) {
      if (!physics.hasAttribute(given) || physics.hasAttribute(needed)) continue;
      diagnostics_.error(kInertia, physics.where(given),
                         quote(given) + " of " + physics.label() + " needs " + quote(needed) + ", found none",
                         std::string("add ") + needed + "=\"…\", or leave out both");
    }
  }

  /// The mass is given in the wrong place, which the schema check has reported already.
  static bool isMisplaced(const Element& body, const Element& physics) {
    for (const char* name : {"mass", "density"}) {
      if (body.hasAttribute(name) || !body.children(name).empty() || !physics.children(name).empty()) return true;
    }
    return false;
  }

  Element root_;
  Diagnostics& diagnostics_;
  std::vector<Element> materials_;
  std::vector<std::string> material_names_;
  std::set<std::string> known_materials_;
};

}  // namespace

void checkOrientation(const Element& element, Diagnostics& diagnostics) {
  if (element.hasAttribute("euler_deg") && element.hasAttribute("quat")) {
    diagnostics.error(kTwoOrientations, element.where("quat"),
                      element.label() + " has both 'euler_deg' and 'quat', only one is allowed");
  }
  const std::vector<double> quat = element.numbers("quat");
  if (quat == std::vector<double>{0, 0, 0, 0}) {
    diagnostics.error(kZeroQuat, element.where("quat"), "'quat' of " + element.label() + " is zero: no rotation",
                      "quat: w x y z; the identity is \"1 0 0 0\"");
  }
}

void checkScene(const Element& root, Diagnostics& diagnostics) {
  SceneCheck(root, diagnostics).run();
  checkAssembly(root, diagnostics);
  checkJoints(root, diagnostics);
  checkSaneRanges(root, diagnostics);
}

}  // namespace presa
