#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

namespace foresight {

/// Values in a row, as in a vector, that only grow at their end; copies share what they have in
/// common. A copy costs nothing whatever its length, so a snapshot of something that grows can be
/// taken at every look. Whoever appends never disturbs copies that were made before: other threads
/// may read them meanwhile. One object is not for several threads, as with a vector.
template <class T>
class SharedArray {
 public:
  using value_type = T;

  SharedArray() = default;
  SharedArray(std::initializer_list<T> values) { Assign(std::span(values.begin(), values.size())); }
  explicit SharedArray(std::span<const T> values) { Assign(values); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* data() const { return buffer_ ? buffer_->items.get() : nullptr; }
  const T& operator[](std::size_t i) const { return buffer_->items[i]; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[size_ - 1]; }
  std::span<const T> span() const { return {data(), size_}; }

  /// Amortised O(1), as a vector's.
  void push_back(T value) { *Extend(1) = std::move(value); }
  /// Appends `count` times `value`; returns where they begin, to be written before this object is
  /// copied.
  std::span<T> Append(std::size_t count, const T& value) {
    T* first = Extend(count);
    std::fill(first, first + count, value);
    return {first, count};
  }
  /// Forgets all but the first `count`.
  void Truncate(std::size_t count) { size_ = std::min(size_, count); }
  void clear() { *this = {}; }

  bool operator==(const SharedArray& other) const {
    return size_ == other.size_ &&
           (data() == other.data() || std::equal(begin(), end(), other.begin()));
  }

 private:
  struct Buffer {
    explicit Buffer(std::size_t most) : capacity(most), items(new T[most]()) {}
    const std::size_t capacity;
    std::atomic<std::size_t> used{0};  ///< by whichever copy is the longest
    std::unique_ptr<T[]> items;
  };

  void Assign(std::span<const T> values) {
    if (values.empty()) return;
    std::copy(values.begin(), values.end(), Extend(values.size()));
  }

  /// Room for `count` more, which belong to this object alone.
  T* Extend(std::size_t count) {
    std::size_t mine = size_;
    // Behind the end of this object another copy may have appended: then this one moves away.
    if (!buffer_ || size_ + count > buffer_->capacity ||
        !buffer_->used.compare_exchange_strong(mine, size_ + count)) {
      auto grown = std::make_shared<Buffer>(std::max({size_ + count, 2 * size_, std::size_t{16}}));
      std::copy(begin(), end(), grown->items.get());
      grown->used = size_ + count;
      buffer_ = std::move(grown);
    }
    T* first = buffer_->items.get() + size_;
    size_ += count;
    return first;
  }

  std::shared_ptr<Buffer> buffer_;
  std::size_t size_ = 0;
};

}  // namespace foresight
