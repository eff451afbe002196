#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include "core/mapping/mission_map.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// A map and the pyramid that it is drawn from.
struct ShownMap {
  MissionMap map;
  PointPyramid pyramid;
};

/// Several scans of a mission brought together, and what changed between two of them. The work is
/// done beside everything else, with progress, and can be cancelled.
class MapViewModel : public QObject {
  Q_OBJECT

 public:
  explicit MapViewModel(SessionModel* session, QObject* parent = nullptr);

  /// nullptr while there is none.
  const std::shared_ptr<const ShownMap>& Map() const { return map_; }
  /// The file it was made from; empty while there is none.
  QString Mission() const { return mission_; }
  bool Busy() const { return runner_.Busy(); }
  /// Whether the cloud shows the map: a click there means a point of it then.
  bool Shown() const { return shown_ && map_ != nullptr; }
  void SetShown(bool shown);
  /// Brings all scans of the mission together, from where a file of the robot's odometry says that
  /// it stood (LoadMapOdometry); without one each is looked for where the last one was.
  void Make(const QString& mission, const QString& odometry_file = {});
  /// Looks for what changed from one scan of the map to another, by their places in its list.
  void FindChanges(int before, int after);
  /// Of the last search; empty before one.
  const std::vector<ScanChange>& Changes() const { return changes_; }
  /// One line about the last search: how many changes, or why there are none.
  QString ChangesText() const { return changes_text_; }
  /// One line a scan: its place and residual, or why it is not in the map; those left out follow.
  std::vector<QString> PlaceTexts() const;
  /// Why a map cannot be made now; empty = it can.
  QString WhyNoMap() const;

 public Q_SLOTS:
  void cancel() { runner_.cancel(); }
  void clear();
  /// Asks the panes to look at a change.
  void lookAtChange(int index);

 Q_SIGNALS:
  void changed();
  void made();  ///< there is a new map, which is to be shown
  void centreWanted(const Eigen::Vector3d& place);
  void shownChanged();

 private:
  SessionModel* session_;
  TaskRunner runner_{session_->Tasks()};
  std::shared_ptr<const ShownMap> map_;
  QString mission_;
  bool shown_ = false;
  std::vector<ScanChange> changes_;
  QString changes_text_;
};

/// The colour of a scan of a map: colours of Okabe and Ito, round and round.
Rgb8 ColorOfScan(std::size_t index);

}  // namespace foresight
