#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/bus/sequence_watch.h"
#include "framework/bus/state_bus.h"
#include "framework/scene/world.h"
#include "framework/core/schedule/timing_stats.h"
#include "framework/core/state/object_state.h"

namespace presa::bus {

/// What a viewer knows of a run elsewhere: it takes what arrives, in whatever order and as often as it does, and shows the states
/// one period behind the newest, where they can be interpolated. It follows one run until that ends or is silent, then the next.
/// Thread: one.
class RemotePicture final : public Listener {
 public:
  /// Nothing for so long: the picture is frozen [s].
  static constexpr double kSilence = 0.25;

  enum class State : std::uint8_t {
    kWaiting,  ///< no run yet
    kLive,
    kFrozen,  ///< silent: the last state stands
    kEnded,   ///< the run said so
  };

  /// `world`: what the viewer draws. Samples of a run with another scene hash are not shown (wrongScene).
  explicit RemotePicture(const World& world);

  void onRun(const RunInfo& run, std::int64_t received_ns) override;
  void onObject(const ObjectSample& sample, std::int64_t received_ns) override;
  void onFinger(const FingerSample& sample, std::int64_t received_ns) override;
  void onBeat(const Beat& beat, std::int64_t received_ns) override;
  void onEvent(const Event& event, std::int64_t received_ns) override;

  /// To that instant of CLOCK_MONOTONIC; after everything that arrived before it.
  void advance(std::int64_t now_ns) noexcept;

  State state() const noexcept { return state_; }
  bool wrongScene() const noexcept { return wrong_scene_; }
  /// Simulated time of the picture [s].
  double time() const noexcept { return time_; }
  /// Of the picture: every body, and every finger of which something has arrived.
  void fill(ObjectState& objects, DeviceState& device, ContactExchange& contact, ForceCommand& command) const noexcept;

  struct Health {
    std::uint64_t received = 0;  ///< samples of objects, fingers and beats, each once
    std::uint64_t lost = 0, doubled = 0, late = 0;
    std::uint64_t refused = 0;      ///< lost on the sender's side already
    std::uint64_t resumed = 0;      ///< times the bus came back
    std::uint64_t strays = 0;       ///< numbers or times far from all others, not believed: damaged or forged
    std::uint64_t other_scene = 0;  ///< samples of a run with another scene
    double silent = 0;              ///< since the last sample [s]
    double behind = 0;              ///< from the newest state that is known to the one shown [s]
  };
  Health health() const noexcept;
  /// Of each sample from sender to here [ns]; means something on one machine.
  const DurationHistogram& latency() const noexcept { return latency_; }
  /// For the screen: state, age and loss; in words, one line.
  std::string line() const;
  /// Something is wrong that the line should be red for.
  bool alarm() const noexcept { return wrong_scene_ || state_ == State::kFrozen || !last_event_.empty(); }

 private:
  static constexpr std::size_t kKept = 64;  // publications: 0.3 s
  template <class Sample>
  struct Track {
    SequenceWatch watch;
    std::array<Sample, kKept> kept;  // by sequence
    /// Newest not after the time, and the one after it; null: there is none.
    std::pair<const Sample*, const Sample*> around(double time) const noexcept;
  };

  bool follows(const Stamp& stamp, std::int64_t received_ns) noexcept;
  template <class Sample>
  /// False: not believed.
  bool keep(Track<Sample>& track, const Sample& sample, std::int64_t received_ns) noexcept;
  void beginRun(const RunInfo& run) noexcept;
  bool isTimely(const Stamp& stamp, std::int64_t received_ns) const noexcept;
  void noteArrival(const Stamp& stamp, std::int64_t received_ns) noexcept;
  Pose poseOf(std::size_t body) const noexcept;

  std::vector<Pose> start_;  // as Scene::bodies
  std::uint64_t hash_;
  std::int32_t finger_count_;
  State state_ = State::kWaiting;
  bool wrong_scene_ = false;
  RunInfo run_;      // followed
  RunInfo waiting_;  // announced, while another is followed
  std::vector<Track<ObjectSample>> objects_;
  std::array<Track<FingerSample>, kMaxFingers> fingers_;
  Track<Beat> beats_;
  Health counted_;
  DurationHistogram latency_;
  std::int64_t last_arrival_ns_ = 0, now_ns_ = 0;
  bool clock_known_ = false;
  double offset_ = 0;  // local clock less simulated time, for the samples that came fastest [s]
  double offset_time_ = 0;
  double time_ = 0, newest_ = 0;
  std::string last_event_;
};

}  // namespace presa::bus
