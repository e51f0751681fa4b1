#pragma once
#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace presa {

/// Data that may cross threads: it owns nothing. (Eigen's fixed-size types are plain bytes but declare
/// a copy constructor, so the concept does not ask for std::is_trivially_copyable.)
template <class T>
concept PlainData =
    std::is_trivially_destructible_v<T> && std::is_default_constructible_v<T> && std::is_copy_assignable_v<T>;

/// Data whose size depends on the scene: its writer sizes it at load; after that, an assignment between two values of
/// the same size must not allocate. A type promises this by declaring `roomBytes()`, the memory it owns.
template <class T>
concept SizedAtLoad = std::default_initializable<T> && std::is_copy_assignable_v<T> && requires(const T& value) {
  { value.roomBytes() }
  noexcept->std::same_as<std::size_t>;
};

/// Data that ports can carry.
template <class T>
concept ExchangedData = PlainData<T> || SizedAtLoad<T>;

/// Wait-free hand-over of the latest value from one writer thread to one reader thread (triple
/// buffer). The writer never waits and never fails; the reader sees whole values in order and may miss
/// some. Each value carries a version (1, 2, 3 …) and the writer's simulated time [s]. Several readers need
/// one LatestValue each. Allocates only at construction, provided that `sized` is as large as later values.
template <ExchangedData T>
class LatestValue {
 public:
  LatestValue() = default;  ///< of default values T
  /// Before either thread uses it; `sized` has the size of the values that publish() will get.
  explicit LatestValue(const T& sized) {
    for (Slot& slot : slots_) slot.value = sized;
  }

  /// Writer: copies `value` in and makes it the latest.
  void publish(const T& value, double time) noexcept {
    Slot& slot = slots_[write_];
    slot.value = value;
    slot.time = time;
    slot.version = ++published_;
    // release: the slot's contents are visible to the thread that takes this index
    write_ = middle_.exchange(static_cast<std::uint8_t>(write_ | kNew), std::memory_order_acq_rel) & kIndex;
  }

  /// Reader: takes the latest value; false when there is none newer than the current one.
  bool update() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kNew) == 0) return false;
    read_ = middle_.exchange(read_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// Reader: the value last taken. Before the first: version 0 and the initial value (a default T or `sized`).
  const T& value() const noexcept { return slots_[read_].value; }
  std::uint64_t version() const noexcept { return slots_[read_].version; }  ///< reader: counted by the writer from 1
  double time() const noexcept { return slots_[read_].time; }               ///< reader: the writer's [s]

 private:
  static constexpr std::uint8_t kNew = 4;
  static constexpr std::uint8_t kIndex = 3;
  struct alignas(64) Slot {
    T value{};
    std::uint64_t version = 0;
    double time = 0;
  };
  std::array<Slot, 3> slots_{};
  alignas(64) std::atomic<std::uint8_t> middle_{1};
  alignas(64) std::uint8_t write_ = 0;
  std::uint64_t published_ = 0;
  alignas(64) std::uint8_t read_ = 2;
};

}  // namespace presa
