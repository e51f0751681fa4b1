#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/run_result.h"
#include "framework/bus/guide_desk.h"
#include "framework/bus/parameter_server.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/session/realtime_rights.h"
#include "framework/session/run.h"

namespace presa {

/// A run that a user attends at a terminal: status line, Ctrl-C, re-arming by key, faults and notes, result. Thread:
/// main.
class TerminalRun {
 public:
  struct Settings {
    double trace_rate = 0;                  ///< samples per second kept for plots
    bool quiet = false;                     ///< no status line
    std::string command;                    ///< command line, for the report
    Diagnostics found = {};                 ///< warnings of the load, for report and summary
    double speed = 1;                       ///< lockstep with a window: simulated seconds per wall-clock second
    bool paced = false;                     ///< lockstep without a window: keep `speed`, too
    bool guide = false;                     ///< as Session::Options::guide
    std::vector<OfferedScene> scenes = {};  ///< menu of the window; empty: none
    std::size_t scene = 0;                  ///< the one of them that runs
    RealtimeProbe rights = realtimeRights;
    std::vector<std::unique_ptr<Module>> more = {};   ///< the command's own observer modules
    std::function<DeviceList(DeviceList)> wrap = {};  ///< as Session::Options::wrap
    /// Called with every poll; `key` was pressed on the terminal, 0: none. False ends the run.
    std::function<bool(Session& session, char key)> watch = {};
  };
  /// Builds the session, with progress where that takes long. Throws InputError before anything is written, and
  /// WorkStopped after Ctrl-C meanwhile.
  TerminalRun(Loaded loaded, Settings settings);
  ~TerminalRun();

  /// Runs to the end, or until Ctrl-C (forces fade first). Rethrows exceptions of Module::start().
  void execute();
  /// What the user chose in the menu of scenes.
  std::optional<SceneWish> wish() const noexcept;
  /// Whether somebody stopped the run before its end.
  bool stopped() const noexcept { return control_.stop_requested; }
  /// The results. Valid as long as this object.
  const RunResult& result() const noexcept { return result_; }

 private:
  void poll();
  void showStatus();
  void finish();
  void noteBrokenPlugin();
  void noteObjectFaults();
  void noteFrames();
  void takeFrames();
  void fail(double time, std::string what);
  void rearm();
  void offerToCommands();
  void noteModules();
  void noteCommands();
  void noteGuide();
  const char* answerToSignal() const;
  void awaitGuide();

  std::vector<std::unique_ptr<Module>> observers(const Loaded& loaded);
  void offerToView();

  Settings settings_;
  RunControl control_;
  TimeControl time_control_;
  bool paced_ = false;
  View* view_ = nullptr;
  bus::ParameterServer* server_ = nullptr;  // receives commands from the bus; null: none
  std::function<void(double)> while_held_;  // lockstep: reads commands while the run is paused
  bus::GuideDesk* desk_ = nullptr;          // receives orders of a guide in a viewer; null: none
  double undone_ = 0;                       // number of undos by commands
  struct Live;
  std::unique_ptr<Live> live_;
  std::unique_ptr<Run> run_;
  RunResult result_;
  int watchdog_trips_ = 0;
  bool device_lost_ = false;  // since the last re-arm
  std::uint32_t reported_object_faults_ = 0;
  bool effect_reported_ = false;
};

}  // namespace presa
