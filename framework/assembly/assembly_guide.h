#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/scene/scene.h"
#include "framework/assembly/assembly_state.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"

namespace presa {

/// Something that happened while an assembly was put together. Times are simulated.
struct GuideEvent {
  enum class Kind : std::uint8_t { kTaken, kPlaced, kUndone, kDropped, kBlocked, kHint, kFinished };
  Kind kind = Kind::kTaken;
  double time = 0;              ///< [s]
  std::int32_t goal = kNoGoal;  ///< placed, undone, blocked, hint
  std::int32_t body = kNoBody;
};

/// What to tell now. Goals and bodies are indices into the scene's.
struct Guidance {
  std::int32_t placed = 0, all = 0;
  std::int32_t body = kNoBody;       ///< that fingers touch, or touched a moment ago
  bool held = false;                 ///< by two fingers, or by the only one there is
  std::int32_t goal = kNoGoal;       ///< where the held body may go now, the nearest
  std::int32_t blocked = kNoGoal;    ///< where it would go, were it not for `missing`
  std::int32_t missing = kNoGoal;    ///< goal that has to be filled first
  std::int32_t hint_goal = kNoGoal;  ///< after hesitation: fill this one …
  std::int32_t hint_body = kNoBody;  ///< … with this body
  std::optional<GuideEvent> news;    ///< placed, undone or dropped not long ago
  bool finished = false;             ///< all stands, and people had a hand in it
  double finished_at = 0;            ///< [s]
  double spent = 0;                  ///< since the first touch, until all stood, with what earlier runs took [s]
};

/// Watches an assembly as people put it together. The same states give the same guidance, in lockstep to the bit.
class AssemblyGuide {
 public:
  explicit AssemblyGuide(const Assembly& assembly, std::size_t bodies);

  /// `time`: of the states; never goes back.
  void step(double time, const ObjectState& objects, const AssemblyState& assembly, const ContactExchange& contacts);
  const Guidance& now() const noexcept { return now_; }
  /// What happened in the last step, in order.
  const std::vector<GuideEvent>& events() const noexcept { return events_; }

  static constexpr double kHesitation = 20;    ///< without anything placed or taken out: a hint is due [s]
  static constexpr double kLinger = 0.6;       ///< a body that was let go is still spoken of [s]
  static constexpr double kNews = 4;           ///< what happened is told for so long [s]
  static constexpr double kTouchForce = 0.05;  ///< below it nothing is touched [N]
  static constexpr double kLifted = 0.02;      ///< above where it was taken [m]
  static constexpr double kFalls = 0.5;        ///< [m/s]

 private:
  void noteFingers(const ObjectState& objects, const ContactExchange& contacts);
  void noteGoals(const AssemblyState& assembly);
  void noteFall(std::size_t body, const ObjectState& objects);
  void choosePlace(const ObjectState& objects, const AssemblyState& assembly);
  void chooseHint(const ObjectState& objects, const AssemblyState& assembly);
  void tell(GuideEvent::Kind kind, std::int32_t goal, std::int32_t body);
  std::int32_t missing(std::size_t goal, const AssemblyState& assembly) const;
  std::int32_t nearestPlace(std::int32_t body, bool free, const ObjectState& objects,
                            const AssemblyState& assembly) const;

  const Assembly& assembly_;
  std::vector<char> stood_;           // by goal: filled after the last step
  std::vector<std::int32_t> stands_;  // by goal: what fills it
  std::vector<char> touched_;         // by body: since the start
  std::vector<char> touching_;        // by body: fingers on it now
  std::vector<double> taken_at_;      // by body: height where it was taken [m]; kNotTaken
  std::int32_t last_held_ = kNoBody, attempted_ = kNoGoal;
  double time_ = 0, let_go_ = 0, progress_at_ = 0;
  std::optional<double> begun_;
  Guidance now_;
  std::vector<GuideEvent> events_;
};

}  // namespace presa
