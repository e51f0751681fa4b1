#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

using xml::Element;
using xml::ElementRule;

enum DefaultCode { kUnknownClass = 277, kUnfit = 278, kUnused = 279 };

/// The elements of a scene that may take values from <defaults>.
const std::vector<std::string>& kinds() {
  static const std::vector<std::string> kKinds{"body", "joint", "material", "device"};
  return kKinds;
}

std::vector<Element> elementsOf(const Element& root, const std::string& kind) {
  if (kind == "material") return materialElements(root);
  if (kind == "device") return deviceElements(root);
  return root.children(kind);
}

const ElementRule* ruleOf(const ElementRule& scene, const std::string& kind) {
  const ElementRule* const list = kind == "material" || kind == "device" ? scene.child(kind + "s") : &scene;
  return list == nullptr ? nullptr : list->child(kind);
}

/// Attributes of `from` that `to` lacks. An inertia goes with its mass: an element with a mass of its own takes none.
void fillAttributes(Element to, const Element& from) {
  const bool has_mass = to.hasAttribute("mass") || to.hasAttribute("density");
  for (const std::string& name : from.attributeNames()) {
    if (has_mass && (name == "inertia" || name == "center")) continue;
    const std::string rival = rivalOf(name);
    if (name == "class" || to.hasAttribute(name) || (!rival.empty() && to.hasAttribute(rival))) continue;
    to.setAttribute(name, from.attribute(name), from.where(name));
  }
}

/// Attributes and children of `from` that `to` lacks; a child that is there and holds something takes attributes alone,
/// since what it holds may be an alternative. Returns how many elements came.
std::size_t fill(Element to, const Element& from) {
  std::size_t came = 0;
  fillAttributes(to, from);
  std::set<std::string> own;
  for (const Element& child : to.children()) own.insert(child.name());
  std::set<std::string> seen;
  for (const Element& child : from.children()) {
    const bool first = seen.insert(child.name()).second;
    if (!own.contains(child.name())) {
      came += elementsIn(to.addCopy(child));
    } else if (first) {
      for (const Element& existing : to.children(child.name())) {
        if (existing.children().empty())
          came += fill(existing, child);
        else
          fillAttributes(existing, child);
      }
    }
  }
  return came;
}

/// The <defaults> of one document.
class Defaults {
 public:
  Defaults(const Element& root, const ElementRule& scene, Diagnostics& diagnostics)
      : root_(root), scene_(scene), diagnostics_(diagnostics) {}

  void apply() {
    for (const Element& list : root_.children("defaults")) {
      for (const std::string& name : list.attributeNames())
        refuse(list.where(name), "<defaults> has no attribute " + quote(name), "");
      for (const Element& given : list.children()) take(given);
    }
    for (const std::string& kind : kinds())
      for (const Element& element : elementsOf(root_, kind)) give(element);
    if (copied_ > kMostCopied)
      refuse(root_.children("defaults")[0].where(),
             "<defaults> brings more than " + std::to_string(kMostCopied) + " elements",
             "give fewer elements, or to fewer");
    for (const auto& [key, given] : templates_) {
      if (key.second.empty() || used_.contains(key)) continue;
      diagnostics_.warning(kUnused, given.where("class"), "no <" + key.first + "> has class " + quote(key.second),
                           "write class=\"" + key.second + "\" in it, or leave the class out");
    }
    for (Element list : root_.children("defaults")) list.remove();
  }

 private:
  using Key = std::pair<std::string, std::string>;  // kind, class

  void take(const Element& given) {
    const ElementRule* const rule = ruleOf(scene_, given.name());
    if (std::ranges::find(kinds(), given.name()) == kinds().end() || rule == nullptr)
      return refuse(given.where(), "<defaults> knows no <" + given.name() + ">" + didYouMean(given.name(), kinds()),
                    "it may hold body, joint, material, device");
    const Key key{given.name(), given.attribute("class")};
    if (templates_.contains(key))
      return refuse(given.where(), "<defaults> has two <" + key.first + "> of class " + quote(key.second),
                    "put them together, or give one another class");
    for (const char* own : {"name", "role"}) {
      if (given.hasAttribute(own))
        refuse(given.where(own), quote(own) + " belongs to one <" + key.first + "> alone, not to <defaults>",
               "class=\"NAME\" names what others may take");
    }
    check(given, *rule);
    templates_.emplace(key, given);
  }

  /// Mistakes are told once, here, and not again by every element that takes them.
  void check(Element given, const ElementRule& rule) {
    for (const std::string& name : given.attributeNames()) {
      const xml::AttributeRule* const attribute = rule.attribute(name);
      if (attribute == nullptr)
        refuse(given.where(name),
               "<" + rule.name + "> has no attribute " + quote(name) + didYouMean(name, rule.attributeNames()), "");
      else if (const auto problem = problemOf(attribute->value, given.attribute(name)))
        refuse(given.where(name), quote(name) + " of <" + rule.name + "> " + problem->message, problem->help);
      else
        continue;
      given.removeAttribute(name);
    }
    for (Element child : given.children()) {
      const ElementRule* const inner = rule.child(child.name());
      if (inner != nullptr) {
        check(child, *inner);
        continue;
      }
      refuse(child.where(),
             "<" + rule.name + "> has no <" + child.name() + ">" + didYouMean(child.name(), rule.childNames()), "");
      child.remove();
    }
  }

  void give(Element element) {
    if (copied_ > kMostCopied) return;
    const std::string kind = element.name(), named = element.attribute("class");
    if (const auto found = templates_.find({kind, named}); found != templates_.end()) {
      copied_ += fill(element, found->second);
      used_.insert(found->first);
    } else if (element.hasAttribute("class")) {
      refuseClass(element, kind, named);
    }
    if (const auto found = templates_.find({kind, ""}); found != templates_.end() && !named.empty())
      copied_ += fill(element, found->second);
    element.removeAttribute("class");
  }

  void refuseClass(const Element& element, const std::string& kind, const std::string& named) {
    std::vector<std::string> classes;
    for (const auto& [key, given] : templates_)
      if (key.first == kind && !key.second.empty()) classes.push_back(key.second);
    std::string help = "<defaults> has no <" + kind + "> with a class";
    for (std::size_t i = 0; i < classes.size(); ++i) help = (i == 0 ? "classes: " : help + ", ") + classes[i];
    diagnostics_.error(
        kUnknownClass, element.where("class"),
        element.label() + " has class " + quote(named) + ", which does not exist" + didYouMean(named, classes), help);
  }

  void refuse(const SourceLocation& where, const std::string& what, const std::string& help) {
    diagnostics_.error(kUnfit, where, what, help);
  }

  Element root_;
  const ElementRule& scene_;
  Diagnostics& diagnostics_;
  std::map<Key, Element> templates_;
  std::set<Key> used_;
  std::size_t copied_ = 0;  // elements
};

}  // namespace

void applyDefaults(const xml::Element& root, const xml::ElementRule& scene, Diagnostics& diagnostics) {
  Defaults(root, scene, diagnostics).apply();
}

}  // namespace presa
