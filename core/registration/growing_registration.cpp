#include "core/registration/growing_registration.h"

#include <numeric>

#include "core/base/parallel.h"
#include "core/registration/final_part.h"

namespace foresight {

Result<RegisteredScan> GrowingRegistration::Update(const Scan& scan, const RunContext& context) {
  if (!registrar_ || scan.uuid != uuid_ || static_cast<int>(scan.lines.size()) < final_lines_) {
    *this = {};
    FORESIGHT_CHECK(scan.rig.Check());
    uuid_ = scan.uuid;
    registrar_.emplace(scan.rig);
    scan_.beams = registrar_->beams();
  }
  auto grown = Grow(scan, context);
  if (!grown && grown.error().code != ErrorCode::kTooFewPoints) *this = {};
  return grown;
}

int GrowingRegistration::NewFinalLines(const Scan& scan) const {
  auto next = static_cast<std::size_t>(final_lines_);
  while (next < scan.lines.size() && IsFinal(scan.lines[next], scan)) ++next;
  return static_cast<int>(next) - final_lines_;
}

Result<RegisteredScan> GrowingRegistration::Grow(const Scan& scan, const RunContext& context) {
  const auto first = static_cast<std::size_t>(final_lines_);
  for (std::size_t i = first; i < scan.lines.size(); ++i)
    FORESIGHT_CHECK(registrar_->CheckLine(scan.lines[i]));
  const int final_lines = NewFinalLines(scan);
  const int lines = scan.state == ScanState::kRunning
                        ? final_lines
                        : static_cast<int>(scan.lines.size()) - final_lines_;
  const std::size_t points = first * static_cast<std::size_t>(scan_.beams);
  scan_.lines = final_lines_;
  scan_.points.Truncate(points);
  scan_.range_m.Truncate(points);
  scan_.intensity.Truncate(points);
  scan_.origins.Truncate(first);
  const LineRegistrar::Rows rows = LineRegistrar::Append(scan_, lines);
  std::vector<int> returns(static_cast<std::size_t>(lines));
  const bool finished = ParallelFor(lines, context, [&](int row) {
    const auto at = static_cast<std::size_t>(row);
    returns[at] = registrar_->Place(scan.lines[first + at], scan.track, rows, at);
  });
  lines_placed_ = lines;
  if (!finished) return Fail(ErrorCode::kCancelled, "registration was cancelled");

  final_lines_ += final_lines;
  const auto new_final = returns.begin() + final_lines;
  const std::int64_t all =
      final_returns_ + std::accumulate(returns.begin(), returns.end(), std::int64_t{0});
  final_returns_ += std::accumulate(returns.begin(), new_final, std::int64_t{0});
  if (all == 0)
    return Fail(ErrorCode::kTooFewPoints,
                "no return in {} lidar lines has a range and a motor angle", scan_.lines);
  return scan_;
}

}  // namespace foresight
