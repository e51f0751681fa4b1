#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/assembly/assembly_guide.h"
#include "framework/bus/samples.h"
#include "framework/scene/scene.h"

/// What a run and the guide of its assembly tell each other when the guide is in a viewer (GuideDesk, RemoteGuide),
/// beside
/// the state that every viewer reads. Both carry whole values, so that any message may be lost, doubled or late.
namespace presa::bus {

/// The guide's decisions on the states of one publication. It sends one after each.
struct GuideOrder {
  std::uint64_t run = 0;
  std::uint64_t guide = 0;            ///< random id of the guiding process, never 0
  std::uint64_t number = 0;           ///< of the guide's order, from 1
  std::uint64_t on = 0;               ///< Stamp::sequence of the states that it decides on
  std::int32_t undone = 0;            ///< undos since the start of the run: GuideStatus::undone, or one more
  std::vector<std::int32_t> draws{};  ///< by goal: the body to be pulled, or kNoBody
  Guidance says{};                    ///< what it tells its user
  std::uint64_t told = 0;             ///< number of its events since it began
  std::vector<GuideEvent> events{};   ///< the last of them, at most kMaxEvents, oldest first
  static constexpr std::size_t kMaxEvents = 32;
};

/// Why an order had no effect.
enum class OrderRefusal : std::int32_t {
  kNone = 0,
  kOtherGuide,  ///< another guide leads the run
  kLate,        ///< decided on states that are too old
  kOutOfOrder,  ///< number or publication far ahead: damaged or forged
  kWrongGoals,  ///< another number of goals than the scene has
  kWrongBody,   ///< body that does not exist or does not fit the goal
  kTooMany,     ///< more orders than a guide sends
};
const char* toString(OrderRefusal refusal) noexcept;

/// The run's answer, sent with each publication, before its heartbeat.
struct GuideStatus {
  std::uint64_t run = 0;
  std::uint64_t sequence = 0;                  ///< Stamp::sequence of the publication
  std::uint64_t lead = 0;                      ///< the guide that the run follows; 0: none
  std::uint64_t number = 0;                    ///< its last order that was in order
  OrderRefusal refusal = OrderRefusal::kNone;  ///< of the order refused last
  std::uint64_t refused_guide = 0;             ///< its guide
  std::int32_t undone = 0;                     ///< undos since the start of the run
  double elapsed = 0;                          ///< assembly time so far, for a guide that takes over [s]
  AssemblyState assembly{};                    ///< without bodies that must wait, which only the guide knows
};

/// The run's end. Thread: one, never the haptic thread; calls may allocate.
class OrderPost {
 public:
  virtual ~OrderPost() = default;
  virtual void show(const GuideStatus& status) noexcept = 0;
  /// Orders that have arrived since the last call, to any run; does not wait.
  virtual std::vector<GuideOrder> take() = 0;
};

/// The guide's end. Thread: one.
class OrderSender {
 public:
  virtual ~OrderSender() = default;
  virtual void send(const GuideOrder& order) noexcept = 0;
  /// Answers that have arrived since the last call, of any run; does not wait.
  virtual std::vector<GuideStatus> take() = 0;
};

/// As openReader (state_bus.h).
std::unique_ptr<OrderPost> openOrderPost(const BusSettings& settings);
std::unique_ptr<OrderSender> openOrderSender(const BusSettings& settings);

}  // namespace presa::bus
