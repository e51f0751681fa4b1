#pragma once
#include <atomic>
#include <memory>
#include <optional>

#include "framework/assembly/guide_module.h"
#include "framework/core/graph/port.h"
#include "framework/core/state/finger_neighbourhood.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/frame_state.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"
#include "framework/session/view.h"
#include "modules/view_osg/frame_keys.h"
#include "modules/view_osg/plugin_parts.h"
#include "modules/view_osg/renderer.h"
#include "modules/view_osg/video.h"

namespace presa::view {

/// The view module. Off-screen it only copies the states until the picture is due; in a window every step draws a
/// frame.
/// Thread: view; may allocate; nothing waits for it.
class ViewModule final : public View {
 public:
  ViewModule(std::shared_ptr<const World> world, const RunOptions& options);
  ~ViewModule() override;

  /// Opens the window or the off-screen context. Throws InputError when that fails.
  void start() override;
  void step(const Tick& tick) noexcept override;
  void stop() override;
  std::vector<std::string> stages() const override;

  bool wantsStop() const noexcept override { return wants_stop_.load(std::memory_order_relaxed); }
  std::uint32_t undosWanted() const noexcept override { return undos_.load(std::memory_order_relaxed); }
  std::uint32_t inputs() const noexcept override { return inputs_.load(std::memory_order_relaxed); }
  std::optional<SceneWish> sceneWanted() const noexcept override;
  std::uint32_t onwardsWanted() const noexcept override { return onwards_.load(std::memory_order_relaxed); }
  double sharpness() const noexcept override { return sharpness_.load(std::memory_order_relaxed); }
  Screenshot screenshot() const override { return screenshot_; }
  std::string videoTrouble() const override { return video_trouble_; }
  void setBanner(const std::string& text, bool alarm) override;
  void setScreen(const ParticipantScreen& screen) override;
  void setTimings(const GroupTimings& timings) noexcept override { timings_ = timings; }
  void offerPointer(const std::vector<std::size_t>& fingers) override;
  void offerFrames() override;
  void offerScenes(const std::vector<OfferedScene>& scenes, std::size_t now) override {
    scenes_ = scenes, scene_ = now;
  }
  void offerTime(TimeControl& time_control, double length) noexcept override;
  void refresh() noexcept override;
  void drawOnWall(walls::Canvas& canvas) noexcept override { canvas_ = &canvas; }

 private:
  std::unique_ptr<Renderer> makeRenderer();
  bool windowed() const { return options_.view == RunOptions::View::kWindow; }
  void copyPorts(const Tick& tick);
  void follow();
  void drawRuins();
  void drawWindow();
  void show();
  bool screenshotDue() const;
  void film();
  void saveSeries();
  void saveScreenshot();
  std::string savePicture(const std::string& file);
  void giveUp(const std::string& why) noexcept;

  std::shared_ptr<const World> world_;
  const RunOptions options_;
  In<DeviceState> device_state_{*this, "device_state", In<DeviceState>::Optional{}};
  In<ContactExchange> contact_exchange_{*this, "contact_exchange", In<ContactExchange>::Optional{}};
  In<ForceCommand> force_command_{*this, "force_command", In<ForceCommand>::Optional{}};
  In<ObjectState> object_state_{*this, "object_state", In<ObjectState>::Optional{}};

  std::optional<In<FingerNeighbourhoods>> neighbourhoods_;  ///< only if neighbourhoods may be shown
  std::optional<Out<PointerState>> pointer_out_;            ///< only with a pointer device or frames that a user moves
  std::optional<PointerControl> pointer_;
  std::optional<FrameKeys> frame_keys_;   ///< only where the rig has frames that a user moves
  std::optional<In<ToolStates>> tools_;   ///< only where the scene has tools
  std::optional<In<FrameState>> frames_;  ///< only where the rig has frames
  TimeControl* time_ = nullptr;
  walls::Canvas* canvas_ = nullptr;   ///< only on a wall
  std::vector<OfferedScene> scenes_;  ///< of the menu; empty: none
  std::size_t scene_ = 0;             ///< the one that runs
  double length_ = 0;                 ///< length of the recording [s]; 0: a run
  In<JointPositions> joint_positions_{*this, kJointPositionsPort, In<JointPositions>::Optional{}};
  In<GuideState> guidance_{*this, "guidance", In<GuideState>::Optional{}};

  ViewFrame frame_;
  double next_picture_ = 0;  // next time for RunOptions::screenshots [s]
  GroupTimings timings_{};
  std::unique_ptr<PluginParts> plugin_parts_;  // only if the scene names some
  std::unique_ptr<Picture> picture_;
  std::unique_ptr<Renderer> renderer_;
  Screenshot screenshot_;
  std::optional<Video> video_;
  std::string video_trouble_;
  std::atomic<bool> wants_stop_{false};
  std::atomic<std::uint32_t> undos_{0}, onwards_{0}, inputs_{0};
  std::atomic<double> sharpness_{1};
  std::atomic<std::int64_t> wish_{-1};  ///< twice the index of the wanted scene, plus one if by hand; negative: none
  bool broken_ = false;                 ///< drawing failed: the run continues without pictures
};

}  // namespace presa::view
