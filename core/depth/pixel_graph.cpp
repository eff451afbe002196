#include "core/depth/pixel_graph.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/depth/nonlocal.h"

namespace foresight {
namespace {

/// Keeps every pixel connected, so that the image can slow the depth down but never cut it off.
constexpr double kLeastWeight = 1e-4;
constexpr float kOutside = std::numeric_limits<float>::infinity();
constexpr std::int32_t kNobody = -1;

struct Offset {
  int x = 0;
  int y = 0;
};

/// Half of the neighbourhood; the other half is the same edges from their other ends.
constexpr std::array<Offset, 4> kNeighbours = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

/// The window without its centre and its direct neighbours, near ones first: among equals, as in a
/// plain wall, the nearest win.
std::vector<Offset> SearchOffsets(int radius) {
  std::vector<Offset> offsets;
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      if (std::max(std::abs(x), std::abs(y)) > 1) offsets.push_back({x, y});
  std::stable_sort(offsets.begin(), offsets.end(), [](const Offset& a, const Offset& b) {
    return a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y;
  });
  return offsets;
}

/// The channels as floats with the border repeated, so that windows need no tests.
class PaddedImage {
 public:
  PaddedImage(const ColorImage& image, int margin) : margin_(margin) {
    for (FloatImage& channel : channels_)
      channel = FloatImage(image.width() + 2 * margin, image.height() + 2 * margin);
    for (int y = 0; y < channels_[0].height(); ++y)
      for (int x = 0; x < channels_[0].width(); ++x) {
        const Rgb8 pixel = image(std::clamp(x - margin, 0, image.width() - 1),
                                 std::clamp(y - margin, 0, image.height() - 1));
        channels_[0](x, y) = pixel.r;
        channels_[1](x, y) = pixel.g;
        channels_[2](x, y) = pixel.b;
      }
  }
  /// Row y of the image, from -margin to height + margin; index 0 is column 0.
  const float* Row(std::size_t channel, int y) const {
    return channels_[channel].row(y + margin_) + margin_;
  }

 private:
  int margin_;
  std::array<FloatImage, 3> channels_;
};

/// Finds the edges of one row of pixels at a time; a thread has its own.
class RowSearch {
 public:
  RowSearch(const ColorImage& image, const PaddedImage& padded, const NonlocalOptions& options)
      : width_(image.width()),
        height_(image.height()),
        padded_(padded),
        patch_radius_(options.patch_radius_px),
        similar_(static_cast<std::size_t>(options.similar_pixels)),
        fraction_(options.nonlocal_fraction),
        offsets_(SearchOffsets(options.window_radius_px)),
        exponent_(-1.0 / (2.0 * 3.0 * options.sigma_color * options.sigma_color)),
        columns_(static_cast<std::size_t>(width_ + 2 * patch_radius_)),
        costs_(width_, static_cast<int>(offsets_.size())) {}

  std::size_t EdgesPerPixel() const { return kNeighbours.size() + similar_; }

  /// `edges` has EdgesPerPixel() for each pixel of the row; those that are not there lead to
  /// kNobody.
  void Find(int y, std::span<PixelGraph::Edge> edges) {
    for (std::size_t o = 0; o < offsets_.size(); ++o)
      ComparePatches(y, offsets_[o], costs_.row(static_cast<int>(o)));
    for (int x = 0; x < width_; ++x) {
      const auto own =
          edges.subspan(static_cast<std::size_t>(x) * EdgesPerPixel(), EdgesPerPixel());
      for (std::size_t n = 0; n < kNeighbours.size(); ++n)
        own[n] = ToNeighbour(x, y, kNeighbours[n]);
      ToMostSimilar(x, y, own.subspan(kNeighbours.size()));
    }
  }

 private:
  bool Contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  PixelGraph::Edge EdgeTo(int x, int y, double squared_difference, double fraction) const {
    const double weight = std::max(kLeastWeight, std::exp(exponent_ * squared_difference));
    return {y * width_ + x, static_cast<float>(fraction * weight)};
  }

  PixelGraph::Edge ToNeighbour(int x, int y, const Offset& offset) const {
    if (!Contains(x + offset.x, y + offset.y)) return {kNobody, 0.0f};
    double squared = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double d = padded_.Row(c, y)[x] - padded_.Row(c, y + offset.y)[x + offset.x];
      squared += d * d;
    }
    return EdgeTo(x + offset.x, y + offset.y, squared, 1.0);
  }

