#include <algorithm>
#include <optional>

#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/listed.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

using xml::Element;
using xml::ElementRule;

enum PathCode { kBadPath = 202 };

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts{""};
  for (const char c : path) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// The attribute that distinguishes elements of one kind; in a path it follows the element's name. "" for single
/// elements.
std::string identityAttribute(const ElementRule& rule) {
  for (const char* name : {"name", "role"}) {
    if (rule.attribute(name)) return name;
  }
  return {};
}

/// For a list element such as <materials> (no attributes, one kind of child): that child, else null. A path may omit
/// the list.
const ElementRule* listedElement(const ElementRule& rule) {
  const bool is_list = rule.attributes.empty() && rule.content.size() == 1 && rule.content[0].options.size() == 1;
  return is_list ? rule.content[0].options[0] : nullptr;
}

/// Follows one path through the document and the schema at the same time.
class PathWalk {
 public:
  PathWalk(const Element& root, const ElementRule& rule, const Override& change, Diagnostics& diagnostics)
      : element_(root),
        rule_(&rule),
        change_(change),
        origin_{"--set " + change.path + "=" + change.value, 0, 0},
        parts_(split(change.path)),
        diagnostics_(diagnostics) {}

  void run() {
    if (std::find(parts_.begin(), parts_.end(), "") != parts_.end()) {
      fail("a part of the path is empty", "write --set PATH=VALUE, such as --set body/cube/physics/mass=0.5");
      return;
    }
    walk();
  }

 private:
  void walk() {
    while (index_ + 1 < parts_.size()) {
      if (!descend()) return;
    }
    setAttribute();
  }

  bool fail(const std::string& message, const std::string& help) {
    diagnostics_.error(kBadPath, origin_, quote(change_.path) + ": " + message, help);
    return false;
  }

  std::string here() const {
    std::string path;
    for (std::size_t i = 0; i < index_; ++i) path += parts_[i] + "/";
    return path;
  }

  /// Names that may follow at this place of the path.
  std::vector<std::string> choices() const {
    std::vector<std::string> names = rule_->attributeNames();
    for (const xml::ContentRule& content : rule_->content) {
      for (const ElementRule* option : content.options) {
        const bool may_follow = content.options.size() == 1 || !element_.children(option->name).empty();
        if (!may_follow) continue;
        names.push_back(option->name);
        if (const ElementRule* inner = listedElement(*option)) names.push_back(inner->name);
      }
    }
    return names;
  }

  bool unknownPart() {
    const std::vector<std::string> names = choices();
    return fail("there is no " + quote(parts_[index_]) + didYouMean(parts_[index_], names),
                "possible" + (index_ > 0 ? " after " + here() : std::string(" at the start")) + ": " + listed(names));
  }

  /// "vortex[2]": the second <vortex>; without brackets the only one.
  struct Numbered {
    std::string name;
    std::size_t number = 0;  // 0: none is given
  };
  static Numbered numbered(const std::string& part) {
    const std::size_t open = part.find('[');
    if (open == std::string::npos || part.back() != ']') return {part, 0};
    const std::string digits = part.substr(open + 1, part.size() - open - 2);
    const bool is_number = !digits.empty() && digits.size() < 7 &&
                           std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    return is_number && std::stoul(digits) > 0 ? Numbered{part.substr(0, open), std::stoul(digits)} : Numbered{part, 0};
  }

  /// From here the rest of the path is followed in `element`, too. This walk ends.
  void followIn(const Element& element, const ElementRule& rule) {
    PathWalk other = *this;
    other.step(element, rule, 1);
    other.walk();
  }

  static bool mayBeAdded(const ElementRule& parent, const ElementRule& child) {
    const bool needs_children = std::any_of(child.content.begin(), child.content.end(),
                                            [](const xml::ContentRule& inner) { return inner.min > 0; });
    return parent.contentOf(child.name)->options.size() == 1 && !needs_children && !listedElement(child);
  }

  /// Whether a path can go on from an element with this part.
  static bool leadsOn(const Element& element, const ElementRule& rule, const std::string& part) {
    const ElementRule* child = rule.child(numbered(part).name);
    return rule.attribute(part) || (child && (!element.children(child->name).empty() || mayBeAdded(rule, *child)));
  }

  /// Settings may stand in the file or not: <haptics tools="pointshell"/> has an element <pointshell> all the same.
  void addNamedElements() {
    for (const std::string& attribute : rule_->attributeNames()) {
      const std::string name = element_.attribute(attribute);
      const ElementRule* child = rule_->child(name);
      if (child && child->attribute(parts_[index_ + 1]) && element_.children(name).empty() &&
          mayBeAdded(*rule_, *child))
        element_.addChild(name, origin_);
    }
  }

  /// "*" in the place of an element, or of its name: all of those in which the path can go on.
  bool followInEach(const std::vector<Element>& candidates, const ElementRule* common_rule = nullptr) {
    const std::string& next = parts_[index_ + 1];
    bool any = false;
    for (const Element& candidate : candidates) {
      const ElementRule* rule = common_rule ? common_rule : rule_->child(candidate.name());
      if (!rule || !leadsOn(candidate, *rule, next)) continue;
      followIn(candidate, *rule);
      any = true;
    }
    return any ? false : fail("nothing at " + here() + "* has " + quote(next), "");
  }

