#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <typeindex>
#include <vector>

#include "framework/core/exchange/latest_value.h"
#include "framework/core/graph/module.h"

namespace presa {

/// How a reader treats a value older than InPortBase::oldAfter(). A declaration: the reader's step() implements it.
enum class WhenOld { kHold, kExtrapolate, kFadeToZero };

/// Carries one output across threads into other rate groups. All readers in a group share what the group pulled, so
/// that within a tick they see the same version.
class BridgeBase {
 public:
  virtual ~BridgeBase() = default;
  virtual void addReader(InPortBase& reader) = 0;  ///< before the run: `reader`, of the same type, shows what is pulled
  /// Thread of `group` before its step in `tick`, if it has readers: takes the latest value; returns its version, or 0.
  virtual std::uint64_t pull(RateGroup group, const Tick& tick) noexcept = 0;
  /// Writer's thread, after its module's step in `tick`: publishes the output, unless only view and bus read it and
  /// neither is due before the next tick.
  virtual void push(const Tick& tick) noexcept = 0;
  /// Replay only: keepHistory keeps published values in about `bytes`, pullVersion reads one of them; false: not there.
  virtual void keepHistory(std::size_t bytes) = 0;
  /// In place of pull(); version 0 changes nothing.
  virtual bool pullVersion(RateGroup group, std::uint64_t version) noexcept = 0;
};

/// Output port of any type; registers with its module.
class OutPortBase {
 public:
  OutPortBase(Module& owner, std::string name, std::type_index type);  ///< `name`: see connectByName
  virtual ~OutPortBase() = default;
  const Module& owner() const noexcept { return owner_; }     ///< module that writes it
  const std::string& name() const noexcept { return name_; }  ///< unique, or connected by hand (E504)
  std::type_index type() const noexcept { return type_; }     ///< of the value; both ends agree (E502)

 protected:
  friend class GraphBuilder;
  virtual std::unique_ptr<BridgeBase> makeBridge() = 0;  ///< for GraphBuilder: the value has its final size
  virtual void connectDirect(InPortBase& reader) = 0;    ///< for GraphBuilder: `reader` sees the value in place

 private:
  Module& owner_;
  std::string name_;
  std::type_index type_;
};

/// Input port of any type; registers with its module.
class InPortBase {
 public:
  /// Registers with `owner`; `name` is that of the output; `old_after` is an age [s].
  InPortBase(Module& owner, std::string name, std::type_index type, bool optional, WhenOld when_old, double old_after);
  virtual ~InPortBase() = default;
  const Module& owner() const noexcept { return owner_; }     ///< module that reads it
  const std::string& name() const noexcept { return name_; }  ///< that of its output, for connectByName
  std::type_index type() const noexcept { return type_; }     ///< of the value; both ends agree (E502)
  bool optional() const noexcept { return optional_; }        ///< may stay unconnected; others: E501
  WhenOld whenOld() const noexcept { return when_old_; }      ///< the reader's declared policy
  double oldAfter() const noexcept { return old_after_; }     ///< age above which the value counts as old [s]
  bool connected() const noexcept { return connected_; }      ///< GraphBuilder::connect found its writer
  bool ofLastTick() const noexcept { return of_last_tick_; }  ///< feedback, see In::OfLastTick

 protected:
  friend class GraphBuilder;
  Module& owner_;              ///< as by owner()
  std::string name_;           ///< as by name()
  std::type_index type_;       ///< as by type()
  bool optional_;              ///< as by optional()
  WhenOld when_old_;           ///< as by whenOld()
  double old_after_;           ///< as by oldAfter() [s]
  bool connected_ = false;     ///< as by connected(); set by GraphBuilder
  bool of_last_tick_ = false;  ///< as by ofLastTick()
};

template <ExchangedData T>
class Out;

/// Input port. Within a rate group it sees the writer's value in place; across groups it holds the latest value,
/// taken before this group's step, with its age.
template <ExchangedData T>
class In final : public InPortBase {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();  ///< no value counts as old
  /// A required input (E501); `old_after` is an age [s].
  In(Module& owner, std::string name, WhenOld when_old = WhenOld::kHold, double old_after = kNever)
      : InPortBase(owner, std::move(name), typeid(T), false, when_old, old_after) {}
  struct Optional {};  ///< selects the constructor of an input that may stay unconnected
  /// An input that may stay unconnected: value() is then a default T.
  In(Module& owner, std::string name, Optional, WhenOld when_old = WhenOld::kHold, double old_after = kNever)
      : InPortBase(owner, std::move(name), typeid(T), true, when_old, old_after) {}
  /// Feedback: within a group the reader steps before the writer, and sees what it wrote in the last tick.
  struct OfLastTick {};
  /// An optional input, read as feedback.
  In(Module& owner, std::string name, OfLastTick) : In(owner, std::move(name), Optional{}) { of_last_tick_ = true; }

