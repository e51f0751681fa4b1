#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace presa {

/// A list whose capacity is set at load. A copy copies only the items in use, and allocates only when the capacities
/// differ. Nonblocking after that.
template <class T>
class BoundedList {
 public:
  BoundedList() = default;                                          ///< room for no item
  explicit BoundedList(std::size_t capacity) : items_(capacity) {}  ///< allocates the room for `capacity` items
  BoundedList(const BoundedList& other) { *this = other; }          ///< with the capacity of `other`: allocates
  /// Nonblocking while the capacities agree; else it takes that of `other`.
  BoundedList& operator=(const BoundedList& other) {
    if (this == &other) return *this;
    if (items_.size() != other.items_.size()) items_.resize(other.items_.size());
    std::copy_n(other.items_.begin(), other.size_, items_.begin());
    size_ = other.size_;
    lost_ = other.lost_;
    return *this;
  }

  /// A further item, with what it held before. Null: the list is full, which lost() counts.
  T* add() noexcept {
    if (size_ == items_.size()) return ++lost_, nullptr;
    return &items_[size_++];
  }
  /// A copy of `item` as a further item; null as above.
  T* add(const T& item) noexcept {
    T* place = add();
    if (place != nullptr) *place = item;
    return place;
  }
  void remove(std::size_t i) noexcept { items_[i] = items_[--size_]; }  ///< the last item takes place i
  void clear() noexcept { size_ = lost_ = 0; }                          ///< items and lost() go to 0; the memory stays

  std::size_t size() const noexcept { return size_; }                               ///< items in use
  bool empty() const noexcept { return size_ == 0; }                                ///< no item in use
  std::size_t capacity() const noexcept { return items_.size(); }                   ///< items that fit
  std::size_t lost() const noexcept { return lost_; }                               ///< items refused since clear()
  T& operator[](std::size_t i) noexcept { return items_[i]; }                       ///< i < size(), unchecked
  const T& operator[](std::size_t i) const noexcept { return items_[i]; }           ///< i < size(), unchecked
  T* begin() noexcept { return items_.data(); }                                     ///< items in use, in one block
  T* end() noexcept { return items_.data() + size_; }                               ///< behind the last item in use
  const T* begin() const noexcept { return items_.data(); }                         ///< items in use, in one block
  const T* end() const noexcept { return items_.data() + size_; }                   ///< behind the last item in use
  std::size_t roomBytes() const noexcept { return items_.capacity() * sizeof(T); }  ///< [bytes] (SizedAtLoad)

 private:
  std::vector<T> items_;
  std::size_t size_ = 0, lost_ = 0;
};

}  // namespace presa
