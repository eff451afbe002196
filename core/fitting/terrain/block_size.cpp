#include "core/fitting/terrain/block_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "core/fitting/terrain/block_outline.h"

namespace foresight {
namespace {

constexpr double kSizeBin_m = 0.005;
constexpr double kSizeReach = 0.35;    // of a side: how far either end may lie from where it should
constexpr double kSameSize = 0.04;     // of a side: what edges and blocks are off by
constexpr double kAnotherSize = 0.10;  // of a side: what counts as another size
constexpr double kSizeCorner_m = 0.020;
constexpr double kOfAnother_m = 0.015;  // support this near to another block is that one's
// What a line's nat is worth, of a block's area: 0.036, 0.07 and 0.14 were tried
// (docs/evaluation/terrain.md, "Blocks in the image").
constexpr double kLineNat = 0.07;

/// Gains along one side of a rectangle, in bins from its lower end less the reach and the band.
class SideProfile {
 public:
  explicit SideProfile(double side_m)
      : side_(Bins(side_m)),
        reach_(Bins(kSizeReach * side_m)),
        band_(Bins(kRectangleBand_m)),
        first_m_(-0.5 * side_m - (reach_ + band_) * kSizeBin_m),
        inside_(static_cast<std::size_t>(side_ + 2 * (reach_ + band_)) + 1, 0.0),
        around_(inside_),
        ends_(inside_) {}

  void Add(double at_m, double inside, double around) {
    const double bin = std::floor((at_m - first_m_) / kSizeBin_m);
    if (bin < 0.0 || bin >= static_cast<double>(inside_.size() - 1)) return;
    inside_[static_cast<std::size_t>(bin) + 1] += inside;
    around_[static_cast<std::size_t>(bin) + 1] += around;
  }

  /// What an image says of either end at each place, `line` its nats there. What it does not show
  /// of a line is taken for as likely an end as what it shows elsewhere.
  void AddLines(const std::function<LineInImage(double at_m)>& line, double area_of_a_nat_m2) {
    std::vector<LineInImage> lines(ends_.size());
    double nats = 0.0, shown = 0.0;
    for (int low = band_; low <= band_ + 2 * reach_; ++low)
      for (const int end : {low, low + side_}) {
        LineInImage& at = lines[static_cast<std::size_t>(end)];
        at = line(first_m_ + end * kSizeBin_m);
        nats += at.shown * at.nats;
        shown += at.shown;
      }
    if (!(shown > 0.0)) return;
    for (std::size_t end = 0; end < ends_.size(); ++end)
      ends_[end] = area_of_a_nat_m2 * lines[end].NatsOr(nats / shown);
  }

  /// The best score of a length that is nearly the side's, less the best of any other.
  double MarginOfItsLength() const {
    const int same = static_cast<int>(std::lround(kSameSize * side_));
    const int another = static_cast<int>(std::lround(kAnotherSize * side_));
    const std::vector<double> best = BestOfLengths();
    double of_side = -std::numeric_limits<double>::infinity(), of_another = of_side;
    for (int longer = -reach_; longer <= reach_; ++longer) {
      const double score = best[static_cast<std::size_t>(longer + reach_)];
      if (std::abs(longer) <= same) of_side = std::max(of_side, score);
      if (std::abs(longer) >= another) of_another = std::max(of_another, score);
    }
    return of_side - of_another;
  }

 private:
  static int Bins(double length_m) { return static_cast<int>(std::lround(length_m / kSizeBin_m)); }
  /// Of each length, from side - reach to side + reach, wherever it lies.
  std::vector<double> BestOfLengths() const {
    const std::vector<double> inside = SumsOf(inside_), around = SumsOf(around_);
    std::vector<double> best(static_cast<std::size_t>(2 * reach_) + 1,
                             -std::numeric_limits<double>::infinity());
    for (int low = band_; low <= band_ + 2 * reach_; ++low)
      for (int high = band_ + side_; high <= band_ + side_ + 2 * reach_; ++high) {
        const int longer = high - low - side_;
        if (std::abs(longer) > reach_) continue;
        const double score = Sum(inside, low, high) + Sum(around, low - band_, low) +
                             Sum(around, high, high + band_) +
                             ends_[static_cast<std::size_t>(low)] +
                             ends_[static_cast<std::size_t>(high)];
        double& kept = best[static_cast<std::size_t>(longer + reach_)];
        kept = std::max(kept, score);
      }
    return best;
  }

  /// Of all bins up to each.
  static std::vector<double> SumsOf(const std::vector<double>& bins) {
    std::vector<double> sums(bins.size());
    std::partial_sum(bins.begin(), bins.end(), sums.begin());
    return sums;
  }
  static double Sum(const std::vector<double>& sums, int from, int to) {
    return sums[static_cast<std::size_t>(to)] - sums[static_cast<std::size_t>(from)];
  }

  int side_, reach_, band_;
  double first_m_;
  std::vector<double> inside_, around_;  ///< of the bin before each place; the first is empty
  std::vector<double> ends_;             ///< at each place
};

}  // namespace

double SizeMargin(const PlaneView& view, const BlockRectangle& rectangle,
                  std::span<const BlockRectangle> others, const BlockOutline* outline) {
  const Eigen::Vector2d half = 0.5 * rectangle.size_m;
  const auto of_another = [&](const Eigen::Vector2d& at) {
    return rectangle.Inside(at) < 0.0 &&
           std::any_of(others.begin(), others.end(), [&](const BlockRectangle& other) {
             return other.Inside(at) > -kOfAnother_m;
           });
  };
  std::array<SideProfile, 2> profiles = {SideProfile(rectangle.size_m.x()),
                                         SideProfile(rectangle.size_m.y())};
  const auto add = [&](const PlaneView::Sample& sample, bool own) {
    const Eigen::Vector2d local = rectangle.Local(sample.at);
    const double inside = own ? sample.area_m2 : -sample.area_m2;
    const double around = own ? -kOutsideWeight * sample.area_m2 : 0.0;
    for (int axis = 0; axis < 2; ++axis)
      if (std::abs(local[1 - axis]) <= half[1 - axis] - kSizeCorner_m)
        profiles[static_cast<std::size_t>(axis)].Add(local[axis], inside, around);
  };
  for (const PlaneView::Sample& sample : view.support) add(sample, !of_another(sample.at));
  for (const auto* closed : {&view.through, &view.occupied})
    for (const PlaneView::Sample& sample : *closed) add(sample, false);
  for (int axis = 0; outline != nullptr && axis < 2; ++axis)
    profiles[static_cast<std::size_t>(axis)].AddLines(
        [&](double at_m) { return outline->Line(rectangle, axis, at_m); },
        kLineNat * rectangle.size_m.prod());
  return std::min(profiles[0].MarginOfItsLength(), profiles[1].MarginOfItsLength()) /
         rectangle.size_m.prod();
}

}  // namespace foresight
