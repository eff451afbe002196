#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/mission/mission_timeline.h"
#include "ui/viewmodels/timeline_axis.h"

namespace foresight {

/// A mark on the screen: one entry, or several that are too close together to be told apart.
struct TimelineMark {
  double x = 0.0;
  double x_end = 0.0;             ///< equals x for what takes no time
  std::vector<int> entries = {};  ///< places in MissionTimeline::entries; never empty
  int count = 0;  ///< how many it stands for; `entries` names the first and the last
};

/// The entries of a timeline by their lanes, to find those in sight without looking at the others.
class TimelineMarks {
 public:
  TimelineMarks() = default;
  explicit TimelineMarks(std::shared_ptr<const MissionTimeline> timeline);

  const std::shared_ptr<const MissionTimeline>& Timeline() const { return timeline_; }
  int CountOf(TimelineLane lane) const;

  /// What is in sight of a lane, from left to right. Entries that begin less than `apart_px` after
  /// the first of a mark are put together with it. O(marks * log(entries)).
  std::vector<TimelineMark> InSight(TimelineLane lane, const TimelineAxis& axis,
                                    double apart_px) const;

  /// The times at which something begins, ends or happens, ascending: the next one after a time,
  /// or the last one before it; the time itself where there is none.
  std::int64_t NextTime(std::int64_t utc_ns) const;
  std::int64_t PreviousTime(std::int64_t utc_ns) const;

 private:
  const TimelineEntry& Entry(int place) const {
    return timeline_->entries[static_cast<std::size_t>(place)];
  }

  std::shared_ptr<const MissionTimeline> timeline_;
  std::array<std::vector<int>, kTimelineLanes> lanes_;
  std::vector<std::int64_t> times_;
};

}  // namespace foresight
