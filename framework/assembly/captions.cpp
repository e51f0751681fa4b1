#include "framework/assembly/captions.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

using Kind = GuideEvent::Kind;

const AssemblyWords::Element* elementOf(const Assembly& assembly, std::int32_t goal) {
  if (goal < 0 || static_cast<std::size_t>(goal) >= assembly.goals.size()) return nullptr;
  const std::size_t element = assembly.goals[static_cast<std::size_t>(goal)].element;
  return element == kNoElement ? nullptr : &assembly.words.elements[element];
}

std::int32_t goalOf(const Assembly& assembly, std::int32_t body) {
  const auto found = std::ranges::find_if(assembly.goals, [&](const AssemblyGoal& goal) {
    return std::ranges::find(goal.bodies, static_cast<std::size_t>(body)) != goal.bodies.end();
  });
  return found == assembly.goals.end() ? kNoGoal : static_cast<std::int32_t>(found - assembly.goals.begin());
}

/// A sentence about an element: its first one, and then its stories, one further for each body in its place.
const std::string& sentenceOf(const AssemblyWords::Element& element, std::int32_t placed) {
  const std::size_t turn = static_cast<std::size_t>(std::max(placed, 0)) % (element.stories.size() + 1);
  return turn == 0 ? element.says : element.stories[turn - 1].says;
}

std::string newsText(const Scene& scene, const GuideEvent& event) {
  const AssemblyWords& words = scene.assembly->words;
  const std::string& phrase = event.kind == Kind::kPlaced   ? words.placed
                              : event.kind == Kind::kUndone ? words.undone
                                                            : words.dropped;
  return fillIn(phrase, "element", calledBody(scene, event.body));
}

}  // namespace

std::string calledGoal(const Assembly& assembly, std::int32_t goal) {
  if (const AssemblyWords::Element* element = elementOf(assembly, goal)) return element->called;
  return assembly.goals[static_cast<std::size_t>(goal)].name;
}

std::string calledBody(const Scene& scene, std::int32_t body) {
  const std::int32_t goal = goalOf(*scene.assembly, body);
  if (const AssemblyWords::Element* element = elementOf(*scene.assembly, goal)) return element->called;
  return scene.bodies[static_cast<std::size_t>(body)].name;
}

std::string durationText(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  const std::string rest = std::to_string(whole % 60) + " s";
  return whole < 60 ? rest : std::to_string(whole / 60) + " min " + rest;
}

Captions captionsOf(const Scene& scene, const Guidance& guidance) {
  const Assembly& assembly = *scene.assembly;
  const AssemblyWords& words = assembly.words;
  Captions captions;
  captions.progress =
      fillIn(fillIn(words.progress, "count", std::to_string(guidance.placed)), "all", std::to_string(guidance.all));
  if (guidance.news) captions.news = newsText(scene, *guidance.news);
  captions.good = guidance.news && guidance.news->kind == Kind::kPlaced;
  if (guidance.finished) {
    captions.finish = words.finished;
    captions.took = fillIn(words.took, "time", durationText(guidance.elapsed));
    return captions;
  }
  // bodies without a goal, such as the ground, get no title
  const std::int32_t subject = guidance.body == kNoBody && guidance.news ? guidance.news->body : guidance.body;
  const std::int32_t goal = subject == kNoBody ? kNoGoal : goalOf(assembly, subject);
  if (goal != kNoGoal) {
    captions.title = calledBody(scene, subject);
    if (const AssemblyWords::Element* element = elementOf(assembly, goal)) {
      // while the news of a placed body is shown, the sentence stays
      const std::int32_t told = guidance.placed - (captions.good && guidance.body == kNoBody ? 1 : 0);
      captions.sentence = sentenceOf(*element, told);
    }
  }
  if (guidance.blocked != kNoGoal) {
    const AssemblyWords::Element* element = elementOf(assembly, guidance.blocked);
    captions.reason = element != nullptr && !element->waits.empty()
                          ? element->waits
                          : fillIn(words.next, "element", calledGoal(assembly, guidance.missing));
  }
  if (guidance.hint_goal != kNoGoal)
    captions.hint = fillIn(words.next, "element", calledGoal(assembly, guidance.hint_goal));
  return captions;
}

}  // namespace presa
