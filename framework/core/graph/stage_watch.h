#pragma once
#include <cstddef>

#include "framework/core/schedule/tick.h"

namespace presa {

/// Told where the time of a tick goes.
class StageWatch {
 public:
  virtual ~StageWatch() = default;
  /// What ran since the last call, or since the tick began, was Module::stages()[stage]. Any number of times in a tick.
  virtual void done(std::size_t stage) noexcept = 0;
};

/// For a tick that nobody watches: where its type is known, nothing is left of it.
struct NoStageWatch final : StageWatch {
  void done(std::size_t) noexcept override {}
};

/// A module whose stages can be told apart while they run, for `presa explain --cost`.
class WatchedStages {
 public:
  virtual ~WatchedStages() = default;
  /// Module::step, to the bit, telling `watch` after each stage. Thread: the module's.
  virtual void stepWatched(const Tick& tick, StageWatch& watch) noexcept = 0;
};

}  // namespace presa
