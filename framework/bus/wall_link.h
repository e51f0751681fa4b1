#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/scene/scene.h"

/// What the processes of a CAVE tell each other, beside the state of the run that all of them read.
namespace presa::bus {

/// The leader's announcement of one frame: all walls draw the state at `time` for this head. Repeated until the next.
struct WallFrame {
  std::uint64_t leader = 0;  ///< random id of the leading process, never 0
  std::uint64_t number = 0;  ///< of the frame, from 1
  std::uint64_t run = 0;     ///< id of the run whose state it is
  double time = 0;           ///< simulated time of the state [s]
  Pose X_KHead;              ///< in the frame of the walls' file
  bool tracked = false;      ///< false: the tracker is lost, the head stays where it was
};

/// A wall's answer: it shows that frame. Repeated while no other is announced; with number 0 it greets a leader.
struct WallDrawn {
  std::uint64_t sender = 0;  ///< random id of the process, never 0
  std::uint64_t leader = 0, number = 0;
  std::string wall;           ///< its name, up to kLongestParameter characters
  double time = 0;            ///< simulated time of the drawn state [s]
  std::uint64_t state = 0;    ///< hash of the drawn poses: equal on walls that show the same
  Pose X_KHead;               ///< head that it shows
  std::int64_t shown_ns = 0;  ///< CLOCK_MONOTONIC; comparable only on the same machine
};

/// Both ends of these messages. Thread: one.
class WallLink {
 public:
  virtual ~WallLink() = default;
  virtual void send(const WallFrame& frame) noexcept = 0;
  virtual void send(const WallDrawn& drawn) noexcept = 0;
  struct Arrived {
    std::vector<WallFrame> frames;
    std::vector<WallDrawn> drawn;
  };
  /// Everything that has arrived since the last call, also what this process sent; does not wait.
  virtual Arrived take() = 0;
};

/// As openReader (state_bus.h).
std::unique_ptr<WallLink> openWallLink(const BusSettings& settings);

}  // namespace presa::bus
