#include "ui/viewmodels/timeline_model.h"

namespace foresight {

TimelineModel::TimelineModel(ReviewViewModel* review, SessionModel* session, QObject* parent)
    : QObject(parent), review_(review), session_(session) {
  connect(review_, &ReviewViewModel::changed, this, &TimelineModel::FollowMission);
  connect(review_, &ReviewViewModel::opened, this, &TimelineModel::Read);  // it may have grown
  connect(review_, &ReviewViewModel::reviewKept, this, &TimelineModel::Read);
}

void TimelineModel::FollowMission() {
  if (review_->File() == mission_) return;
  mission_ = review_->File();
  reader_.cancel();
  marks_ = {};
  Q_EMIT changed();
}

void TimelineModel::Read() {
  FollowMission();
  if (!mission_) return;
  reader_.Run<MissionTimeline>(
      tr("Reading the timeline"),
      [mission = mission_](const RunContext&) -> Result<MissionTimeline> {
        FORESIGHT_TRY(const auto review,
                      MissionFile::FindReviewOf(mission->path(), ReviewFolder()));
        return ReadTimeline(*mission, review.get());
      },
      [this, mission = mission_](Result<MissionTimeline> read) {
        if (mission != mission_) return;
        if (!read) {
          if (read.error().code != ErrorCode::kCancelled)
            session_->Report(NoticeOf(tr("Reading the timeline"), read.error()));
          return;
        }
        const bool first = marks_.Timeline() == nullptr;
        if (!first && *marks_.Timeline() == *read) return;
        marks_ = TimelineMarks(std::make_shared<const MissionTimeline>(std::move(*read)));
        const MissionTimeline& timeline = *marks_.Timeline();
        if (first)
          axis_.SetLimits(timeline.begin_utc_ns, timeline.end_utc_ns);
        else
          axis_.Extend(timeline.begin_utc_ns, timeline.end_utc_ns);
        Q_EMIT changed();
      });
}

void TimelineModel::SetWidth(double width_px) {
  if (width_px == axis_.Width()) return;
  axis_.SetWidth(width_px);
  Q_EMIT sightChanged();
}

void TimelineModel::ZoomAt(double x, double factor) {
  axis_.ZoomAt(x, factor);
  Q_EMIT sightChanged();
}

void TimelineModel::PanBy(double px) {
  axis_.PanBy(px);
  Q_EMIT sightChanged();
}

void TimelineModel::ShowSpan(std::int64_t begin_utc_ns, std::int64_t end_utc_ns) {
  axis_.ShowSpan(begin_utc_ns, end_utc_ns);
  Q_EMIT sightChanged();
}

void TimelineModel::BringIntoSight(std::int64_t utc_ns) {
  if (utc_ns >= axis_.Begin() && utc_ns <= axis_.End()) return;
  axis_.BringIntoSight(utc_ns);
  Q_EMIT sightChanged();
}

void TimelineModel::showAll() {
  axis_.ShowAll();
  Q_EMIT sightChanged();
}

}  // namespace foresight
