#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "framework/core/exchange/latest_value.h"
#include "framework/core/state/device_state.h"

namespace presa {

/// What the program wants of a supervised device.
struct SupervisedCommand {
  Vec3 f_H_W = Vec3::Zero();  ///< force on the finger [N]
};

/// What the supervisor says in every cycle.
struct SupervisorReport {
  FingerInput finger;            ///< as the device gave it
  bool dropped = false;          ///< commands stopped coming: zero until one of exactly zero came
  Vec3 sent = Vec3::Zero();      ///< force that the device holds from now on [N]
  std::uint64_t cycles = 0;      ///< since the start
  std::uint64_t allocated = 0;   ///< times memory was taken since the start: none
  std::uint32_t rearms_met = 0;  ///< re-arms that it has carried out
};

/// Memory that a program and the supervisor of one device share. Made by the program; both are the same build.
struct SupervisorShare {
  static constexpr std::size_t kTextSize = 32 * 1024;
  enum class State : std::uint32_t {
    kStarting,  ///< the supervisor opens the device
    kRunning,
    kRefused,  ///< the device does not open: `answer` holds the findings
    kOver,
  };

  // before the start
  double period = 0.25e-3;  ///< of a cycle [s]
  std::size_t task_size = 0;
  char task[kTextSize] = {};  ///< what to open (task.h)

  // from then on
  std::atomic<State> state{State::kStarting};
  std::size_t answer_size = 0;
  char answer[kTextSize] = {};  ///< written once, before `state` leaves kStarting: notes, or findings
  std::atomic<bool> close{false};
  std::atomic<std::uint32_t> rearms{0};
  LatestValue<SupervisedCommand> command;  ///< program's haptic thread to supervisor
  LatestValue<SupervisorReport> report;    ///< supervisor to program's haptic thread
};
static_assert(std::atomic<SupervisorShare::State>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
                  std::atomic<std::uint8_t>::is_always_lock_free,
              "a lock of one process means nothing to another");

}  // namespace presa
