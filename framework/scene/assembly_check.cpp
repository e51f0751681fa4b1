#include <algorithm>
#include <map>
#include <set>

#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

using xml::Element;
using xml::splitWords;

enum AssemblyCode {
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
    known_bodies_ = {bodies_.begin(), bodies_.end()};
    for (const Element& goal : goals_) names_.push_back(goal.attribute("name"));
    known_goals_ = {names_.begin(), names_.end()};
    for (const Element& words : assembly.children("words")) {
      checkWords(words, diagnostics);
      for (const Element& element : words.children("element")) elements_.push_back(element.attribute("name"));
    }
  }

  void run() {
    std::set<std::string> before;
    for (std::size_t g = 0; g < goals_.size(); ++g) {
      checkName(g, before);
      checkBodies(goals_[g]);
      checkAfter(goals_[g]);
      checkElement(goals_[g]);
      checkOrientation(goals_[g], diagnostics_);
    }
    checkOrder();
  }

 private:
  void checkName(std::size_t g, std::set<std::string>& before) {
    if (before.insert(names_[g]).second || names_[g].empty()) return;
    diagnostics_.error(kDuplicateGoal, goals_[g].where("name"), "a second goal is named " + quote(names_[g]));
  }

  void checkBodies(const Element& goal) {
    for (const std::string& body : splitWords(goal.attribute("bodies"))) {
      if (!known_bodies_.contains(body)) {
        diagnostics_.error(
            kUnknownBody, goal.where("bodies"),
            goal.label() + " is for body " + quote(body) + ", which does not exist" + didYouMean(body, bodies_));
      } else if (fixed_.contains(body)) {
        diagnostics_.error(kFixedBody, goal.where("bodies"),
                           goal.label() + " is for body " + quote(body) + ", which is fixed",
                           "only a free body can be moved to a goal");
      }
    }
  }

  void checkAfter(const Element& goal) {
    for (const std::string& before : splitWords(goal.attribute("after"))) {
      if (known_goals_.contains(before)) continue;
      diagnostics_.error(
          kUnknownGoal, goal.where("after"),
          goal.label() + " comes after goal " + quote(before) + ", which does not exist" + didYouMean(before, names_));
    }
  }

  void checkElement(const Element& goal) {
    const std::string name = goal.attribute("element");
    if (name.empty() || std::find(elements_.begin(), elements_.end(), name) != elements_.end()) return;
    diagnostics_.error(kElement, goal.where("element"),
                       goal.label() + " names element " + quote(name) + ", which <words> does not define" +
                           didYouMean(name, elements_),
                       "<words><element name=" + quote(name) + " called=\"…\"/></words>");
  }

  /// Topological sort: fills every goal whose predecessors are filled. The goals left over are on or behind a cycle.
  void checkOrder() {
    std::map<std::string, std::vector<std::size_t>> waiting;  // goals by the predecessor that they wait for
    std::vector<std::size_t> missing(goals_.size()), ready;
    for (std::size_t g = 0; g < goals_.size(); ++g) {
      for (const std::string& before : splitWords(goals_[g].attribute("after"))) {
        if (!known_goals_.contains(before)) continue;  // reported by checkAfter
        waiting[before].push_back(g);
        ++missing[g];
      }
      if (missing[g] == 0) ready.push_back(g);
    }
    std::set<std::string> filled;
    while (!ready.empty()) {
      const std::string& name = names_[ready.back()];
      ready.pop_back();
      if (!filled.insert(name).second) continue;
      for (const std::size_t next : waiting[name]) {
        if (--missing[next] == 0) ready.push_back(next);
      }
    }
    for (std::size_t g = 0; g < goals_.size(); ++g) {
      if (filled.contains(names_[g])) continue;
      diagnostics_.error(kGoalLoop, goals_[g].where("after"),
                         goals_[g].label() + " can never be filled: its predecessors form a cycle",
                         "after=" + quote(goals_[g].attribute("after")));
    }
  }

  Diagnostics& diagnostics_;
  std::vector<Element> goals_;
  std::vector<std::string> bodies_, names_, elements_;
  std::set<std::string> known_bodies_, known_goals_, fixed_;
};

}  // namespace

void checkAssembly(const Element& root, Diagnostics& diagnostics) {
  for (const Element& assembly : root.children("assembly")) AssemblyCheck(root, assembly, diagnostics).run();
}

}  // namespace presa
