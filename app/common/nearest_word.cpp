#include "app/common/nearest_word.h"

#include <algorithm>
#include <vector>

namespace foresight {
namespace {

/// Fewest insertions, removals, replacements and swaps of neighbours between two words.
int EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> cost(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = static_cast<int>(i + j);
        continue;
      }
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1,
                             cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[a.size()][b.size()];
}

}  // namespace

std::string NearestWord(std::string_view typed, std::span<const std::string> words) {
  constexpr std::size_t kLongest = 64;  // nobody mistypes more
  std::string nearest;
  int least = static_cast<int>(std::min(typed.size(), kLongest) + 2) / 3;
  if (typed.size() > kLongest) return nearest;
  for (const std::string& word : words) {
    const int distance = EditDistance(typed, word);
    if (distance > least || (distance == least && !nearest.empty())) continue;
    nearest = word;
    least = distance;
  }
  return nearest;
}

}  // namespace foresight
