#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/graph/module.h"
#include "framework/core/schedule/timing_stats.h"
#include "framework/scene/participant_screen.h"
#include "framework/walls/canvas.h"

namespace presa {

/// Pause, speed and jumps of simulated time that the user asks for at the window. Written by the view, read by the
/// module or loop that advances time, which answers with `skip_picture`; any thread.
struct TimeControl {
  std::atomic<bool> paused{false};
  std::atomic<double> speed{1};           ///< simulated seconds per wall-clock second
  std::atomic<std::uint32_t> steps{0};    ///< number of single steps asked for while paused, since the start
  std::atomic<double> jump_to{-1};        ///< requested time in a recording [s]; the reader sets it back to -1
  std::atomic<bool> skip_picture{false};  ///< time is late: the view's next step leaves its picture of the window out
};

/// A scene that the user of a window may go on with: heading, name, and the sentence that says what it shows.
struct OfferedScene {
  std::string group, name, sentence;
};

/// What the user chose among the offered scenes, by index. `by_hand`: mouse and keys are to move its fingers.
struct SceneWish {
  std::size_t scene = 0;
  bool by_hand = false;
};

/// The picture of a run, as the application sees it: a module of the view group that draws the values of its input
/// ports. The plug-in chooses the graphics engine.
class View : public Module {
 public:
  using Module::Module;

  /// Whether the user has closed the window or pressed Esc. From any thread.
  virtual bool wantsStop() const noexcept = 0;

  /// Number of undo requests (remove the body placed last), and of inputs of any kind in the window. From any thread.
  virtual std::uint32_t undosWanted() const noexcept = 0;
  virtual std::uint32_t inputs() const noexcept = 0;
  /// Number of requests to go on to what is offered next (Space or Return in a visitor's window). From any thread.
  virtual std::uint32_t onwardsWanted() const noexcept { return 0; }

  /// The scene that the user chose in the menu, if any; then the view wants to stop, too. From any thread.
  virtual std::optional<SceneWish> sceneWanted() const noexcept { return std::nullopt; }

  /// Resolution at which the last frame's bodies were drawn, as a share of the window's width and height; below 1 to
  /// keep the frame rate. From any thread.
  virtual double sharpness() const noexcept = 0;

  /// Outcome of RunOptions::screenshot. Read it after stop().
  struct Screenshot {
    enum class Outcome { kNotAsked, kPending, kWritten, kFailed };
    Outcome outcome = Outcome::kNotAsked;
    std::string message;  ///< one sentence for the user: file, size and simulated time, or why it failed
  };
  virtual Screenshot screenshot() const = 0;

  /// Reason why the video of RunOptions::video is missing or incomplete; empty: complete, or none wanted. Read it after
  /// stop().
  virtual std::string videoTrouble() const = 0;

  /// Shows a line under the time until the next one; an alarm is red. On the thread of the view, between start() and
  /// stop().
  virtual void setBanner(const std::string& text, bool alarm) = 0;

  /// What the participant sees from the next frame on, in runs with RunOptions::participant. On the thread of the view,
  /// between start() and stop().
  virtual void setScreen(const ParticipantScreen& screen) = 0;

  /// Timings of the groups for the head-up display, by RateGroup; null for groups without one. They must outlive the
  /// view, which reads them while the groups run: the figures shown are approximate. Call before start().
  virtual void setTimings(const std::array<const GroupTiming*, kRateGroupCount>& timings) noexcept = 0;

  /// Lets mouse and keys of the window move a pair of these fingers (indices into DeviceState): the view then writes
  /// PointerState. Call before the graph is built.
  virtual void offerPointer(const std::vector<std::size_t>& fingers) = 0;

  /// Lets keys of the window move the frames of the rig (FrameWish): the view then writes PointerState. Call before the
  /// graph is built.
  virtual void offerFrames() = 0;

  /// Lets keys of the window pause and slow time through `time_control`, which must outlive the view; a length above 0
  /// [s] adds a bar for jumping within a recording. Call before start().
  virtual void offerTime(TimeControl& time_control, double length) noexcept = 0;

  /// Adds a menu of scenes to the window, with the one marked that runs. The window then stays open for the next run of
  /// the process. Call before start().
  virtual void offerScenes(const std::vector<OfferedScene>& /*scenes*/, std::size_t /*now*/) {}

  /// Draws one wall of a CAVE in place of a camera's picture, in every step: without head-up display, for the eyes that
  /// `canvas` has then. It must outlive the view. Call before start().
  virtual void drawOnWall(walls::Canvas& canvas) noexcept = 0;

  /// Handles input and draws the last state again while time is paused. On the thread of the view.
  virtual void refresh() noexcept = 0;
};

}  // namespace presa
