#include "core/evaluation/paired_lead.h"

#include <cmath>
#include <limits>
#include <vector>

namespace foresight {

PairedLead PairedLeadOf(std::span<const int> first, std::span<const int> second) {
  constexpr double kDeviations = 1.96;  // 95 % of a normal distribution
  PairedLead lead;
  lead.scenes = static_cast<int>(first.size());
  double squares = 2.0;  // one scene ahead, one behind
  for (std::size_t i = 0; i < first.size(); ++i) {
    const int ahead = first[i] - second[i];
    (ahead > 0 ? lead.only_first : lead.only_second) += std::abs(ahead);
    squares += ahead * ahead;
  }
  const double sum = lead.only_first - lead.only_second;
  const double count = lead.scenes + 2.0;
  const double mean = sum / count;
  const double sigma = std::sqrt((squares / count - mean * mean) / count);
  lead.lead = lead.scenes > 0 ? sum / lead.scenes : std::numeric_limits<double>::quiet_NaN();
  lead.low = mean - kDeviations * sigma;
  lead.high = mean + kDeviations * sigma;
  return lead;
}

PairedLead LeadOverSharedScenes(const RightOfScenes& first, const RightOfScenes& second) {
  std::vector<int> of_first, of_second;
  for (const auto& [seed, right] : second) {
    const auto there = first.find(seed);
    if (there == first.end()) continue;
    of_first.push_back(there->second);
    of_second.push_back(right);
  }
  return PairedLeadOf(of_first, of_second);
}

}  // namespace foresight
