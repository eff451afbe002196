#pragma once

#include <Eigen/Core>
#include <QObject>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/detection/fit_in_scan.h"
#include "core/options/option.h"
#include "ui/viewmodels/box_region.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// How a region is drawn with the mouse.
enum class RegionShape {
  kRectangle,  ///< dragged: two opposite corners
  kPolygon,    ///< clicked: its corners
  kTwoClicks,  ///< two points on opposite sides of the object
};

/// The region that points in pixels of an image mean; fails as ImageRoi::Check does.
Result<ImageRoi> RegionThrough(RegionShape shape, double motor_rad,
                               const std::vector<Eigen::Vector2d>& points);

/// From a region the operator drew to a found object.
class FitViewModel : public QObject {
  Q_OBJECT

 public:
  explicit FitViewModel(SessionModel* session, QObject* parent = nullptr);

  /// Whether the mouse draws regions.
  bool Drawing() const { return region_tool_ || object_tool_; }
  /// The tool that fits as soon as a region is drawn; nullopt = none is on.
  std::optional<ObjectKind> Tool() const;
  /// What `fit` looks for: the last tool's.
  ObjectKind Kind() const { return kind_; }
  RegionShape Shape() const { return shape_; }
  void SetShape(RegionShape shape);
  /// What the operator chose, else what is usual for `Kind` where a depth map is there or coming.
  FitSource From() const;
  void SetSource(FitSource source);
  bool CanFit() const;
  /// Whether a fit begins by itself as soon as the depth map that it needs is there.
  bool Waiting() const { return waiting_; }
  TaskRunner* Runner() { return &runner_; }
  /// The programs' defaults for the head's mounting, and what the operator chose; a terrain is also
  /// compared with the last one of an earlier scan that the operator accepted.
  FitOptions OptionsFor(ObjectKind kind) const;
  /// What the operator chose, by the option's key.
  const std::map<ObjectKind, std::map<std::string, OptionValue>>& Chosen() const { return chosen_; }
  /// The same without what the operator chose.
  FitOptions UsualOptionsFor(ObjectKind kind) const;
  /// An option of FitOptionTable by its key, for every next fit of `Kind`. Fails with
  /// kInvalidOptions or kBadData, and leaves everything as it is.
  Status SetOption(const std::string& key, const OptionValue& value);

  /// Drawing a region also fits an object of this kind into it.
  void SetTool(ObjectKind kind, bool on);
  /// Points in pixels of the current image, as many as the shape asks for. Fits at once while an
  /// object's tool is on. A region too small to be meant is ignored.
  void DrawRegion(const std::vector<Eigen::Vector2d>& points);
  /// A rectangle over the cloud: a box round what it shows or, with `cut`, what is left of the
  /// present box. Fits as DrawRegion does.
  void DrawBox(const CloudRectangle& rectangle, bool cut);

 public Q_SLOTS:
  /// Drawing a region only selects it.
  void setRegionTool(bool on);
  void leaveTools();
  /// At once or, where the depth map that it needs is being computed, as soon as that is there.
  /// Another object's fit that runs comes first; one of the same object is dropped. Where another
  /// scan comes meanwhile a live scan's fit is ended and listed; in review the fit is cancelled.
  void fit();
  /// The usual options of `Kind` again.
  void resetOptions();

 Q_SIGNALS:
  void changed();

 private:
  static QString Doing(ObjectKind kind);
  void FitIfReady();
  /// Another scan is shown, or none.
  void LeaveScan();
  void StopWaiting();
  /// A fit that runs or waits for those before it.
  struct Pending {
    std::string scan_uuid;
    ObjectKind kind;
    Roi roi;
    std::stop_source stop;
    bool replaced = false;  ///< by one of the same object
  };
  /// Drops the fits of the object that the operator has drawn a new region round in the same scan.
  void DropFitsOfTheSame(const Roi& roi);
  /// What was found, with all that is needed to find it again.
  struct Found {
    Detection detection;
    std::string provenance_json;
  };
  void Accept(ObjectKind kind, const std::shared_ptr<const Scan>& scan,
              const std::optional<ScanPart>& part, const Result<Found>& found);

  SessionModel* session_;
  std::string fitting_in_;  ///< uuid of the scan of the last fit, or of the one that waits
  TaskRunner runner_{session_->Tasks(), TaskPolicy::kQueue};
  std::deque<std::shared_ptr<Pending>> pending_;  ///< of `runner_`, in its order
  std::optional<FitSource> source_;               ///< that the operator chose
  RegionShape shape_ = RegionShape::kRectangle;
  ObjectKind kind_ = ObjectKind::kValve;
  /// What the operator chose, by the option's key.
  std::map<ObjectKind, std::map<std::string, OptionValue>> chosen_;
  bool waiting_ = false;
  bool object_tool_ = false;
  bool region_tool_ = false;
};

}  // namespace foresight
