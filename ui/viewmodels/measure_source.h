#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/measure/measurement.h"
#include "core/measure/pick_point.h"
#include "ui/viewmodels/box_region.h"
#include "ui/viewmodels/map_view_model.h"
#include "ui/viewmodels/session_model.h"

namespace foresight {

/// What the cloud shows to measure in: points with a frame. Clicks, rectangles and answers are in
/// that frame.
class MeasureSource {
 public:
  virtual ~MeasureSource() = default;

  virtual MeasureFrame Frame() const = 0;
  /// The return that a click means; nullopt where nothing was measured.
  virtual std::optional<MeasuredPoint> Pick(const CloudClick& click) const = 0;
  virtual std::vector<Eigen::Vector3d> Around(const Eigen::Vector3d& place,
                                              double radius_m) const = 0;
  /// The nearest things under a rectangle.
  virtual std::vector<Eigen::Vector3d> Under(const CloudRectangle& rectangle) const = 0;
  /// From where a place was measured: there a plane's positive side is.
  virtual Eigen::Vector3d SeenFrom(const Eigen::Vector3d& place) const = 0;
  /// Under a point that was picked here, or in the scan's depth map.
  virtual Result<MeasuredPlane> Ground(const MeasuredPoint& point) const = 0;
};

/// The scan that the session shows, in robot; nullptr while it has no points. The source refers to
/// the session, and is used before anything there changes.
std::unique_ptr<MeasureSource> SourceInScan(const SessionModel& session);
/// A map of several scans.
std::unique_ptr<MeasureSource> SourceInMap(std::shared_ptr<const ShownMap> map,
                                           const SessionModel& session);

}  // namespace foresight
