#pragma once
#include <algorithm>
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

/// A value as it was published.
template <ExchangedData T>
struct alignas(64) Published {
  T value{};                  ///< the initial value before the first publication
  std::uint64_t version = 0;  ///< counted by the writer from 1, with values left out; 0: none yet
  double time = 0;            ///< the writer's simulated time [s]
  void set(const T& v, std::uint64_t n, double t) noexcept {
    value = v, version = n, time = t;
  }  ///< as large as before
};

/// Wait-free hand-over of the latest value from one writer thread to up to `MaxReaders` reader threads, which share the
/// copy that the writer makes. The writer never waits and never fails; a reader sees whole values in order and may miss
/// some. Allocates only before the first use, provided that `sized` is as large as later values.
///
/// A triple buffer for several readers: each has a mailbox with the newest slot and swaps it for the slot that it has
/// finished with. These are two slots a reader, so of 2 n + 1 the writer always finds one that nobody can see.
template <ExchangedData T, std::size_t MaxReaders = 1>
class LatestValue {
 public:
  /// `sized` has the size of the values that publish() will get.
  explicit LatestValue(const T& sized = {}, std::size_t readers = 1) {
    while (readers_ < readers) addReader(sized);
  }
  /// Before any thread uses it: one more reader, at most MaxReaders; returns its number, counted from 0.
  std::size_t addReader(const T& sized) {
    for (std::size_t i = 0; i < 2 * readers_ + 3; ++i) slots_[i].value = sized;
    used_[0] += 2;
    return readers_++;
  }

  /// Writer: copies `value` in and makes it the latest; the version by default follows the last one.
  void publish(const T& value, double time, std::uint64_t version = 0) noexcept {
    const auto free = static_cast<std::uint8_t>(std::find(used_.begin(), used_.end(), 0) - used_.begin());
    published_ = version > 0 ? version : published_ + 1;
    slots_[free].set(value, published_, time);
    for (std::size_t i = 0; i < readers_; ++i) {
      ++used_[free];
      // release: the slot's contents are visible to the thread that takes this index
      --used_[mailboxes_[i].newest.exchange(free | kNew, std::memory_order_acq_rel) & kIndex];
    }
  }

  /// Reader: takes the latest value; false when there is none newer than the current one.
  bool update(std::size_t reader = 0) noexcept {
    Mailbox& mine = mailboxes_[reader];
    if ((mine.newest.load(std::memory_order_relaxed) & kNew) == 0) return false;
    mine.held = mine.newest.exchange(mine.held, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  /// Reader: the value last taken.
  const Published<T>& latest(std::size_t reader = 0) const noexcept { return slots_[mailboxes_[reader].held]; }
  const T& value() const noexcept { return latest().value; }           ///< of the first reader
  std::uint64_t version() const noexcept { return latest().version; }  ///< of the first reader

 private:
  static constexpr std::uint8_t kNew = 128, kIndex = 127;
  struct Mailbox {
    alignas(64) std::atomic<std::uint8_t> newest{0};
    alignas(64) std::uint8_t held = 0;  // the reader's
  };
  std::array<Published<T>, 2 * MaxReaders + 1> slots_{};
  std::array<Mailbox, MaxReaders> mailboxes_{};
  // the writer's
  alignas(64) std::array<std::uint8_t, 2 * MaxReaders + 1> used_{};  // by slot: how many mailboxes and readers have it
  std::size_t readers_ = 0;
  std::uint64_t published_ = 0;
};

}  // namespace presa
