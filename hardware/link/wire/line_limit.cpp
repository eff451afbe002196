#include "hardware/link/wire/line_limit.h"

#include <fmt/format.h>

namespace foresight {

std::optional<std::string> LineLimit::Pass(const std::string& line, Time now) {
  constexpr auto kRepeat = std::chrono::minutes(1);
  constexpr int kMostInSecond = 20;
  const std::lock_guard lock(mutex_);
  const auto known = lines_.find(line);
  if (known != lines_.end() && now - known->second.since < kRepeat) {
    ++known->second.held_back;
    return std::nullopt;
  }
  if (now - second_ >= std::chrono::seconds(1)) {
    second_ = now;
    in_second_ = 0;
  }
  if (++in_second_ > kMostInSecond) return std::nullopt;
  const int held_back = known == lines_.end() ? 0 : known->second.held_back;
  // At 20 a second a minute has 1200 lines: what is older has had its time.
  std::erase_if(lines_, [&](const auto& old) { return now - old.second.since >= kRepeat; });
  lines_[line] = {now, 0};
  return held_back == 0 ? line : fmt::format("{} ({} times more before)", line, held_back);
}

void LineLimit::Reset() {
  const std::lock_guard lock(mutex_);
  lines_.clear();
  in_second_ = 0;
}

}  // namespace foresight