  /// Sum of squared differences between the patches around each pixel of the row and around the
  /// pixels at `offset` from them.
  void ComparePatches(int y, const Offset& offset, float* cost) {
    std::fill(columns_.begin(), columns_.end(), 0.0f);
    float* columns = columns_.data() + patch_radius_;
    for (int dy = -patch_radius_; dy <= patch_radius_; ++dy)
      for (std::size_t c = 0; c < 3; ++c) {
        const float* here = padded_.Row(c, y + dy);
        const float* there = padded_.Row(c, y + dy + offset.y) + offset.x;
        for (int x = -patch_radius_; x < width_ + patch_radius_; ++x)
          columns[x] += (here[x] - there[x]) * (here[x] - there[x]);
      }
    std::fill(cost, cost + width_, 0.0f);
    for (int dx = -patch_radius_; dx <= patch_radius_; ++dx)
      for (int x = 0; x < width_; ++x) cost[x] += columns[x + dx];
    for (int x = 0; x < width_; ++x)
      if (!Contains(x + offset.x, y + offset.y)) cost[x] = kOutside;
  }

  void ToMostSimilar(int x, int y, std::span<PixelGraph::Edge> edges) {
    best_.assign(similar_, {kOutside, 0});
    for (std::size_t o = 0; o < offsets_.size(); ++o) {
      const float cost = costs_(x, static_cast<int>(o));
      if (!(cost < best_.back().first)) continue;
      const auto place = std::upper_bound(best_.begin(), best_.end(), cost,
                                          [](float c, const auto& b) { return c < b.first; });
      std::move_backward(place, best_.end() - 1, best_.end());
      *place = {cost, o};
    }
    const double pixels = (2.0 * patch_radius_ + 1.0) * (2.0 * patch_radius_ + 1.0);
    for (std::size_t i = 0; i < similar_; ++i) {
      const auto& [cost, o] = best_[i];
      edges[i] = cost == kOutside
                     ? PixelGraph::Edge{kNobody, 0.0f}
                     : EdgeTo(x + offsets_[o].x, y + offsets_[o].y, cost / pixels, fraction_);
    }
  }

  int width_, height_;
  const PaddedImage& padded_;
  int patch_radius_;
  std::size_t similar_;
  double fraction_;
  std::vector<Offset> offsets_;
  double exponent_;
  std::vector<float> columns_;
  FloatImage costs_;  ///< (column of the pixel, number of the offset)
  std::vector<std::pair<float, std::size_t>> best_;
};

}  // namespace

std::optional<PixelGraph> PixelGraph::Of(const ColorImage& image, const NonlocalOptions& options,
                                         const RunContext& context) {
  const PaddedImage padded(image, options.window_radius_px + options.patch_radius_px);
  const std::size_t per_pixel = RowSearch(image, padded, options).EdgesPerPixel();
  std::vector<Edge> outgoing(image.size() * per_pixel);
  constexpr int kBandRows = 16;
  const int bands = (image.height() + kBandRows - 1) / kBandRows;
  const std::size_t row_edges = static_cast<std::size_t>(image.width()) * per_pixel;
  std::atomic<int> bands_done{0};
  const bool finished = ParallelFor(bands, context, [&](int band) {
    RowSearch search(image, padded, options);
    const int end = std::min((band + 1) * kBandRows, image.height());
    for (int y = band * kBandRows; y < end; ++y)
      search.Find(y,
                  std::span(outgoing).subspan(static_cast<std::size_t>(y) * row_edges, row_edges));
    context.Report(static_cast<double>(++bands_done) / bands, "comparing patches");
  });
  if (!finished) return std::nullopt;
  return PixelGraph(image.width(), image.height(), outgoing, per_pixel);
}

PixelGraph::PixelGraph(int width, int height, std::span<const Edge> outgoing,
                       std::size_t outgoing_per_pixel)
    : width_(width),
      height_(height),
      first_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + 1, 0) {
  const auto for_each_edge = [&](const auto& visit) {
    for (std::size_t i = 0; i < outgoing.size(); ++i)
      if (outgoing[i].to != kNobody)
        visit(i / outgoing_per_pixel, static_cast<std::size_t>(outgoing[i].to), outgoing[i].weight);
  };
  for_each_edge([&](std::size_t a, std::size_t b, float) {
    ++first_[a + 1];
    ++first_[b + 1];
  });
  for (std::size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
  edges_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for_each_edge([&](std::size_t a, std::size_t b, float weight) {
    edges_[next[a]++] = {static_cast<std::int32_t>(b), weight};
    edges_[next[b]++] = {static_cast<std::int32_t>(a), weight};
  });
}

}  // namespace foresight
