#pragma once

#include <compare>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "core/base/shared_array.h"

namespace foresight {

/// Large values in a row that never change once they are in it: lidar lines, images. Copies share
/// them all, so a snapshot of a growing scan costs nothing. Read like a vector; a value that must
/// differ from what others see is changed with Edit, which copies that one.
template <class T>
class SharedList {
  using Pointer = std::shared_ptr<const T>;

 public:
  using value_type = T;

  class const_iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;

    const_iterator() = default;
    explicit const_iterator(const Pointer* at) : at_(at) {}
    reference operator*() const { return **at_; }
    pointer operator->() const { return at_->get(); }
    reference operator[](difference_type n) const { return *at_[n]; }
    const_iterator& operator++() { return *this += 1; }
    const_iterator& operator--() { return *this += -1; }
    const_iterator operator++(int) { return const_iterator(at_++); }
    const_iterator operator--(int) { return const_iterator(at_--); }
    const_iterator& operator+=(difference_type n) {
      at_ += n;
      return *this;
    }
    const_iterator& operator-=(difference_type n) { return *this += -n; }
    friend const_iterator operator+(const_iterator it, difference_type n) { return it += n; }
    friend const_iterator operator+(difference_type n, const_iterator it) { return it += n; }
    friend const_iterator operator-(const_iterator it, difference_type n) { return it -= n; }
    friend difference_type operator-(const_iterator a, const_iterator b) { return a.at_ - b.at_; }
    auto operator<=>(const const_iterator&) const = default;

   private:
    const Pointer* at_ = nullptr;
  };

  SharedList() = default;
  SharedList(std::vector<T> values) {  // NOLINT: a list is made of values as they come
    for (T& value : values) push_back(std::move(value));
  }
  SharedList(std::initializer_list<T> values) : SharedList(std::vector<T>(values)) {}

  std::size_t size() const { return items_.size(); }
  bool empty() const { return items_.empty(); }
  const T& operator[](std::size_t i) const { return *items_[i]; }
  /// Throws std::out_of_range.
  const T& at(std::size_t i) const {
    if (i >= size()) throw std::out_of_range("a list is shorter than that");
    return (*this)[i];
  }
  const T& front() const { return *items_.front(); }
  const T& back() const { return *items_.back(); }
  const_iterator begin() const { return const_iterator(items_.begin()); }
  const_iterator end() const { return const_iterator(items_.end()); }
  /// The value itself, to be kept beyond the list.
  Pointer Share(std::size_t i) const { return items_[i]; }

  void push_back(T value) { items_.push_back(std::make_shared<const T>(std::move(value))); }
  void push_back(Pointer value) { items_.push_back(std::move(value)); }
  /// Forgets all but the first `count`.
  void Truncate(std::size_t count) { items_.Truncate(count); }
  void clear() { items_.clear(); }
  /// A copy of the value, in its place; other lists keep the old one. O(size). The reference is
  /// good until this list is copied.
  T& Edit(std::size_t i) {
    const auto edited = std::make_shared<T>(*items_[i]);
    std::vector<Pointer> items(items_.begin(), items_.end());
    items[i] = edited;
    items_ = SharedArray<Pointer>(std::span<const Pointer>(items));
    return *edited;
  }

  bool operator==(const SharedList& other) const {
    return size() == other.size() && std::equal(begin(), end(), other.begin());
  }

 private:
  SharedArray<Pointer> items_;
};

}  // namespace foresight
