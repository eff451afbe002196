#include "core/registration/register_scan.h"

#include <atomic>
#include <limits>
#include <span>

#include "core/base/parallel.h"
#include "core/registration/line_registrar.h"

namespace foresight {
namespace {

/// Its points stand where another program placed them.
Result<RegisteredScan> HandOut(const GivenCloud& given) {
  FORESIGHT_CHECK(given.Check());
  RegisteredScan out;
  out.lines = given.lines;
  out.beams = given.beams;
  out.points = given.points;
  out.origins = given.origins;
  const std::size_t cells = given.points.size();
  if (given.intensity.empty())
    out.intensity.Append(cells, 0.0f);
  else
    out.intensity = given.intensity;
  const std::span<float> range_m =
      out.range_m.Append(cells, std::numeric_limits<float>::quiet_NaN());
  bool any = false;
  for (int line = 0; line < out.lines; ++line) {
    const Eigen::Vector3f& origin = out.origins[static_cast<std::size_t>(line)];
    for (int beam = 0; beam < out.beams; ++beam) {
      const std::size_t i = out.Index(line, beam);
      range_m[i] = (out.points[i] - origin).norm();  // NaN where there is no point
      any = any || range_m[i] > 0.0f;
    }
  }
  if (!any) return Fail(ErrorCode::kTooFewPoints, "no place of the imported cloud has a point");
  return out;
}

}  // namespace

Result<RegisteredScan> RegisterScan(const Scan& scan, const RunContext& context) {
  FORESIGHT_CHECK(scan.rig.Check());
  if (!scan.given.empty()) return HandOut(scan.given);
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
