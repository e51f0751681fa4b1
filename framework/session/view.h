#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/graph/module.h"
#include "framework/core/schedule/timing_stats.h"

namespace presa {

/// What somebody at the window asks of simulated time. Written by the view, read by whoever steps it; any thread.
struct TimeWish {
  std::atomic<bool> paused{false};
  std::atomic<double> speed{1};         ///< simulated seconds in a second
  std::atomic<std::uint32_t> steps{0};  ///< single steps asked for since the start, while paused
  std::atomic<double> jump_to{-1};      ///< a moment of a recording [s]; who goes there sets it to -1
};

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

  /// Share of the window's width and height in which the last frame's bodies were drawn, so that frames come in time; 1: all of it.
  /// From any thread.
  virtual double sharpness() const noexcept = 0;

  /// What became of RunOptions::screenshot. Ask after stop().
  struct Screenshot {
    enum class Outcome { kNotAsked, kPending, kWritten, kFailed };
    Outcome outcome = Outcome::kNotAsked;
    std::string message;  ///< one sentence for the user: file, size and simulated time, or why it failed
  };
  virtual Screenshot screenshot() const = 0;

  /// Why RunOptions::video is not, or not wholly, there; empty: it is, or nobody asked. Ask after stop().
  virtual std::string videoTrouble() const = 0;

  /// A line under the time, until the next one; an alarm is red. On the thread of the view, between start() and stop().
  virtual void setBanner(const std::string& text, bool alarm) = 0;

  /// Timing of the groups for the head-up display, by RateGroup; null where there is none. They must outlive the view.
  /// Read while the groups run, so the figures shown are approximate. Call before start().
  virtual void setTimings(const std::array<const GroupTiming*, kRateGroupCount>& timings) noexcept = 0;

  /// Mouse and keys of the window move a pair of these fingers (as DeviceState): from then on the view writes PointerState. Call
  /// before the graph is built.
  virtual void offerPointer(const std::vector<std::size_t>& fingers) = 0;

  /// Keys of the window hold and slow time, by `wish`, which must outlive the view; with a length [s] there is a bar to move about
  /// in a recording, too. Call before start().
  virtual void offerTime(TimeWish& wish, double length) noexcept = 0;

  /// Handles input and draws what was shown last, for while time is held. On the thread of the view.
  virtual void refresh() noexcept = 0;
};

}  // namespace presa
