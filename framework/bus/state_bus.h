#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "framework/bus/samples.h"
#include "framework/scene/scene.h"

/// A bus carries the state of a run to viewers, in this process, on this machine or on others. What carries it is the
/// implementation's matter (modules/bus_dds; LocalBus for tests). What comes back are commands, where a run has a CommandPost; none has
/// one that was not told to.
namespace presa::bus {

/// The side of the run. Thread: one, never the haptic thread; calls may allocate and may block for a few milliseconds.
class Writer {
 public:
  virtual ~Writer() = default;
  /// Before the first publication; who joins later gets it, too.
  virtual void announce(const RunInfo& run) = 0;
  /// Samples that could not be taken in; they are lost to every viewer.
  virtual std::uint64_t publish(const Snapshot& snapshot) noexcept = 0;
  virtual void publish(const Event& event) noexcept = 0;
  /// Waits a moment for what viewers have not confirmed yet.
  virtual void finish() noexcept = 0;
};

/// Who is told what arrived, in the order of arrival; `received_ns`: CLOCK_MONOTONIC when it did.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void onRun(const RunInfo& run, std::int64_t received_ns) = 0;
  virtual void onObject(const ObjectSample& sample, std::int64_t received_ns) = 0;
  virtual void onFinger(const FingerSample& sample, std::int64_t received_ns) = 0;
  virtual void onBeat(const Beat& beat, std::int64_t received_ns) = 0;
  virtual void onEvent(const Event& event, std::int64_t received_ns) = 0;
};

/// The side of a viewer. Thread: one.
class Reader {
 public:
  virtual ~Reader() = default;
  /// Tells the listener everything that has arrived since the last call; does not wait.
  virtual void take(Listener& listener) = 0;
  /// Waits until something has arrived, or that long [s].
  virtual void wait(double seconds) = 0;
  /// Samples that arrived and were thrown away because take() was not called often enough: not a loss of the network.
  virtual std::uint64_t overrun() const = 0;
};

/// Where a run takes commands. Thread: one, never the haptic thread; calls may allocate.
class CommandPost {
 public:
  virtual ~CommandPost() = default;
  /// What may be set; again whenever it is another value or range.
  virtual void show(const OpenParameter& parameter) noexcept = 0;
  /// What has arrived since the last call, for whichever run; does not wait.
  virtual std::vector<Command> take() = 0;
  virtual void answer(const Answer& answer) noexcept = 0;
};

/// Who commands. Thread: one. A command, or its answer, may be lost while both ends find each other: send it again until it is answered.
class Commander {
 public:
  virtual ~Commander() = default;
  virtual void send(const Command& command) = 0;
  struct Heard {
    std::vector<OpenParameter> parameters;
    std::vector<Answer> answers;  ///< to anybody
  };
  /// What has arrived since the last call; does not wait.
  virtual Heard take() = 0;
};

/// The bus over the network, through the plug-in bus_dds, which is loaded at the first call. Throws InputError: E590 not in this
/// installation, E720 the network cannot be used.
std::unique_ptr<Writer> openWriter(const BusSettings& settings);
std::unique_ptr<Reader> openReader(const BusSettings& settings);
std::unique_ptr<CommandPost> openPost(const BusSettings& settings);
std::unique_ptr<Commander> openCommander(const BusSettings& settings);

}  // namespace presa::bus
