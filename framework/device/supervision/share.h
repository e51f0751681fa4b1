#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "framework/core/exchange/latest_value.h"
#include "framework/core/state/device_state.h"

namespace presa {

/// Command of the program to a supervised device.
struct SupervisedCommand {
  Wrench F_H_W;  ///< wrench on the tool
};

/// Report of the supervisor, published in every cycle.
struct SupervisorReport {
  FingerInput finger;             ///< the device's sample, unchecked
  bool dropped = false;           ///< commands stopped: force zero until a command of exactly zero comes
  Wrench sent;                    ///< wrench that the device holds from now on
  std::uint64_t cycles = 0;       ///< since the start
  std::uint64_t allocated = 0;    ///< allocations since the start; must stay 0
  std::uint32_t rearms_done = 0;  ///< value of SupervisorShare::rearms that it has carried out
};

/// Memory that the program and the supervisor of one device share. The program makes it; both are of the same build.
struct SupervisorShare {
  static constexpr std::size_t kTextSize = 32 * 1024;  ///< of `task` and of `answer` [bytes]
  /// How far the supervisor is.
  enum class State : std::uint32_t {
    kStarting,  ///< the supervisor opens the device
    kRunning,
    kRefused,  ///< the device does not open: `answer` holds the findings
    kOver,     ///< the supervisor has ended
  };

  // written by the program before it starts the supervisor
  double period = 0.25e-3;    ///< of a cycle [s]
  std::size_t task_size = 0;  ///< bytes of `task` in use
  char task[kTextSize] = {};  ///< the device to open (task.h)

  // shared from then on
  std::atomic<State> state{State::kStarting};  ///< written by the supervisor
  std::size_t answer_size = 0;                 ///< bytes of `answer` in use
  char answer[kTextSize] = {};                 ///< written once, before `state` leaves kStarting: notes, or findings
  std::atomic<bool> close{false};              ///< by the program: take the force to zero, then end
  std::atomic<std::uint32_t> rearms{0};        ///< by the program: number of re-arms so far
  LatestValue<SupervisedCommand> command;      ///< program's haptic thread to supervisor
  LatestValue<SupervisorReport> report;        ///< supervisor to program's haptic thread
};
static_assert(std::atomic<SupervisorShare::State>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
                  std::atomic<std::uint8_t>::is_always_lock_free,
              "a lock of one process means nothing to another");

}  // namespace presa
