#include "core/mission/complete_scan.h"

namespace foresight {
namespace {

Status AppendMissing(MissionFile& mission, std::int64_t id, const Scan& whole, const Scan& there) {
  for (std::size_t i = there.lines.size(); i < whole.lines.size(); ++i)
    FORESIGHT_CHECK(mission.AppendLine(id, whole.lines[i]));
  if (there.given.empty() && !whole.given.empty())
    FORESIGHT_CHECK(mission.SetGivenCloud(id, whole.given));
  const auto samples = whole.track.samples();
  FORESIGHT_CHECK(mission.AppendMotorSamples(id, samples.subspan(there.track.samples().size())));
  for (std::size_t i = there.frames.size(); i < whole.frames.size(); ++i)
    FORESIGHT_CHECK(mission.AppendFrame(id, whole.frames[i]));
  return {};
}

/// Whether what is there is how the scan begins.
bool IsBeginOf(const Scan& there, const Scan& whole) {
  const auto samples = there.track.samples();
  return there.lines.size() <= whole.lines.size() && there.frames.size() <= whole.frames.size() &&
         samples.size() <= whole.track.samples().size() &&
         (there.given.empty() || there.given == whole.given) &&
         std::equal(there.lines.begin(), there.lines.end(), whole.lines.begin()) &&
         std::equal(samples.begin(), samples.end(), whole.track.samples().begin()) &&
         std::equal(there.frames.begin(), there.frames.end(), whole.frames.begin());
}

bool IsAsWhole(const Scan& there, const Scan& whole) {
  return there.lines.size() == whole.lines.size() && there.frames.size() == whole.frames.size() &&
         there.given.empty() == whole.given.empty() &&
         there.track.samples().size() == whole.track.samples().size() &&
         there.state == whole.state && there.reason == whole.reason;
}

}  // namespace

Result<std::int64_t> CompleteScan(MissionFile& mission, const Scan& whole) {
  FORESIGHT_TRY(const auto found, mission.FindScan(whole.uuid));
  std::int64_t id = 0;
  Scan there;
  if (found) {
    id = *found;
    FORESIGHT_TRY(there, mission.LoadScan(id));
    if (!IsBeginOf(there, whole))
      return Fail(ErrorCode::kInvalidInput,
                  "{}: scan {} is there with other lines or images: it is left as it is",
                  mission.path().string(), id);
    if (IsAsWhole(there, whole)) return id;
    FORESIGHT_CHECK(mission.ContinueScan(id));
  } else {
    FORESIGHT_TRY(id, mission.BeginScan(whole));
  }
  const Status appended = mission.Batch([&] { return AppendMissing(mission, id, whole, there); });
  if (!appended) {
    static_cast<void>(
        mission.EndScan(id, ScanState::kInterrupted, "not all of it could be written"));
    return tl::unexpected(appended.error());
  }
  FORESIGHT_CHECK(mission.EndScan(id, whole.state, whole.reason));
  return id;
}

}  // namespace foresight
