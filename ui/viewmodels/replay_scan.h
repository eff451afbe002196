#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/depth/pipeline.h"
#include "core/registration/register_scan.h"
#include "ui/viewmodels/review_scan.h"

namespace foresight {

/// A scan with all that its replay needs. What was there at a moment shares everything with the
/// whole: looking at another moment copies no line, no point and no pixel.
struct ReplayScan {
  ReviewedScan reviewed;
  std::shared_ptr<const RegisteredScan> cloud;
  std::int64_t begin_utc_ns = 0;  ///< of its first line
  std::int64_t end_utc_ns = 0;    ///< from then on all of it is there
  /// When the depth of an image was computed first; one that is not listed: at the scan's end.
  std::map<int, std::int64_t> depth_utc_ns;
  /// Depth maps that were computed during this review, by image.
  std::map<int, std::shared_ptr<const DepthResult>> depths;

  const std::shared_ptr<const Scan>& Whole() const { return reviewed.scan; }
  bool IsWhole(std::int64_t utc_ns) const { return utc_ns >= end_utc_ns; }

  /// A time on the scan's clock. A scan of a head that was simulated faster than real time is
  /// played as fast as it was measured.
  double ClockAt(std::int64_t utc_ns) const;
  /// Lines whose last beam had been measured.
  int LinesAt(std::int64_t utc_ns) const;
  /// Images that had been taken.
  int ImagesAt(std::int64_t utc_ns) const;
  /// Objects that had been found, as they stood then. Once the scan is whole and nothing of what is
  /// known of it lies ahead, they are as the review shows them.
  std::vector<FoundObject> ObjectsAt(std::int64_t utc_ns) const;
  /// Changes with everything that ObjectsAt depends on.
  std::vector<int> ObjectStatesAt(std::int64_t utc_ns) const;
  bool HasDepthAt(int image, std::int64_t utc_ns) const;

  /// The scan and its points with the first `lines` and `images` alone.
  std::shared_ptr<const Scan> Part(int lines, int images) const;
  std::shared_ptr<const RegisteredScan> CloudOf(int lines) const;
};

}  // namespace foresight
