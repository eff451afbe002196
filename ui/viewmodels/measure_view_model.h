#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "core/measure/measurement.h"
#include "core/measure/pick_point.h"
#include "ui/viewmodels/box_region.h"
#include "ui/viewmodels/map_view_model.h"
#include "ui/viewmodels/measure_source.h"
#include "ui/viewmodels/session_model.h"

namespace foresight {

/// The tool that measures in the panes: takes points that were measured, one after the other, and
/// keeps the finished measurement among the notes of the document: with its scan, or with the
/// mission where it was measured in a map. A click in the cloud means what the cloud shows, the
/// scan or the map; points of both do not go together. It never makes a point up: where nothing was
/// measured it says so.
class MeasureViewModel : public QObject {
  Q_OBJECT

 public:
  MeasureViewModel(SessionModel* session, MapViewModel* map, QObject* parent = nullptr);

  bool On() const { return on_; }
  MeasureKind Kind() const { return kind_; }
  /// Switches the tool on with this kind.
  void SetKind(MeasureKind kind);
  /// The points that were taken so far, and the plane.
  const std::vector<MeasuredPoint>& Points() const { return points_; }
  const std::optional<MeasuredPlane>& PlaneSoFar() const { return plane_; }
  /// Of these points and the plane.
  MeasureFrame Frame() const { return frame_; }
  /// The map that the cloud shows; nullptr = it shows the scan.
  const MissionMap* ShownMapOrNull() const;
  bool CanTakeBack() const { return on_ && Begun(); }
  bool WantsPlane() const { return on_ && kind_ == MeasureKind::kPlaneDistance && !plane_; }
  /// What to do next; empty while the tool is off.
  QString Hint() const;

  /// A click on the cloud: takes the return under it.
  void ClickInCloud(const CloudClick& click);
  /// A click on the image or the depth map: takes the depth of that pixel.
  void ClickInImage(const Eigen::Vector2d& pixel);
  /// A click on the map that is only compared: says where to click instead.
  void ClickInSecondMap();
  /// A rectangle over the cloud: the plane of the nearest things under it.
  void DrawPlane(const CloudRectangle& rectangle);

 public Q_SLOTS:
  void toggle();
  void leave();
  /// Takes the last point back, or the plane.
  void back();

 Q_SIGNALS:
  void changed();

 private:
  bool Begun() const { return !points_.empty() || plane_; }
  void DropPoints();
  std::unique_ptr<MeasureSource> InCloud() const;
  bool GoesWithPoints(MeasureFrame frame);
  void Take(MeasuredPoint point, const MeasureSource& source);
  void TakePlane(std::span<const Eigen::Vector3d> points, const QString& made_from,
                 const MeasureSource& source);
  void Finish(const MeasureSource& source);
  void Refuse(const QString& what, const QString& next);

  SessionModel* session_;
  MapViewModel* map_;
  bool on_ = false;
  MeasureKind kind_ = MeasureKind::kDistance;
  MeasureFrame frame_ = MeasureFrame::kRobot;
  std::vector<MeasuredPoint> points_;
  std::optional<MeasuredPlane> plane_;
};

}  // namespace foresight
