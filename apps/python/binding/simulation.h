#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/python/binding/moved_finger.h"
#include "apps/python/binding/snapshot.h"
#include "framework/session/run.h"

namespace presa::python {

/// What a simulation is made of.
struct Setup {
  std::string scene;              ///< file; with `text` only its name in messages
  std::string text;               ///< the scene itself; empty: it stands in the file
  std::string rig;                ///< file; empty: the rig that the scene names
  std::vector<std::string> sets;  ///< PATH=VALUE
  /// Start positions of the fingers by role [m], all of the scene or none. None: the devices of the rig move them.
  std::map<std::string, std::array<double, 3>> fingers;
  std::uint64_t seed = 1;
  double duration = 0;  ///< [s]; 0: to the end of the rig's script, or kEndless where the caller moves the fingers
  std::string record;   ///< HDF5 file; empty: none
  bool overwrite = false;
};

/// A run in lockstep that its caller steps. Bit for bit the same as `presa run --lockstep` of the same scene, rig, seed
/// and duration. Thread: one at a time; step() and close() refuse a second one, and a call from within `pause`.
class Simulation {
 public:
  static constexpr double kEndless = 1e6;  ///< [s]

  /// Throws InputError with every finding.
  explicit Simulation(const Setup& setup);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Runs so many haptic ticks, or up to the end: then false. Moved fingers are at their targets in the last tick. `pause`
  /// is called every kPauseTicks ticks; what it throws ends the step. Throws std::logic_error while another step runs,
  /// and once closed; what a module throws as the run begins, closes the simulation.
  bool step(
      std::uint64_t ticks, const std::function<void()>& pause = [] {});
  /// Ends the run and closes the recording; further calls do nothing. Throws std::logic_error while a step runs.
  void close();

  const World& world() const noexcept { return run_->world(); }
  const Snapshot& snapshot() const noexcept { return snapshot_; }
  /// Where each moved finger is to be after the next step [m]; no rows if the rig's devices move them.
  Snapshot::Rows3& targets() noexcept { return targets_; }
  /// Bits of its buttons from the next tick on. Throws std::logic_error if the rig's device moves it.
  void press(std::size_t finger, std::uint32_t buttons);
  double time() const noexcept { return control_.time; }
  double tick() const noexcept { return run_->executor().rates().period(RateGroup::kHaptic); }
  bool done() const noexcept { return left_ == 0; }
  const Monitor& monitor() const noexcept { return run_->monitor(); }
  /// Warnings and notes of the load, one a line.
  const std::vector<std::string>& notes() const noexcept { return notes_; }

  static constexpr std::uint64_t kPauseTicks = 1000;

 private:
  struct Read {
    Loaded loaded;
    std::vector<std::string> notes;
  };
  class Turn;
  static Read read(const Setup& setup);
  Simulation(const Setup& setup, Read read);
  void begin();
  void end();

  RunControl control_;
  std::vector<std::string> notes_;
  std::vector<MovedFinger*> moved_;  // owned by the session
  Snapshot::Rows3 targets_;
  Snapshot snapshot_;
  SnapshotTap* tap_ = nullptr;
  std::unique_ptr<Run> run_;
  std::uint64_t left_ = 0;  // haptic ticks
  bool begun_ = false, closed_ = false;
  std::atomic_flag busy_;
};

}  // namespace presa::python
