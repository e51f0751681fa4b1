#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/core/state/limits.h"

namespace presa {

/// What a guide in another process has decided for a run, as far as the run's end of the bus has found it in order.
/// Port "guide_orders". Written by: bus thread (framework/bus/publisher), in a replay from the recording.
struct GuideOrders {
  /// What a guide wants to be pulled to one goal.
  struct Draw {
    std::int32_t body = kNoBody;  ///< body that the goal is to pull; kNoBody: none
    std::uint32_t since = 0;      ///< rises whenever the draw begins anew; one that has ended does not go on by itself
    bool operator==(const Draw&) const = default;  ///< same body, same `since`
  };
  std::vector<Draw> draws;  ///< by goal; sized at load
  std::int32_t undone = 0;  ///< undos since the start

  /// Memory outside the struct itself (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return draws.capacity() * sizeof(Draw); }
};

/// The newest orders that the assembly module took, for the recording: a replay repeats them at the same ticks. Port
/// "taken_orders". Written by: collision thread (modules/assembly).
struct TakenOrders {
  /// One order to one goal.
  struct Order {
    std::uint64_t tick = 0;       ///< Tick::index of the collision group
    std::int32_t goal = kNone;    ///< kUndo: an undo
    std::int32_t body = kNoBody;  ///< body to be pulled from now on; kNoBody: none any more
  };
  static constexpr std::int32_t kNone = -1,  ///< Order::goal: no order
      kUndo = -2;                            ///< Order::goal: an undo
  static constexpr std::size_t kKept = 64;   ///< orders that `newest` keeps
  std::uint64_t count = 0;                   ///< since the start
  std::array<Order, kKept> newest{};         ///< order n, counted from 0, at n % kKept

  void add(const Order& order) noexcept { newest[count++ % kKept] = order; }  ///< overwrites the oldest when full
};

/// The orders of TakenOrders one by one, at most one for each call. Thread: one.
class OrderTaker {
 public:
  /// The next order; its goal is kNone if there is none.
  TakenOrders::Order next(const TakenOrders& taken) noexcept {
    if (taken.count - seen_ > TakenOrders::kKept) seen_ = taken.count - TakenOrders::kKept;
    return seen_ < taken.count ? taken.newest[seen_++ % TakenOrders::kKept] : TakenOrders::Order{};
  }

 private:
  std::uint64_t seen_ = 0;
};

inline constexpr const char* kGuideOrdersPort = "guide_orders";  ///< port of GuideOrders
inline constexpr const char* kTakenOrdersPort = "taken_orders";  ///< port of TakenOrders

}  // namespace presa
