#pragma once

#include <cstddef>
#include <vector>

namespace beeline::internal {

/// A list of up to `capacity` items, whose copies have the same capacity: unlike a reserved vector,
/// a copy does not allocate when it grows.
template <class T>
class BoundedList {
 public:
  using Iterator = typename std::vector<T>::iterator;

  explicit BoundedList(std::size_t capacity) : items_(capacity) {}

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return items_.size(); }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == items_.size(); }

  void clear() { size_ = 0; }
  /// Requires that the list is not full.
  void push_back(const T& item) { items_[size_++] = item; }
  void remove(std::size_t place) {
    for (std::size_t i = place + 1; i < size_; ++i) items_[i - 1] = items_[i];
    --size_;
  }

  const T& operator[](std::size_t i) const { return items_[i]; }
  Iterator begin() { return items_.begin(); }
  Iterator end() { return items_.begin() + static_cast<std::ptrdiff_t>(size_); }
  auto begin() const { return items_.begin(); }
  auto end() const { return items_.begin() + static_cast<std::ptrdiff_t>(size_); }

 private:
  std::vector<T> items_;
  std::size_t size_ = 0;
};

}  // namespace beeline::internal