  /// False: the walk ends here, with a finding or because others follow the rest of the path.
  bool descend() {
    const std::string& part = parts_[index_];
    if (part == "*") {
      addNamedElements();
      return followInEach(element_.children());
    }
    const Numbered which = numbered(part);
    const ElementRule* next = rule_->child(which.name);
    if (next && (which.number == 0 || identityAttribute(*next).empty())) return enter(*next, which.number);
    for (const xml::ContentRule& content : rule_->content) {
      const ElementRule& container = *content.options.front();
      const ElementRule* inner = content.options.size() == 1 ? listedElement(container) : nullptr;
      if (!inner || inner->name != part) continue;
      std::vector<Element> candidates;
      for (const Element& list : element_.children(container.name)) {
        for (const Element& one : list.children(part)) candidates.push_back(one);
      }
      return enterNamed(*inner, candidates);
    }
    if (rule_->attribute(part)) {
      return fail(quote(part) + " is a value, nothing can follow it", "end the path after " + here() + part);
    }
    return unknownPart();
  }

  /// `number`: which of several, from 1 on; 0: the only one.
  bool enter(const ElementRule& next, std::size_t number) {
    const std::vector<Element> found = element_.children(next.name);
    if (!identityAttribute(next).empty()) return enterNamed(next, found);
    const xml::ContentRule& content = *rule_->contentOf(next.name);
    if (number > found.size() || (number == 0 && found.size() > 1)) {
      const std::string count = std::to_string(found.size());
      return fail(element_.label() + " holds " + (found.empty() ? "no" : count) + " <" + next.name + ">",
                  found.empty() ? "" : "say which: " + next.name + "[1] to " + next.name + "[" + count + "]");
    }
    if (!found.empty()) {
      step(found[std::max<std::size_t>(number, 1) - 1], next, 1);
      return true;
    }
    if (content.options.size() > 1) {
      const std::vector<Element> others = element_.children();
      return fail(
          element_.label() + " holds no <" + next.name + ">",
          others.empty() ? "" : "it holds <" + others.front().name() + ">; a path cannot change the kind of a shape");
    }
    if (!mayBeAdded(*rule_, next)) {
      return fail(element_.label() + " has no <" + next.name + ">", "a path can set values, not add a whole element");
    }
    step(element_.addChild(next.name, origin_), next, 1);
    return true;
  }

  bool enterNamed(const ElementRule& next, const std::vector<Element>& candidates) {
    const std::string identity = identityAttribute(next);
    std::vector<std::string> names;
    for (const Element& candidate : candidates) names.push_back(candidate.attribute(identity));
    const std::string kind = next.name;
    ++index_;  // from the element's name to its identity; the path has at least one more part
    const std::string& wanted = parts_[index_];
    if (wanted == "*" && !names.empty() && index_ + 1 < parts_.size()) return followInEach(candidates, &next);
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) {
      return fail("there is no " + kind + " " + quote(wanted) + didYouMean(wanted, names),
                  names.empty() ? "the scene has no " + kind : kind + " is one of: " + listed(names));
    }
    if (index_ + 1 == parts_.size()) {
      index_ = parts_.size();
      step(candidates[static_cast<std::size_t>(found - names.begin())], next, 0);
      return fail("the path ends at an element, a value must follow",
                  "possible after " + here() + ": " + listed(choices()));
    }
    step(candidates[static_cast<std::size_t>(found - names.begin())], next, 1);
    return true;
  }

  void step(const Element& element, const ElementRule& rule, std::size_t parts) {
    element_ = element;
    rule_ = &rule;
    index_ += parts;
  }

  void setAttribute() {
    const std::string& name = parts_[index_];
    if (!rule_->attribute(name)) {
      const ElementRule* child = rule_->child(name);
      if (!child) {
        unknownPart();
        return;
      }
      const std::vector<std::string> inside =
          identityAttribute(*child).empty() ? child->attributeNames() : std::vector<std::string>{"its name"};
      fail("the path ends at an element, a value must follow",
           "possible after " + here() + name + "/: " + listed(inside));
      return;
    }
    keepInertia(name);
    const std::string rival = rivalOf(name);
    if (!rival.empty()) element_.removeAttribute(rival);
    element_.setAttribute(name, change_.value, origin_);
  }

  /// An inertia that the scene gives belongs to its mass: another mass scales it, and a density means that of the shapes.
  void keepInertia(const std::string& name) {
    if (!element_.hasAttribute("inertia") || (name != "mass" && name != "density")) return;
    double wanted = 0;
    const double given = element_.number("mass", 0);
    if (name == "density") {
      element_.removeAttribute("inertia");
      element_.removeAttribute("center");
    } else if (given > 0 && xml::readNumber(change_.value, wanted) == xml::NumberKind::kFinite && wanted > 0) {
      std::string scaled;
      for (const double moment : element_.numbers("inertia")) scaled += xml::numberText(moment * wanted / given) + " ";
      element_.setAttribute("inertia", scaled);
    }
  }

  Element element_;
  const ElementRule* rule_;
  const Override& change_;
  SourceLocation origin_;
  std::vector<std::string> parts_;
  Diagnostics& diagnostics_;
  std::size_t index_ = 0;
};

}  // namespace

std::string rivalOf(const std::string& attribute) {
  static const std::pair<const char*, const char*> kRivals[] = {{"mass", "density"},    {"euler_deg", "quat"},
                                                                {"preset", "static"},   {"lower", "lower_deg"},
                                                                {"upper", "upper_deg"}, {"rest", "rest_deg"}};
  for (const auto& [a, b] : kRivals) {
    if (attribute == a) return b;
    if (attribute == b) return a;
  }
  return {};
}

void applyOverrides(const Element& root, const ElementRule& rule, const std::vector<Override>& overrides,
                    Diagnostics& diagnostics) {
  for (const Override& change : overrides) PathWalk(root, rule, change, diagnostics).run();
}

}  // namespace presa
