#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/bus/sequence_watch.h"
#include "framework/bus/state_bus.h"
#include "framework/core/schedule/timing_stats.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/world.h"

namespace presa::bus {

/// The viewer's copy of a remote run. Accepts samples in any order and any number of times, and shows states one period
/// behind the newest, where they can be interpolated. Follows one run until it ends or falls silent, then the next.
/// Thread: one.
class RemotePicture final : public Listener {
 public:
  /// Time without samples after which the picture is frozen [s].
  static constexpr double kSilence = 0.25;

  enum class State : std::uint8_t {
    kWaiting,  ///< no run yet
    kLive,
    kFrozen,  ///< no samples: the last state is shown
    kEnded,   ///< the run announced its end
  };

  /// `world`: the scene that the viewer draws. Samples of a run with another scene hash are not shown (wrongScene).
  explicit RemotePicture(const World& world);

  void onRun(const RunInfo& run, std::int64_t received_ns) override;
  void onObject(const ObjectSample& sample, std::int64_t received_ns) override;
  void onFinger(const FingerSample& sample, std::int64_t received_ns) override;
  void onFrame(const FrameSample& sample, std::int64_t received_ns) override;
  void onHeartbeat(const Heartbeat& heartbeat, std::int64_t received_ns) override;
  void onEvent(const Event& event, std::int64_t received_ns) override;

  /// Advances the picture to `now_ns` (CLOCK_MONOTONIC). Call it after delivering everything that arrived before that
  /// time.
  void advance(std::int64_t now_ns) noexcept;

  /// Shows the state at another simulated time, until the next advance(): that of a frame which several viewers draw.
  void showAt(double time) noexcept { time_ = time; }
  /// Time of the newest sample [s].
  double newest() const noexcept { return newest_; }
  std::uint64_t run() const noexcept { return run_.run; }
  /// Stamp::sequence of the newest heartbeat; 0: none yet.
  std::uint64_t sequence() const noexcept { return heartbeats_.watch.highest(); }

  State state() const noexcept { return state_; }
  bool wrongScene() const noexcept { return wrong_scene_; }
  /// Simulated time of the picture [s].
  double time() const noexcept { return time_; }
  /// The states of the picture: every body, and every finger from which a sample has arrived.
  void fill(ObjectState& objects, DeviceState& device, ContactExchange& contact, ForceCommand& command) const noexcept;

  /// The frames of the rig; none before the first samples, and of a run whose rig has others than the viewer's world.
  void fill(FrameState& frames) const;

  struct Health {
    std::uint64_t received = 0;  ///< samples of objects, fingers, frames and heartbeats, without duplicates
    std::uint64_t lost = 0, doubled = 0, late = 0;
    std::uint64_t refused = 0;      ///< discarded by the sender
    std::uint64_t resumed = 0;      ///< number of times that the bus came back
    std::uint64_t strays = 0;       ///< ignored samples with implausible numbers or times: damaged or forged
    std::uint64_t other_scene = 0;  ///< samples of a run with another scene
    double silent = 0;              ///< time since the last sample [s]
    double behind = 0;              ///< age of the shown state relative to the newest [s]
  };
  Health health() const noexcept;
  /// Transport delay of the samples [ns]; meaningful only on one machine.
  const DurationHistogram& latency() const noexcept { return latency_; }
  /// State, age and loss in one line, for the screen.
  std::string line() const;
  /// Whether line() reports a problem and should be shown in red.
  bool alarm() const noexcept { return wrong_scene_ || state_ == State::kFrozen || !last_event_.empty(); }

 private:
  static constexpr std::size_t kKept = 64;  // publications: about 0.3 s
  template <class Sample>
  struct Track {
    SequenceWatch watch;
    std::array<Sample, kKept> kept;  // by sequence
    /// The newest sample not after `time`, and the one after it; null where there is none.
    std::pair<const Sample*, const Sample*> around(double time) const noexcept;
  };

  bool follows(const Stamp& stamp, std::int64_t received_ns) noexcept;
  template <class Sample>
  /// False: the sample was ignored as implausible.
  bool keep(Track<Sample>& track, const Sample& sample, std::int64_t received_ns) noexcept;
  void beginRun(const RunInfo& run) noexcept;
  bool isTimely(const Stamp& stamp, std::int64_t received_ns) const noexcept;
  void noteArrival(const Stamp& stamp, std::int64_t received_ns) noexcept;
  Pose poseOf(std::size_t body) const noexcept;

  std::vector<Pose> start_;  // by body of the scene
  std::uint64_t hash_;
  std::vector<RigFrame> rig_;  // frames of the viewer's world
  State state_ = State::kWaiting;
  bool wrong_scene_ = false;
  RunInfo run_;      // the run that is followed
  RunInfo waiting_;  // announced while another run is followed
  std::vector<Track<ObjectSample>> objects_;
  std::vector<Track<FingerSample>> fingers_;
  std::vector<Track<FrameSample>> frames_;
  Track<Heartbeat> heartbeats_;
  Health counted_;
  DurationHistogram latency_;
  std::int64_t last_arrival_ns_ = 0, now_ns_ = 0;
  bool clock_known_ = false;
  double offset_ = 0;  // local clock minus simulated time, for the fastest samples [s]
  double offset_time_ = 0;
  double time_ = 0, newest_ = 0;
  std::string last_event_;
};

}  // namespace presa::bus
