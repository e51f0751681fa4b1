#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/assembly/assembly_state.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/scene.h"

namespace presa {

/// An event during an assembly task. Times are simulated.
struct GuideEvent {
  enum class Kind : std::uint8_t { kTaken, kPlaced, kUndone, kDropped, kBlocked, kHint, kFinished };
  Kind kind = Kind::kTaken;
  double time = 0;              ///< [s]
  std::int32_t goal = kNoGoal;  ///< for placed, undone, blocked and hint
  std::int32_t body = kNoBody;
};

/// What the user should be told now. Goals and bodies are indices into the scene's.
struct Guidance {
  std::int32_t placed = 0, all = 0;
  std::int32_t body = kNoBody;       ///< body that fingers touch, or touched within kLinger
  bool held = false;                 ///< by two fingers, or by the only one
  std::int32_t goal = kNoGoal;       ///< nearest free goal of the held body
  std::int32_t blocked = kNoGoal;    ///< goal of the held body that must wait for `missing`
  std::int32_t missing = kNoGoal;    ///< goal that must be filled first
  std::int32_t hint_goal = kNoGoal;  ///< after hesitation: suggested goal
  std::int32_t hint_body = kNoBody;  ///< and the suggested body for it
  std::optional<GuideEvent> news;    ///< last placed, undone or dropped event within kNews
  bool finished = false;             ///< all goals are filled, and the user touched something
  double finished_at = 0;            ///< [s]
  double elapsed = 0;                ///< time from first touch to completion, plus that of earlier runs [s]
};

/// Follows an assembly task and derives guidance. Deterministic: equal states give equal guidance, to the bit.
class AssemblyGuide {
 public:
  explicit AssemblyGuide(const Assembly& assembly, std::size_t bodies);

  /// Before the first step, where another guide has led: what stands was placed before, and hesitation begins now.
  /// Indices of filled goals must name bodies.
  void resume(const AssemblyState& assembly);
  /// `time`: simulated time of the states [s]; must not decrease.
  void step(double time, const ObjectState& objects, const AssemblyState& assembly, const ContactExchange& contacts);
  const Guidance& now() const noexcept { return now_; }
  /// Events of the last step, in order.
  const std::vector<GuideEvent>& events() const noexcept { return events_; }

  static constexpr double kHesitation = 20;    ///< time without progress after which a hint is given [s]
  static constexpr double kLinger = 0.6;       ///< time for which a released body stays the subject [s]
  static constexpr double kNews = 4;           ///< time for which an event is shown [s]
  static constexpr double kTouchForce = 0.05;  ///< smallest normal force that counts as touch [N]
  static constexpr double kLifted = 0.02;      ///< height above the place of grasping that counts as lifted [m]
  static constexpr double kFalls = 0.5;        ///< downward speed that counts as falling [m/s]

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
  std::vector<std::int32_t> stands_;  // by goal: the body that fills it
  std::vector<char> touched_;         // by body: touched since the start
  std::vector<char> touching_;        // by body: fingers on it now
  std::vector<double> taken_at_;      // by body: height at which it was grasped [m]; kNotTaken
  std::int32_t last_held_ = kNoBody, attempted_ = kNoGoal;
  double time_ = 0, let_go_ = 0, progress_at_ = 0;
  std::optional<double> begun_;
  Guidance now_;
  std::vector<GuideEvent> events_;
};

}  // namespace presa
