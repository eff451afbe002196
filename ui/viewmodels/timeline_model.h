#pragma once

#include <QObject>
#include <memory>

#include "core/mission/mission_timeline.h"
#include "ui/viewmodels/review_view_model.h"
#include "ui/viewmodels/timeline_axis.h"
#include "ui/viewmodels/timeline_marks.h"

namespace foresight {

/// The timeline of the mission under review, and which part of it is in sight. It is read again
/// when another mission is shown, and when something was added to its review.
class TimelineModel : public QObject {
  Q_OBJECT

 public:
  TimelineModel(ReviewViewModel* review, SessionModel* session, QObject* parent = nullptr);

  /// nullptr while nothing is open, or nothing is read yet.
  const std::shared_ptr<const MissionTimeline>& Timeline() const { return marks_.Timeline(); }
  const TimelineMarks& Marks() const { return marks_; }
  const TimelineAxis& Axis() const { return axis_; }
  bool Busy() const { return reader_.Busy(); }

  void SetWidth(double width_px);
  void ZoomAt(double x, double factor);
  void PanBy(double px);
  void ShowSpan(std::int64_t begin_utc_ns, std::int64_t end_utc_ns);
  void BringIntoSight(std::int64_t utc_ns);

 public Q_SLOTS:
  void zoomIn() { ZoomAt(axis_.Width() / 2.0, 2.0); }
  void zoomOut() { ZoomAt(axis_.Width() / 2.0, 0.5); }
  void panEarlier() { PanBy(-axis_.Width() / 4.0); }
  void panLater() { PanBy(axis_.Width() / 4.0); }
  void showAll();

 Q_SIGNALS:
  void changed();       ///< there is another timeline
  void sightChanged();  ///< another part of it is in sight

 private:
  void FollowMission();
  void Read();

  ReviewViewModel* review_;
  SessionModel* session_;
  TaskRunner reader_{session_->Tasks()};
  std::shared_ptr<MissionFile> mission_;  ///< that the timeline is of
  TimelineMarks marks_;
  TimelineAxis axis_;
};

}  // namespace foresight
