#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>

namespace foresight {

/// Which numbers were used, of those that are not far behind the highest one.
class ReplayWindow {
 public:
  /// 0.19 s at 250 Mbit/s: no path reorders by more.
  static constexpr std::uint64_t kSize = 4096;

  /// False for what was used, and what is too far behind to know.
  bool IsNew(std::uint64_t number) const {
    if (number >= next_) return true;
    return next_ - number <= kSize && !used_[Place(number)];
  }
  /// @pre IsNew(number)
  void Use(std::uint64_t number) {
    if (number >= next_ + kSize) used_.reset();
    for (; next_ <= number; ++next_) {
      if (number - next_ >= kSize) next_ = number - kSize + 1;
      used_.reset(Place(next_));
    }
    used_.set(Place(number));
  }

 private:
  static std::size_t Place(std::uint64_t number) {
    return static_cast<std::size_t>(number % kSize);
  }

  std::bitset<kSize> used_;
  std::uint64_t next_ = 0;  ///< one more than the highest that was used
};

}  // namespace foresight