  /// Before the writer's first step: across groups a default T, within a group the output's initial value.
  const T& value() const noexcept { return *value_; }
  const T* operator->() const noexcept { return value_; }  ///< member of value()
  /// From build() to the end of start(): a value as large as all later ones, by which the reader may size itself.
  const T& sized() const noexcept { return *sized_; }
  /// Across groups: 0 until the first value, then its number, counted by the writer. Within a group: always 0.
  std::uint64_t version() const noexcept { return version_; }
  bool hasValue() const noexcept { return direct_ || version_ > 0; }  ///< within a group: always
  /// Simulated time since the writer's tick [s]; 0 within a group.
  double age(const Tick& now) const noexcept { return direct_ ? 0.0 : now.time - time_; }
  bool old(const Tick& now) const noexcept { return age(now) > old_after_; }  ///< no value yet: the age is now.time

 private:
  template <ExchangedData U>
  friend class Out;
  template <ExchangedData U>
  friend class Bridge;
  inline static const T kDefault{};
  const T* value_ = &kDefault;
  const T* sized_ = &kDefault;
  std::uint64_t version_ = 0;
  double time_ = 0;
  bool direct_ = false;
};

/// Bridge of one type: a LatestValue with a reader for each group, or in a replay the values kept by keepHistory().
template <ExchangedData T>
class Bridge final : public BridgeBase {
 public:
  explicit Bridge(const T& source) : source_(source) { std::ranges::fill(due_, In<T>::kNever); }  ///< of final size

  void addReader(InPortBase& reader) override {
    Lane& lane = laneOf(reader.owner().group());
    if (lane.readers.empty()) lane.number = latest_.addReader(source_);
    lane.readers.push_back(static_cast<In<T>*>(&reader));
    lane.readers.back()->sized_ = &source_;
    dueOf(reader.owner().group()) = -1;
  }
  std::uint64_t pull(RateGroup group, const Tick& tick) noexcept override {
    Lane& lane = laneOf(group);
    if (latest_.update(lane.number)) lane.show(latest_.latest(lane.number));
    if (group >= RateGroup::kView) dueOf(group).store(tick.time + tick.period, std::memory_order_relaxed);
    return latest_.latest(lane.number).version;
  }
  void push(const Tick& tick) noexcept override {
    ++pushed_;
    const double next = tick.time + 1.5 * tick.period;  // half a period more, so that rounding loses no tick
    if (std::ranges::none_of(due_, [next](double due) { return due <= next; })) return;
    if (history_.empty()) return latest_.publish(source_, tick.time, pushed_);
    history_[pushed_ % history_.size()].set(source_, pushed_, tick.time);
  }
  void keepHistory(std::size_t bytes) override {
    std::size_t each = sizeof(Published<T>);
    if constexpr (SizedAtLoad<T>) each += source_.roomBytes();
    history_.resize(bytes / each + 64);
    for (Published<T>& entry : history_) entry.value = source_;
  }
  bool pullVersion(RateGroup group, std::uint64_t version) noexcept override {
    if (version == 0) return true;
    const Published<T>& entry = history_[version % history_.size()];
    if (entry.version == version) laneOf(group).show(entry);
    return entry.version == version;
  }

 private:
  struct Lane {  // to the readers of one group
    void show(const Published<T>& latest) noexcept {
      for (In<T>* reader : readers) {
        reader->value_ = &latest.value;
        reader->version_ = latest.version;
        reader->time_ = latest.time;
      }
    }
    std::size_t number = 0;
    std::vector<In<T>*> readers;
  };
  Lane& laneOf(RateGroup group) noexcept { return lanes_[static_cast<std::size_t>(group)]; }
  std::atomic<double>& dueOf(RateGroup group) noexcept { return due_[static_cast<std::size_t>(group)]; }

  // in one cache line: all that a push without a copy reads. due_: when each group pulls next, by it [s]
  const T& source_;
  std::uint64_t pushed_ = 0;
  std::array<std::atomic<double>, kRateGroupCount> due_{};
  std::array<Lane, kRateGroupCount> lanes_;
  LatestValue<T, kRateGroupCount> latest_{T(), 0};
  std::vector<Published<T>> history_;
};

/// Output port: the module writes `value` in step(); the graph publishes it afterwards. A SizedAtLoad value must have
/// its final size when the module's constructor ends: build() allocates the bridges by it.
template <ExchangedData T>
class Out final : public OutPortBase {
 public:
  Out(Module& owner, std::string name) : OutPortBase(owner, std::move(name), typeid(T)) {}  ///< see connectByName
  T value{};  ///< written in the constructor and in step() only

 private:
  std::unique_ptr<BridgeBase> makeBridge() override { return std::make_unique<Bridge<T>>(value); }
  void connectDirect(InPortBase& reader) override {
    auto& in = static_cast<In<T>&>(reader);
    in.value_ = in.sized_ = &value;
    in.direct_ = true;
  }
};

}  // namespace presa
