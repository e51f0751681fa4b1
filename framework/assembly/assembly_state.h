#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/core/state/limits.h"

namespace presa {

inline constexpr std::int32_t kNoGoal = -1;

/// State of one goal of an assembly.
struct GoalState {
  enum class Status : std::int32_t {
    kOpen,
    kBlocked,  ///< a fitting body is near, but `missing` must be filled first
    kDrawing,  ///< `body` is within the snap distance and is pulled in
    kFilled,   ///< `body` is in place
  };
  Status status = Status::kOpen;
  std::int32_t body = kNoBody;
  std::int32_t missing = kNoGoal;
};

/// Progress of an assembly; goals in scene order. Written by: collision thread (modules/assembly).
struct AssemblyState {
  double time = 0;  ///< [s]
  std::int32_t filled = 0;
  std::int32_t last_filled = kNoGoal;  ///< goal that an undo would empty
  std::int32_t brought_back = 0;       ///< bodies being carried back into the workspace
  std::vector<GoalState> goals;        ///< sized at load by the assembly module

  /// Memory outside the struct itself (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return goals.capacity() * sizeof(GoalState); }
};

}  // namespace presa
