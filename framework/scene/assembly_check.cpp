#include <algorithm>
#include <set>

#include "framework/scene/scene_parts.h"
#include "framework/xml/value_rule.h"

namespace presa {
namespace {

using xml::Element;
using xml::splitWords;

enum Code {
  kDuplicateGoal = 203,
  kUnknownBody = 214,
  kFixedBody = 215,
  kUnknownGoal = 216,
  kGoalLoop = 217,
  kElement = 218
};

class AssemblyCheck {
 public:
  AssemblyCheck(const Element& root, const Element& assembly, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), goals_(assembly.children("goal")) {
    for (const Element& body : root.children("body")) {
      bodies_.push_back(body.attribute("name"));
      if (body.boolean("fixed", false)) fixed_.insert(bodies_.back());
    }
    for (const Element& goal : goals_) names_.push_back(goal.attribute("name"));
    for (const Element& words : assembly.children("words")) {
      checkWords(words, diagnostics);
      for (const Element& element : words.children("element")) elements_.push_back(element.attribute("name"));
    }
  }

  void run() {
    for (std::size_t g = 0; g < goals_.size(); ++g) {
      checkName(g);
      checkBodies(goals_[g]);
      checkAfter(goals_[g]);
      checkElement(goals_[g]);
      checkOrientation(goals_[g], diagnostics_);
    }
    checkOrder();
  }

 private:
  void checkName(std::size_t g) {
    const auto first = std::find(names_.begin(), names_.end(), names_[g]);
    if (names_[g].empty() || first == names_.begin() + static_cast<std::ptrdiff_t>(g)) return;
    diagnostics_.error(kDuplicateGoal, goals_[g].where("name"), "a second goal is named " + quote(names_[g]));
  }

  void checkBodies(const Element& goal) {
    for (const std::string& body : splitWords(goal.attribute("bodies"))) {
      if (std::find(bodies_.begin(), bodies_.end(), body) == bodies_.end()) {
        diagnostics_.error(
            kUnknownBody, goal.where("bodies"),
            goal.label() + " is for body " + quote(body) + ", which does not exist" + didYouMean(body, bodies_));
      } else if (fixed_.contains(body)) {
        diagnostics_.error(kFixedBody, goal.where("bodies"),
                           goal.label() + " is for body " + quote(body) + ", which is fixed",
                           "only a free body can be put somewhere");
      }
    }
  }

  void checkAfter(const Element& goal) {
    for (const std::string& before : splitWords(goal.attribute("after"))) {
      if (std::find(names_.begin(), names_.end(), before) != names_.end()) continue;
      diagnostics_.error(
          kUnknownGoal, goal.where("after"),
          goal.label() + " comes after goal " + quote(before) + ", which does not exist" + didYouMean(before, names_));
    }
  }

  void checkElement(const Element& goal) {
    const std::string name = goal.attribute("element");
    if (name.empty() || std::find(elements_.begin(), elements_.end(), name) != elements_.end()) return;
    diagnostics_.error(kElement, goal.where("element"),
                       goal.label() + " is an element " + quote(name) + ", of which <words> says nothing" +
                           didYouMean(name, elements_),
                       "<words><element name=" + quote(name) + " called=\"…\"/></words>");
  }

  /// Whatever can be filled is filled, until nothing more can: what is left waits for itself.
  void checkOrder() {
    std::set<std::string> filled;
    for (bool more = true; more;) {
      more = false;
      for (const Element& goal : goals_)
        more = (mayBeFilled(goal, filled) && filled.insert(goal.attribute("name")).second) || more;
    }
    for (const Element& goal : goals_) {
      if (filled.contains(goal.attribute("name"))) continue;
      diagnostics_.error(kGoalLoop, goal.where("after"), goal.label() + " can never be filled: it waits for itself",
                         "after=" + quote(goal.attribute("after")));
    }
  }

  bool mayBeFilled(const Element& goal, const std::set<std::string>& filled) const {
    const std::vector<std::string> after = splitWords(goal.attribute("after"));
    return std::all_of(after.begin(), after.end(), [&](const std::string& name) {
      const bool exists = std::find(names_.begin(), names_.end(), name) != names_.end();
      return !exists || filled.contains(name);  // one that does not exist has been reported
    });
  }

  Diagnostics& diagnostics_;
  std::vector<Element> goals_;
  std::vector<std::string> bodies_, names_, elements_;
  std::set<std::string> fixed_;
};

}  // namespace

void checkAssembly(const Element& root, Diagnostics& diagnostics) {
  for (const Element& assembly : root.children("assembly")) AssemblyCheck(root, assembly, diagnostics).run();
}

}  // namespace presa
