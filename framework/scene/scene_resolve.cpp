#include "framework/scene/scene_parts.h"

namespace presa {
namespace {

using xml::Element;

/// One coefficient alone is both; none is no friction.
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

}  // namespace

void resolveScene(xml::Document& document, const xml::Schema& schema, const std::string& directory) {
  document.writeDefaults(schema);
  Element root = document.root();
  if (root.hasAttribute("rig")) root.setAttribute("rig", resolvePath(root.attribute("rig"), directory));
  const std::vector<Element> materials = materialElements(root);
  for (const Element& material : materials) {
    for (const Element& friction : material.children("friction")) resolveFriction(friction);
  }
  for (Element body : root.children("body")) {
    if (!body.hasAttribute("material")) body.setAttribute("material", materials[0].attribute("name"), body.where());
    resolveOrientation(body);
    for (const Element& geometry : body.children()) {
      resolveOrientation(geometry);
      resolveMesh(geometry, directory);
    }
  }
  for (const Element& assembly : root.children("assembly")) {
    for (const Element& goal : assembly.children("goal")) resolveOrientation(goal);
  }
}

}  // namespace presa
