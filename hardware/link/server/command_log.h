#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace foresight {

/// What became of the commands that came last, by their ids: a command that comes again is answered
/// with its first outcome and not carried out again. Forgets the oldest. Not for several threads.
template <class Outcome>
class CommandLog {
 public:
  static constexpr std::size_t kMost = 1000;

  std::optional<Outcome> Find(const std::string& id) const {
    const auto found = outcomes_.find(id);
    return found == outcomes_.end() ? std::nullopt : std::optional<Outcome>(found->second);
  }
  void Keep(const std::string& id, Outcome outcome) {
    if (!outcomes_.emplace(id, std::move(outcome)).second) return;
    order_.push_back(id);
    if (order_.size() <= kMost) return;
    outcomes_.erase(order_.front());
    order_.pop_front();
  }

 private:
  std::unordered_map<std::string, Outcome> outcomes_;
  std::deque<std::string> order_;
};

}  // namespace foresight
