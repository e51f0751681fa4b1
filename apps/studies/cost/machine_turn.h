#pragma once

namespace presa::cost {

/// A turn on this machine, among the shards of this user: those that watch run together, one that measures costs runs
/// alone. Held until it is destroyed or the process ends.
class MachineTurn {
 public:
  enum Kind { kWithOthers, kAlone };

  MachineTurn() = default;
  MachineTurn(MachineTurn&& other) noexcept;
  MachineTurn& operator=(MachineTurn&&) = delete;
  ~MachineTurn();
  /// False: it is not this one's turn yet. True also where no turns can be taken: the lock cannot be made.
  bool take(Kind kind);

 private:
  int file_ = -1;
};

}  // namespace presa::cost
