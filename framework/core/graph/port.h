#pragma once
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

/// Carries one output across threads into one rate group. All readers in the group share the bridge, so that within
/// a tick they see the same version.
class BridgeBase {
 public:
  virtual ~BridgeBase() = default;
  virtual void addReader(InPortBase& reader) = 0;
  /// Reader's thread, before its group's step: takes the latest value; returns its version (0: none yet).
  virtual std::uint64_t pull() noexcept = 0;
  /// Writer's thread, after its module's step: publishes the output with the tick's simulated time [s].
  virtual void push(double time) noexcept = 0;
  /// Replay only: keepHistory keeps published values in about `bytes`, pullVersion reads one of them; false: not there.
  virtual void keepHistory(std::size_t bytes) = 0;
  virtual bool pullVersion(std::uint64_t version) noexcept = 0;
};

class OutPortBase {
 public:
  OutPortBase(Module& owner, std::string name, std::type_index type);
  virtual ~OutPortBase() = default;
  const Module& owner() const noexcept { return owner_; }
  const std::string& name() const noexcept { return name_; }
  std::type_index type() const noexcept { return type_; }

 protected:
  friend class GraphBuilder;
  virtual std::unique_ptr<BridgeBase> makeBridge() = 0;
  virtual void connectDirect(InPortBase& reader) = 0;

 private:
  Module& owner_;
  std::string name_;
  std::type_index type_;
};

class InPortBase {
 public:
  InPortBase(Module& owner, std::string name, std::type_index type, bool optional, WhenOld when_old, double old_after);
  virtual ~InPortBase() = default;
  const Module& owner() const noexcept { return owner_; }
  const std::string& name() const noexcept { return name_; }
  std::type_index type() const noexcept { return type_; }
  bool optional() const noexcept { return optional_; }
  WhenOld whenOld() const noexcept { return when_old_; }
  /// Age above which the value counts as old [s].
  double oldAfter() const noexcept { return old_after_; }
  bool connected() const noexcept { return connected_; }
  bool ofLastTick() const noexcept { return of_last_tick_; }

 protected:
  friend class GraphBuilder;
  Module& owner_;
  std::string name_;
  std::type_index type_;
  bool optional_;
  WhenOld when_old_;
  double old_after_;
  bool connected_ = false;
  bool of_last_tick_ = false;
};

template <ExchangedData T>
class Out;

/// Input port. Within a rate group it sees the writer's value in place; across groups it holds the latest value,
/// taken before this group's step, with its age.
template <ExchangedData T>
class In final : public InPortBase {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  In(Module& owner, std::string name, WhenOld when_old = WhenOld::kHold, double old_after = kNever)
      : InPortBase(owner, std::move(name), typeid(T), false, when_old, old_after) {}
  struct Optional {};
  In(Module& owner, std::string name, Optional, WhenOld when_old = WhenOld::kHold, double old_after = kNever)
      : InPortBase(owner, std::move(name), typeid(T), true, when_old, old_after) {}
  /// Feedback: within a group the reader steps before the writer, and sees what it wrote in the last tick.
  struct OfLastTick {};
  In(Module& owner, std::string name, OfLastTick) : In(owner, std::move(name), Optional{}) { of_last_tick_ = true; }

  /// Before the writer's first step: across groups a default T, within a group the output's initial value.
  const T& value() const noexcept { return *value_; }
  const T* operator->() const noexcept { return value_; }
  /// From build() to the end of start(): a value as large as all later ones, by which the reader may size itself.
  const T& sized() const noexcept { return *sized_; }
  /// Across groups: 0 until the first value, then its number, counted by the writer. Within a group: always 0.
  std::uint64_t version() const noexcept { return version_; }
  bool hasValue() const noexcept { return direct_ || version_ > 0; }
  /// Simulated time since the writer's tick [s]; 0 within a group.
  double age(const Tick& now) const noexcept { return direct_ ? 0.0 : now.time - time_; }
  bool old(const Tick& now) const noexcept { return age(now) > old_after_; }

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

template <ExchangedData T>
class Bridge final : public BridgeBase {
 public:
  /// `source` already has its final size: the slots are copies of it.
  explicit Bridge(const T& source) : source_(source), latest_(source) {}

  void addReader(InPortBase& reader) override {
    readers_.push_back(static_cast<In<T>*>(&reader));
    readers_.back()->sized_ = &latest_.value();
  }
  std::uint64_t pull() noexcept override {
    if (latest_.update()) show(latest_.value(), latest_.version(), latest_.time());
    return latest_.version();
  }
  void push(double time) noexcept override {
    if (history_.empty()) return latest_.publish(source_, time);
    HistoryEntry& entry = history_[++pushed_ % history_.size()];
    entry.value = source_;
    entry.version = pushed_;
    entry.time = time;
  }
  void keepHistory(std::size_t bytes) override {
    std::size_t each = sizeof(HistoryEntry);
    if constexpr (SizedAtLoad<T>) each += source_.roomBytes();
    history_.resize(bytes / each + 64);
    for (HistoryEntry& entry : history_) entry.value = source_;
  }
  bool pullVersion(std::uint64_t version) noexcept override {
    if (version == 0) return true;
    const HistoryEntry& entry = history_[version % history_.size()];
    if (entry.version != version) return false;
    show(entry.value, entry.version, entry.time);
    return true;
  }

 private:
  struct HistoryEntry {
    T value{};
    std::uint64_t version = 0;
    double time = 0;
  };
  void show(const T& value, std::uint64_t version, double time) noexcept {
    for (In<T>* reader : readers_) {
      reader->value_ = &value;
      reader->version_ = version;
      reader->time_ = time;
    }
  }
  const T& source_;
  std::vector<In<T>*> readers_;
  LatestValue<T> latest_;
  std::vector<HistoryEntry> history_;
  std::uint64_t pushed_ = 0;
};

/// Output port: the module writes `value` in step(); the graph publishes it afterwards. A SizedAtLoad value must have
/// its final size when the module's constructor ends: build() allocates the bridges by it.
template <ExchangedData T>
class Out final : public OutPortBase {
 public:
  Out(Module& owner, std::string name) : OutPortBase(owner, std::move(name), typeid(T)) {}
  T value{};

 private:
  std::unique_ptr<BridgeBase> makeBridge() override { return std::make_unique<Bridge<T>>(value); }
  void connectDirect(InPortBase& reader) override {
    auto& in = static_cast<In<T>&>(reader);
    in.value_ = in.sized_ = &value;
    in.direct_ = true;
  }
};

}  // namespace presa
