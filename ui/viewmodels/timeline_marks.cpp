#include "ui/viewmodels/timeline_marks.h"

#include <algorithm>

namespace foresight {

TimelineMarks::TimelineMarks(std::shared_ptr<const MissionTimeline> timeline)
    : timeline_(std::move(timeline)) {
  if (!timeline_) return;
  for (std::size_t i = 0; i < timeline_->entries.size(); ++i) {
    const TimelineEntry& entry = timeline_->entries[i];
    lanes_[static_cast<std::size_t>(entry.lane)].push_back(static_cast<int>(i));
    times_.push_back(entry.begin_utc_ns);
    times_.push_back(entry.end_utc_ns);
  }
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
}

int TimelineMarks::CountOf(TimelineLane lane) const {
  return static_cast<int>(lanes_[static_cast<std::size_t>(lane)].size());
}

std::vector<TimelineMark> TimelineMarks::InSight(TimelineLane lane, const TimelineAxis& axis,
                                                 double apart_px) const {
  const std::vector<int>& places = lanes_[static_cast<std::size_t>(lane)];
  // Within a lane nothing that takes a while overlaps, so the ends ascend as the begins do.
  auto at = std::partition_point(places.begin(), places.end(),
                                 [&](int place) { return Entry(place).end_utc_ns < axis.Begin(); });
  std::vector<TimelineMark> marks;
  while (at != places.end() && Entry(*at).begin_utc_ns <= axis.End()) {
    const double x = axis.XOf(Entry(*at).begin_utc_ns);
    const std::int64_t together_ns = axis.TimeAt(x + apart_px);
    const auto end = std::partition_point(
        at + 1, places.end(), [&](int place) { return Entry(place).begin_utc_ns < together_ns; });
    TimelineMark mark;
    mark.x = x;
    mark.x_end = axis.XOf(Entry(*(end - 1)).end_utc_ns);
    mark.entries = {*at};
    if (end - at > 1) mark.entries.push_back(*(end - 1));
    mark.count = static_cast<int>(end - at);
    marks.push_back(std::move(mark));
    at = end;
  }
  return marks;
}

std::int64_t TimelineMarks::NextTime(std::int64_t utc_ns) const {
  const auto next = std::upper_bound(times_.begin(), times_.end(), utc_ns);
  return next == times_.end() ? utc_ns : *next;
}

std::int64_t TimelineMarks::PreviousTime(std::int64_t utc_ns) const {
  const auto next = std::lower_bound(times_.begin(), times_.end(), utc_ns);
  return next == times_.begin() ? utc_ns : *(next - 1);
}

}  // namespace foresight
