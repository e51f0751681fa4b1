#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "framework/assembly/assembly_guide.h"
#include "framework/assembly/goal_choice.h"
#include "framework/bus/guide_link.h"
#include "framework/bus/remote_picture.h"
#include "framework/scene/world.h"

namespace presa::bus {

/// The guide of an assembly in another process than the dynamics: chooses the bodies to be pulled (GoalChoice) and
/// tells
/// its user what to do (AssemblyGuide) from each publication of the run, and sends an order back. Begins with the state
/// as it is: bodies in place count as placed, pulls in progress go on. Thread: one, unless stated otherwise.
class RemoteGuide {
 public:
  /// `world`: the scene of the run.
  RemoteGuide(std::shared_ptr<const World> world, std::unique_ptr<Reader> reader, std::unique_ptr<OrderSender> sender);

  /// Waits for the next publication, at most `seconds`, and decides on it.
  void step(double seconds);
  /// A run that was announced before the reader existed.
  void join(const RunInfo& run) { picture_.onRun(run, 0); }

  /// Asks for the release of the body placed last. Any thread.
  void undo() noexcept { undos_.fetch_add(1, std::memory_order_relaxed); }
  enum class Standing { kWaits, kLeads, kOtherLeads };
  struct Now {
    Standing standing = Standing::kWaits;
    OrderRefusal refusal = OrderRefusal::kNone;  ///< of this guide's orders, the last one
    Guidance guidance;
    std::vector<GuideEvent> events;  ///< all since the last call
  };
  /// Any thread.
  Now now();

 private:
  static constexpr std::size_t kMaxNews = 1000;
  static constexpr double kRepeat = 0.1;  // without a publication, the last order is sent again after [s]
  void begin(std::uint64_t run);
  bool isFar(const GuideStatus& status) const noexcept;
  void hear();
  void takeOver();
  void decide();
  void askForUndo();
  void send();

  std::shared_ptr<const World> world_;
  std::unique_ptr<Reader> reader_;
  std::unique_ptr<OrderSender> sender_;
  const std::uint64_t id_;
  RemotePicture picture_;
  std::uint64_t run_ = 0, decided_ = 0;
  std::optional<GuideStatus> status_;  // of this run
  Assembly assembly_;                  // the scene's, with the time of earlier guides
  std::optional<GoalChoice> choice_;
  std::optional<AssemblyGuide> guide_;
  GuideOrder order_;
  std::int64_t sent_ns_ = 0;
  std::int32_t undos_done_ = 0, undo_asked_ = -1;  // -1: none
  ObjectState objects_;
  DeviceState device_;
  ContactExchange contact_;
  ForceCommand force_;
  std::atomic<std::int32_t> undos_{0};
  std::mutex mutex_;
  Now now_;  // guarded by mutex_
};

}  // namespace presa::bus
