#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/image.h"
#include "core/base/run_context.h"

namespace foresight {

struct NonlocalOptions;

/// Which pixels of an image are likely to have the same depth, and how likely: an undirected
/// graph. Pixels are numbered row by row.
class PixelGraph {
 public:
  struct Edge {
    std::int32_t to = 0;
    float weight = 0.0f;  ///< > 0
  };

  /// Connects each pixel with its 8 neighbours and with the most similar ones of its window. Empty
  /// when cancelled.
  static std::optional<PixelGraph> Of(const ColorImage& image, const NonlocalOptions& options,
                                      const RunContext& context);

  int width() const { return width_; }
  int height() const { return height_; }
  std::span<const Edge> EdgesOf(std::size_t pixel) const {
    return {edges_.data() + first_[pixel], edges_.data() + first_[pixel + 1]};
  }

 private:
  PixelGraph(int width, int height, std::span<const Edge> outgoing, std::size_t outgoing_per_pixel);

  int width_;
  int height_;
  std::vector<std::size_t> first_;  ///< one a pixel and one behind the last
  std::vector<Edge> edges_;         ///< each edge from both of its ends
};

}  // namespace foresight
