#pragma once
#include <array>
#include <string>

#include "framework/graph/module.h"
#include "framework/schedule/timing_stats.h"

namespace presa {

/// The picture of a run, as the application sees it: a module of the view group that draws what its ports bring.
/// Which engine draws is the plug-in's matter.
class View : public Module {
 public:
  using Module::Module;

  /// The user closed the window or pressed Esc. May be asked from any thread.
  virtual bool wantsStop() const noexcept = 0;

  /// How often the user has asked to take out again what was put last, and has done anything at all in the window. From any thread.
  virtual std::uint32_t undosWanted() const noexcept = 0;
  virtual std::uint32_t inputs() const noexcept = 0;

  /// What became of RunOptions::screenshot. Ask after stop().
  struct Screenshot {
    enum class Outcome { kNotAsked, kPending, kWritten, kFailed };
    Outcome outcome = Outcome::kNotAsked;
    std::string message;  ///< one sentence for the user: file, size and simulated time, or why it failed
  };
  virtual Screenshot screenshot() const = 0;

  /// A line under the time, until the next one; an alarm is red. On the thread of the view, between start() and stop().
  virtual void setBanner(const std::string& text, bool alarm) = 0;

  /// Timing of the groups for the head-up display, by RateGroup; null where there is none. They must outlive the view.
  /// Read while the groups run, so the figures shown are approximate. Call before start().
  virtual void setTimings(const std::array<const GroupTiming*, kRateGroupCount>& timings) noexcept = 0;
};

}  // namespace presa
