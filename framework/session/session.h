#pragma once
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "framework/assembly/assembly_control.h"
#include "framework/core/schedule/executor.h"
#include "framework/device/device.h"
#include "framework/record/monitor/monitor.h"
#include "framework/record/recording.h"
#include "framework/session/load_world.h"
#include "framework/session/view.h"
#include "framework/sound/sound_output.h"

namespace presa {

class PluginHost;

class DeviceOutput;
class FrameTree;
class FrameWatch;
struct FingerSafety;

/// Names and versions of the libraries that the plan's modules use: "ODE 0.16.2". Loads the plug-ins.
std::vector<std::string> engineVersions(const Plan& plan);

/// A run ready to start: plug-ins loaded, devices opened, graph built and frozen.
/// Thread: main. The executor runs graph(); everything else is read after the run, or through atomics.
class Session {
 public:
  struct Options {
    double trace_rate = 0;                      ///< samples per second for plots; 0: none
    DeviceList devices;                         ///< replay, studies: used instead of the rig's; already open
    bool open_devices = true;                   ///< false (explain): the rig's devices stay closed
    bool guide = false;                         ///< run the guide of the scene's assembly even without a view
    std::vector<std::unique_ptr<Module>> more;  ///< the program's own observer modules
    /// Wraps the rig's devices once they are open; empty: they stay as they are.
    std::function<DeviceList(DeviceList)> wrap;
  };
  /// Throws InputError with every finding.
  Session(Loaded loaded, RunControl& control, Options options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const std::shared_ptr<const World>& world() const noexcept { return world_; }
  const RunOptions& options() const noexcept { return options_; }
  const Plan& plan() const noexcept { return plan_; }
  Graph& graph() noexcept { return graph_; }
  const DeviceList& devices() const noexcept { return devices_; }
  /// Main thread, while the graph runs: reconnects each lost device. Returns the findings about devices that stay lost.
  std::vector<Diagnostic> reopenDevices(const std::atomic<bool>& stop);
  /// Notes for the user about the limits in force.
  const std::vector<std::string>& notes() const noexcept { return notes_; }
  DeviceOutput* output() noexcept { return output_; }  ///< null without devices
  const Monitor& monitor() const noexcept { return *monitor_; }
  Recorder* recorder() noexcept { return recorder_; }  ///< null when nothing is recorded
  ScheduleLog* schedule() noexcept { return schedule_.get(); }
  /// The frames of the rig; null if it has none, or if the devices are not the rig's.
  const FrameWatch* frames() const noexcept { return frame_watch_; }
  const sound::SoundOutput* sound() const noexcept { return sound_; }  ///< null without a module that is heard
  View* view() noexcept { return view_; }                              ///< null without a view
  /// The plug-in of the haptic tick that broke its contract (framework/haptics/plugin_host.h), or none. Thread: any.
  std::optional<std::string> brokenPlugin() const;
  AssemblyControl* assembly() noexcept { return assembly_; }  ///< null if nothing is assembled

  /// Start of the first scripted phase of that intent, or of that name if no intent is called so [s]; infinity if none.
  double phaseStart(const std::string& phase) const;

 private:
  void openDevices();
  void putIntoFrames(const std::vector<FingerSafety>& safety);
  void offerPointer();
  RecordedDevices recordedDevices() const;
  double releaseTime() const;  ///< as Monitor takes it [s]
  std::unique_ptr<Module> load(const PlannedModule& planned);

  std::shared_ptr<const World> world_;
  RunOptions options_;
  Plan plan_;
  DeviceList devices_;
  std::vector<std::string> notes_;
  const sound::SoundOutput* sound_ = nullptr;
  std::unique_ptr<ScheduleLog> schedule_;
  Graph graph_;
  std::shared_ptr<FrameTree> frames_;  // only if the rig has frames
  FrameWatch* frame_watch_ = nullptr;
  DeviceOutput* output_ = nullptr;
  Monitor* monitor_ = nullptr;
  Recorder* recorder_ = nullptr;
  View* view_ = nullptr;
  std::vector<const PluginHost*> plugin_hosts_;
  AssemblyControl* assembly_ = nullptr;
};

/// Only the view of a world, for a graph of the caller. Loads its plug-in; throws InputError when that fails.
std::unique_ptr<View> makeView(std::shared_ptr<const World> world, const RunOptions& options);

/// Limits of the output stages of a world's fingers, in the order of its roles. Lowered limits are reported to `notes`
/// and `findings` (safetyFor). Loads the drivers' plug-ins.
std::vector<FingerSafety> safetyOf(const World& world, const RunOptions& options, std::vector<std::string>& notes,
                                   Diagnostics& findings);

/// Instructions for the user while the devices of a run open (DevicePlugin::while_opening), one line each.
std::vector<std::string> whileOpening(const Plan& plan);

/// The drivers of a rig, checked but not opened, in the order of the plan. Findings go to `diagnostics`.
DeviceList createDevices(const std::shared_ptr<const World>& world, const RunOptions& options, const Plan& plan,
                         Diagnostics& diagnostics);

}  // namespace presa
