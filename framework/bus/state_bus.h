#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "framework/bus/samples.h"
#include "framework/scene/scene.h"

/// A bus carries the state of a run to viewers in this process, on this machine or on others. The transport is up to
/// the implementation (modules/bus_dds; LocalBus for tests). Commands travel in the opposite direction, to a run that
/// was configured to have a CommandPost.
namespace presa::bus {

/// The run's end. Thread: one, never the haptic thread; calls may allocate and may block for a few milliseconds.
class Writer {
 public:
  virtual ~Writer() = default;
  /// Call before the first publication; later viewers receive it, too.
  virtual void announce(const RunInfo& run) = 0;
  /// Returns the number of samples that had to be discarded; no viewer receives those.
  virtual std::uint64_t publish(const Snapshot& snapshot) noexcept = 0;
  virtual void publish(const Event& event) noexcept = 0;
  /// Waits briefly until viewers have confirmed everything.
  virtual void finish() noexcept = 0;
};

/// Receives arrived samples in the order of arrival; `received_ns`: arrival time, CLOCK_MONOTONIC.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void onRun(const RunInfo& run, std::int64_t received_ns) = 0;
  virtual void onObject(const ObjectSample& sample, std::int64_t received_ns) = 0;
  virtual void onFinger(const FingerSample& sample, std::int64_t received_ns) = 0;
  virtual void onFrame(const FrameSample&, std::int64_t) {}
  virtual void onHeartbeat(const Heartbeat& heartbeat, std::int64_t received_ns) = 0;
  virtual void onEvent(const Event& event, std::int64_t received_ns) = 0;
};

/// The viewer's end. Thread: one.
class Reader {
 public:
  virtual ~Reader() = default;
  /// From now on also frames of the rig: call it for a run that has some. Throws InputError E720.
  virtual void expectFrames() = 0;
  /// Passes everything that has arrived since the last call to the listener; does not wait.
  virtual void take(Listener& listener) = 0;
  /// Waits until something has arrived, at most `seconds`.
  virtual void wait(double seconds) = 0;
  /// Samples discarded because take() was not called often enough; not counted as network loss.
  virtual std::uint64_t overrun() const = 0;
};

/// The run's end for commands. Thread: one, never the haptic thread; calls may allocate.
class CommandPost {
 public:
  virtual ~CommandPost() = default;
  /// Publishes an open parameter; call again whenever its value or range changes.
  virtual void show(const OpenParameter& parameter) noexcept = 0;
  /// Commands that have arrived since the last call, addressed to any run; does not wait.
  virtual std::vector<Command> take() = 0;
  virtual void answer(const Answer& answer) noexcept = 0;
};

/// The commanding end. Thread: one. A command or its answer may be lost during discovery: repeat it until it is
/// answered.
class Commander {
 public:
  virtual ~Commander() = default;
  virtual void send(const Command& command) = 0;
  struct Replies {
    std::vector<OpenParameter> parameters;
    std::vector<Answer> answers;  ///< to any sender
  };
  /// Everything that has arrived since the last call; does not wait.
  virtual Replies take() = 0;
};

/// Open the network bus through the plug-in bus_dds, which is loaded at the first call. Throw InputError: E590 plug-in
/// not installed, E720 the network cannot be used.
std::unique_ptr<Writer> openWriter(const BusSettings& settings);
std::unique_ptr<Reader> openReader(const BusSettings& settings);
std::unique_ptr<CommandPost> openPost(const BusSettings& settings);
std::unique_ptr<Commander> openCommander(const BusSettings& settings);

}  // namespace presa::bus
