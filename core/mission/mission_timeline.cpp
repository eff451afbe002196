#include "core/mission/mission_timeline.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/mission/provenance.h"

namespace foresight {
namespace {

using Kind = TimelineEntry::Kind;

/// Whether the object was found before all lines of its scan were there.
bool FoundInPart(const DetectionRecord& object) {
  const auto made = ProvenanceFromJson(object.provenance_json, object.uuid);
  return made && made->part.has_value();
}

class Reader {
 public:
  Status Read(const MissionFile& mission, const MissionFile* review) {
    FORESIGHT_TRY(const std::vector<ScanSummary> scans, mission.ListScans());
    FORESIGHT_TRY(const std::vector<DepthRecord> depths, mission.ListDepths());
    FORESIGHT_TRY(const std::vector<DetectionRecord> objects, mission.ListDetections());
    FORESIGHT_TRY(const std::vector<EventRecord> events, mission.ListEvents());
    std::vector<std::int64_t> last;
    for (const ScanSummary& scan : scans)
      last.push_back(LastMeasurement(mission, scan).value_or(scan.begin_utc_ns));
    AddScans(scans, ScanEnds(scans, std::move(last), depths, objects));
    AddDepths(depths, false);
    FORESIGHT_CHECK(AddObjects(mission, objects, false));
    AddEvents(events);
    TakeLimits();
    if (review != nullptr) {
      FORESIGHT_TRY(const std::vector<DepthRecord> later_depths, review->ListDepths());
      FORESIGHT_TRY(const std::vector<DetectionRecord> later, review->ListDetections());
      AddDepths(later_depths, true);
      FORESIGHT_CHECK(AddObjects(*review, later, true));
    }
    std::stable_sort(out_.entries.begin(), out_.entries.end(),
                     [](const TimelineEntry& a, const TimelineEntry& b) {
                       return a.begin_utc_ns < b.begin_utc_ns;
                     });
    return {};
  }

  MissionTimeline Take() { return std::move(out_); }

 private:
  void Add(TimelineLane lane, Kind kind, std::int64_t begin_utc_ns, std::int64_t end_utc_ns,
           const std::string& scan_uuid, const std::string& object_uuid, std::string text,
           bool in_review) {
    out_.entries.push_back(
        {lane, kind, begin_utc_ns, end_utc_ns, scan_uuid, object_uuid, std::move(text), in_review});
  }

  void AddScans(const std::vector<ScanSummary>& scans, const std::vector<std::int64_t>& ends) {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const ScanSummary& scan = scans[i];
      const bool cut = scan.state == ScanState::kAborted || scan.state == ScanState::kInterrupted;
      Add(TimelineLane::kScans, cut ? Kind::kCutScan : Kind::kScan, scan.begin_utc_ns, ends[i],
          scan.uuid, {},
          fmt::format("scan {}, {}, {} lines, {} {}{}{}", i + 1, ToString(scan.state), scan.lines,
                      scan.images, scan.images == 1 ? "image" : "images",
                      scan.reason.empty() ? "" : ": ", scan.reason),
          false);
      number_[scan.uuid] = i + 1;
    }
  }

  std::string ScanName(const std::string& uuid) const {
    const auto known = number_.find(uuid);
    return known == number_.end() ? "a scan of another mission"
                                  : fmt::format("scan {}", known->second);
  }

  void AddDepths(const std::vector<DepthRecord>& depths, bool in_review) {
    for (const DepthRecord& depth : depths)
      Add(TimelineLane::kDepth, Kind::kDepth, depth.utc_ns, depth.utc_ns, depth.scan_uuid, {},
          fmt::format("depth of image {} of {}, {} pixels", depth.image_position + 1,
                      ScanName(depth.scan_uuid), depth.statistics.valid_pixels),
          in_review);
  }

  Status AddObjects(const MissionFile& file, const std::vector<DetectionRecord>& objects,
                    bool in_review) {
    for (const DetectionRecord& object : objects) {
      const std::string what =
          fmt::format("{}{}{} in {}", object.kind, object.name.empty() ? "" : " ", object.name,
                      ScanName(object.scan_uuid));
      // A review copies what it decides on; the mission says when that was found.
      if (found_.insert(object.uuid).second)
        Add(TimelineLane::kFits, Kind::kFound, object.utc_ns, object.utc_ns, object.scan_uuid,
            object.uuid, fmt::format("{}, found by {}", what, object.author), in_review);
      FORESIGHT_TRY(const std::vector<DetectionEvent> actions, file.ListDetectionEvents(object.id));
      for (const DetectionEvent& action : actions) AddAction(object, what, action, in_review);
    }
    return {};
  }

