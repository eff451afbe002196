#include "ui/viewmodels/replay_scan.h"

#include <algorithm>

#include "core/detection/candidates.h"

namespace foresight {
namespace {

int NamedCandidate(const DetectionEvent& decision, const Detection& detection) {
  return std::clamp(DecidedCandidateOf(decision.text), 0,
                    std::max(0, CandidateCount(detection) - 1));
}

/// The object after the first `count` of what was done to it.
FoundObject After(const ReviewedObject& reviewed, std::size_t count, bool* deleted) {
  *deleted = false;
  FoundObject object = reviewed.object;
  object.name.clear();
  object.decision = Decision::kOpen;
  object.decided_candidate = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const DetectionEvent& action = reviewed.actions[i];
    switch (action.action) {
      case DetectionEvent::Action::kAccepted:
        object.decision = Decision::kAccepted;
        object.decided_candidate = NamedCandidate(action, object.detection);
        break;
      case DetectionEvent::Action::kRejected:
        object.decision = Decision::kRejected;
        object.decided_candidate = NamedCandidate(action, object.detection);
        break;
      case DetectionEvent::Action::kReopened:
        object.decision = Decision::kOpen;
        object.decided_candidate = 0;
        break;
      case DetectionEvent::Action::kRenamed:
        object.name = QString::fromStdString(action.text);
        break;
      case DetectionEvent::Action::kDeleted:
      case DetectionEvent::Action::kRestored:
        *deleted = action.action == DetectionEvent::Action::kDeleted;
        break;
      case DetectionEvent::Action::kSent:
        ++object.sendings;
        object.robot = QString::fromStdString(action.text);
        break;
    }
  }
  return object;
}

}  // namespace

double ReplayScan::ClockAt(std::int64_t utc_ns) const {
  const Scan& scan = *Whole();
  const double first_s = scan.lines.empty() ? 0.0 : scan.lines.front().time_s;
  double last_s = first_s;
  if (!scan.lines.empty()) last_s = scan.lines.back().time_s + scan.rig.lidar.period_s;
  for (const CameraFrame& frame : scan.frames) last_s = std::max(last_s, frame.time_s);
  if (end_utc_ns <= begin_utc_ns) return last_s;
  const double passed =
      static_cast<double>(utc_ns - begin_utc_ns) / static_cast<double>(end_utc_ns - begin_utc_ns);
  return first_s + passed * (last_s - first_s);
}

int ReplayScan::LinesAt(std::int64_t utc_ns) const {
  const Scan& scan = *Whole();
  if (IsWhole(utc_ns)) return static_cast<int>(scan.lines.size());
  const double clock_s = ClockAt(utc_ns) - scan.rig.lidar.BeamTime(scan.rig.lidar.beams - 1);
  const auto end =
      std::partition_point(scan.lines.begin(), scan.lines.end(),
                           [clock_s](const LidarLine& line) { return line.time_s <= clock_s; });
  return static_cast<int>(end - scan.lines.begin());
}

int ReplayScan::ImagesAt(std::int64_t utc_ns) const {
  const Scan& scan = *Whole();
  if (IsWhole(utc_ns)) return static_cast<int>(scan.frames.size());
  const double clock_s = ClockAt(utc_ns);
  int images = 0;  // in the order in which they came
  while (images < static_cast<int>(scan.frames.size()) &&
         scan.frames[static_cast<std::size_t>(images)].time_s <= clock_s)
    ++images;
  return images;
}

std::vector<int> ReplayScan::ObjectStatesAt(std::int64_t utc_ns) const {
  std::vector<int> states;
  for (const ReviewedObject& one : reviewed.objects) {
    const auto done =
        std::count_if(one.actions.begin(), one.actions.end(),
                      [utc_ns](const DetectionEvent& action) { return action.utc_ns <= utc_ns; });
    states.push_back(one.found_utc_ns > utc_ns ? -1 : static_cast<int>(done));
  }
  return states;
}

std::vector<FoundObject> ReplayScan::ObjectsAt(std::int64_t utc_ns) const {
  const std::vector<int> states = ObjectStatesAt(utc_ns);
  std::vector<FoundObject> present;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const ReviewedObject& one = reviewed.objects[i];
    if (states[i] < 0) continue;
    const auto count = static_cast<std::size_t>(states[i]);
    bool deleted = one.deleted;
    FoundObject object = one.object;
    if (count < one.actions.size()) object = After(one, count, &deleted);
    if (!deleted) present.push_back(std::move(object));
  }
  return present;
}

bool ReplayScan::HasDepthAt(int image, std::int64_t utc_ns) const {
  if (image < 0 || !IsWhole(utc_ns)) return false;
  const auto known = depth_utc_ns.find(image);
  return known == depth_utc_ns.end() || utc_ns >= known->second;
}

std::shared_ptr<const Scan> ReplayScan::Part(int lines, int images) const {
  auto part = std::make_shared<Scan>(*Whole());
  part->lines.Truncate(static_cast<std::size_t>(lines));
  part->frames.Truncate(static_cast<std::size_t>(images));
  part->state = ScanState::kRunning;
  part->reason.clear();
  return part;
}

std::shared_ptr<const RegisteredScan> ReplayScan::CloudOf(int lines) const {
  if (!cloud || lines == 0) return nullptr;
  auto part = std::make_shared<RegisteredScan>(*cloud);
  const auto count = static_cast<std::size_t>(lines);
  const std::size_t beams = static_cast<std::size_t>(cloud->beams);
  part->lines = lines;
  part->points.Truncate(count * beams);
  part->range_m.Truncate(count * beams);
  part->intensity.Truncate(count * beams);
  part->origins.Truncate(count);
  return part;
}

}  // namespace foresight
