#include "core/mission/complete_scan.h"

namespace foresight {
namespace {

Status AppendMissing(MissionFile& mission, std::int64_t id, const Scan& whole, const Scan& there,
                     const RunContext& context) {
  const auto all = static_cast<double>(whole.lines.size());
  for (std::size_t i = there.lines.size(); i < whole.lines.size(); ++i) {
    FORESIGHT_CHECK(mission.AppendLine(id, whole.lines[i]));
    context.Report(0.8 * static_cast<double>(i) / all, "writing lines");
  }
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

}  // namespace

Result<std::int64_t> CompleteScan(MissionFile& mission, const Scan& whole,
                                  const RunContext& context) {
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
    FORESIGHT_TRY(const bool all, HoldsAllOf(mission, id, whole));
    if (all) return id;
    FORESIGHT_CHECK(mission.ContinueScan(id));
  } else {
    FORESIGHT_TRY(id, mission.BeginScan(whole));
  }
  const Status appended =
      mission.Batch([&] { return AppendMissing(mission, id, whole, there, context); });
  if (!appended) {  // the next scan must find the file free; the rest can be put in later
    if (const Status ended = mission.EndScan(id, ScanState::kInterrupted, appended.error().message);
        !ended)
      return Fail(appended.error().code, "{}; and the scan could not be ended in the file: {}",
                  appended.error().message, ended.error().message);
    return tl::unexpected(appended.error());
  }
  FORESIGHT_CHECK(mission.EndScan(id, whole.state, whole.reason));
  return id;
}

Result<bool> HoldsAllOf(const MissionFile& mission, std::int64_t id, const Scan& whole) {
  FORESIGHT_TRY(const ScanSummary there, mission.Summary(id));
  FORESIGHT_TRY(const MotorTrack track, mission.LoadTrack(id));
  return there.lines == static_cast<std::int64_t>(whole.lines.size()) &&
         there.images == static_cast<std::int64_t>(whole.frames.size()) &&
         there.imported == !whole.given.empty() &&
         track.samples().size() == whole.track.samples().size() && there.state == whole.state &&
         there.reason == whole.reason;
}

}  // namespace foresight