  void AddAction(const DetectionRecord& object, const std::string& what,
                 const DetectionEvent& action, bool in_review) {
    using Action = DetectionEvent::Action;
    const bool sent = action.action == Action::kSent;
    const Kind kind = sent                                 ? Kind::kSent
                      : action.action == Action::kAccepted ? Kind::kAccepted
                      : action.action == Action::kRejected ? Kind::kRejected
                                                           : Kind::kOtherAction;
    Add(sent ? TimelineLane::kSends : TimelineLane::kDecisions, kind, action.utc_ns, action.utc_ns,
        object.scan_uuid, object.uuid,
        fmt::format("{}, {} by {}{}{}", what, ToString(action.action), action.author,
                    action.text.empty() ? "" : ": ", action.text),
        in_review);
  }

  void AddEvents(const std::vector<EventRecord>& events) {
    std::optional<std::size_t> link;  // the last change of it
    for (const EventRecord& event : events) {
      const bool of_link = event.source == kLinkEventSource;
      const bool error = event.severity == "error";
      if (!of_link && !error && event.severity != "warning") continue;
      if (of_link && link) out_.entries[*link].end_utc_ns = event.utc_ns;
      const bool lost = event.text != kLinkUpText;
      Add(of_link ? TimelineLane::kLink : TimelineLane::kAlarms,
          of_link ? (lost ? Kind::kLinkLost : Kind::kLinkUp)
                  : (error ? Kind::kError : Kind::kWarning),
          event.utc_ns, event.utc_ns, {}, {},
          of_link ? event.text : fmt::format("{}: {}", event.severity, event.text), false);
      if (of_link) link = out_.entries.size() - 1;
    }
    if (!link) return;
    // The last state of the link lasts as long as the mission.
    std::int64_t last_utc_ns = 0;
    for (const TimelineEntry& entry : out_.entries)
      last_utc_ns = std::max(last_utc_ns, entry.end_utc_ns);
    out_.entries[*link].end_utc_ns = last_utc_ns;
  }

  void TakeLimits() {
    for (const TimelineEntry& entry : out_.entries) {
      if (out_.begin_utc_ns == 0 || entry.begin_utc_ns < out_.begin_utc_ns)
        out_.begin_utc_ns = entry.begin_utc_ns;
      out_.end_utc_ns = std::max(out_.end_utc_ns, entry.end_utc_ns);
    }
  }

  MissionTimeline out_;
  std::map<std::string, std::size_t> number_;  ///< of each scan, from 1
  std::set<std::string> found_;                ///< objects that are listed
};

}  // namespace

Result<std::int64_t> LastMeasurement(const MissionFile& mission, const ScanSummary& scan) {
  constexpr std::size_t kAtOnce = 16;
  double last_s = 0.0;
  // Seqs count up by one but where a line was lost: the last one is found from the number of lines.
  FORESIGHT_TRY(std::vector<LidarLine> lines,
                mission.LoadLines(scan.id, std::numeric_limits<std::int64_t>::min(), 1));
  if (!lines.empty()) {
    std::int64_t seq = lines.front().seq + std::max<std::int64_t>(0, scan.lines - 1);
    do {
      FORESIGHT_TRY(lines, mission.LoadLines(scan.id, seq, kAtOnce));
      if (lines.empty()) break;
      last_s = lines.back().time_s;
      seq = lines.back().seq + 1;
    } while (lines.size() == kAtOnce);
  }
  // Images on the fly lie between the lines; to list them all reads their pixels from the disk.
  if (scan.plan.image_mode == ScanPlan::ImageMode::kStopAndShoot) {
    FORESIGHT_TRY(const std::vector<ImageSummary> images, mission.ListImages(scan.id));
    for (const ImageSummary& image : images) last_s = std::max(last_s, image.time_s);
  }
  return std::max(scan.begin_utc_ns, scan.start_utc_ns + static_cast<std::int64_t>(1e9 * last_s));
}

std::vector<std::int64_t> ScanEnds(const std::vector<ScanSummary>& scans,
                                   std::vector<std::int64_t> last_measured_utc_ns,
                                   const std::vector<DepthRecord>& depths,
                                   const std::vector<DetectionRecord>& objects) {
  std::vector<std::int64_t> ends = std::move(last_measured_utc_ns);
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    place[scans[i].uuid] = i;
    ends[i] = std::max(scans[i].begin_utc_ns, ends[i]);
  }
  const auto not_after = [&](std::size_t scan, std::int64_t utc_ns) {
    if (utc_ns > scans[scan].begin_utc_ns) ends[scan] = std::min(ends[scan], utc_ns);
  };
  for (std::size_t i = 0; i + 1 < scans.size(); ++i) not_after(i, scans[i + 1].begin_utc_ns);
  for (const DepthRecord& depth : depths)
    if (const auto at = place.find(depth.scan_uuid); at != place.end())
      not_after(at->second, depth.utc_ns);
  for (const DetectionRecord& object : objects) {
    const auto at = place.find(object.scan_uuid);
    if (at == place.end() || object.utc_ns >= ends[at->second] || FoundInPart(object)) continue;
    not_after(at->second, object.utc_ns);
  }
  return ends;
}

Result<MissionTimeline> ReadTimeline(const MissionFile& mission, const MissionFile* review) {
  Reader reader;
  FORESIGHT_CHECK(reader.Read(mission, review));
  return reader.Take();
}

}  // namespace foresight
