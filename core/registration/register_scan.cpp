#include "core/registration/register_scan.h"

#include <atomic>

#include "core/base/parallel.h"
#include "core/registration/line_registrar.h"

namespace foresight {

Result<RegisteredScan> RegisterScan(const Scan& scan, const RunContext& context) {
  FORESIGHT_CHECK(scan.rig.Check());
  const LineRegistrar registrar(scan.rig);
  for (const LidarLine& line : scan.lines) FORESIGHT_CHECK(registrar.CheckLine(line));
  RegisteredScan out;
  out.beams = registrar.beams();
  const int lines = static_cast<int>(scan.lines.size());
  const LineRegistrar::Rows rows = LineRegistrar::Append(out, lines);
  std::atomic<std::int64_t> returns{0};
  std::atomic<int> done{0};
  const bool finished = ParallelFor(lines, context, [&](int row) {
    const auto at = static_cast<std::size_t>(row);
    returns += registrar.Place(scan.lines[at], scan.track, rows, at);
    context.Report(static_cast<double>(++done) / lines, "placing lidar lines");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "registration was cancelled");
  if (returns == 0)
    return Fail(ErrorCode::kTooFewPoints,
                "no return in {} lidar lines has a range and a motor angle", lines);
  return out;
}

}  // namespace foresight
