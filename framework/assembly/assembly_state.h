#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/core/state/limits.h"

namespace presa {

inline constexpr std::int32_t kNoGoal = -1;

/// One place of an assembly.
struct GoalState {
  enum class Status : std::int32_t {
    kOpen,
    kBlocked,  ///< a body that belongs here is near, but `missing` has to be filled first
    kDrawing,  ///< `body` is near enough to be drawn here
    kFilled,   ///< `body` stands here
  };
  Status status = Status::kOpen;
  std::int32_t body = kNoBody;
  std::int32_t missing = kNoGoal;
};

/// How far an assembly has come; goals in scene order. Written by: collision thread (assembly).
struct AssemblyState {
  double time = 0;  ///< [s]
  std::int32_t filled = 0;
  std::int32_t last_filled = kNoGoal;  ///< what an undo would take out
  std::int32_t brought_back = 0;       ///< bodies that are on their way back into the field
  std::vector<GoalState> goals;        ///< none before the assembly's module sized it by the scene

  /// Memory beside the struct itself (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return goals.capacity() * sizeof(GoalState); }
};

}  // namespace presa
