#include "framework/scene/ages.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

using xml::Element;

/// A single coefficient is used for both static and dynamic friction; without any, friction is 0.
void resolveFriction(Element friction) {
  const std::string only = friction.attribute("static", friction.attribute("dynamic", "0"));
  for (const char* attribute : {"static", "dynamic"}) {
    if (!friction.hasAttribute(attribute)) friction.setAttribute(attribute, only, friction.where());
  }
  for (const Element& changed : friction.children("changed")) resolveFriction(changed);
}

void resolveOrientation(Element element) {
  if (element.hasAttribute("quat") || element.hasAttribute("euler_deg")) return;
  element.setAttribute("euler_deg", "0 0 0", element.where());
}

void resolveMesh(Element geometry, const std::string& directory) {
  for (Element mesh : geometry.children("mesh")) {
    mesh.setAttribute("file", resolvePath(mesh.attribute("file"), directory));
  }
}

/// For each device: whether the scene sets its watchdog.
std::vector<bool> watchdogsSet(const Element& root) {
  std::vector<bool> set;
  for (const Element& device : deviceElements(root)) {
    set.push_back(false);
    for (const Element& limits : device.children("limits")) set.back() = limits.hasAttribute("watchdog_ms");
  }
  return set;
}

/// Watchdogs that the scene does not set follow from the dynamics rate; the default of the schema fits the usual rate.
void resolveWatchdogs(const Element& root, const std::vector<bool>& set) {
  Rates rates;
  for (const Element& given : root.children("rates")) rates.dynamics = given.number("dynamics", rates.dynamics);
  const double watchdog = ages::objects(rates);
  if (watchdog <= ages::kFloor) return;
  const std::vector<Element> devices = deviceElements(root);
  for (std::size_t f = 0; f < devices.size(); ++f) {
    for (Element limits : devices[f].children("limits")) {
      if (!set[f]) limits.setAttribute("watchdog_ms", xml::numberText(1e3 * watchdog), limits.where());
    }
  }
}

}  // namespace

void resolveFiles(const Element& scene, const std::string& directory) {
  Element root = scene;
  if (root.hasAttribute("rig")) root.setAttribute("rig", resolvePath(root.attribute("rig"), directory));
  for (Element include : root.children("include"))
    include.setAttribute("file", resolvePath(include.attribute("file"), directory));
  for (const Element& body : root.children("body")) {
    for (const char* role : {"visual", "haptic", "physics"}) {
      for (const Element& geometry : body.children(role)) resolveMesh(geometry, directory);
    }
  }
  for (const Element& device : deviceElements(root)) {
    for (const Element& tool : device.children("tool")) resolveMesh(tool, directory);
  }
  resolvePluginFiles(root, directory);
}

void resolveScene(xml::Document& document, const xml::Schema& schema, const std::string& directory) {
  const std::vector<bool> watchdogs_set = watchdogsSet(document.root());
  document.writeDefaults(schema);
  Element root = document.root();
  resolveWatchdogs(root, watchdogs_set);
  resolveFiles(root, directory);
  const std::vector<Element> materials = materialElements(root);
  for (const Element& material : materials) {
    for (const Element& friction : material.children("friction")) resolveFriction(friction);
  }
  for (Element body : root.children("body")) {
    if (!body.hasAttribute("material")) body.setAttribute("material", materials[0].attribute("name"), body.where());
    resolveOrientation(body);
    for (const char* role : {"visual", "haptic", "physics"}) {
      for (const Element& geometry : body.children(role)) resolveOrientation(geometry);
    }
  }
  for (const Element& assembly : root.children("assembly")) {
    for (const Element& goal : assembly.children("goal")) resolveOrientation(goal);
  }
}

}  // namespace presa
