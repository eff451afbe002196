#include "hardware/link/chunks/line_blocks.h"

#include <algorithm>
#include <cmath>

#include "hardware/link/chunks/item_bytes.h"
#include "hardware/link/chunks/value_grid.h"

namespace foresight {
namespace {

constexpr std::uint8_t kRangesForm = 1;
constexpr std::uint8_t kIntensitiesForm = 1;
// Neighbours that differ by less are noise: found by trial on the room scene.
constexpr int kSmoothRange_mm = 30;
constexpr int kSmoothIntensity = 400;

/// Numbers of values: one for all lines where they agree.
void AppendSizes(ItemWriter& writer, const ValueSpans& rows) {
  writer.U8(static_cast<std::uint8_t>(rows.size()));
  const bool same = std::all_of(rows.begin(), rows.end(),
                                [&](const auto& row) { return row.size() == rows.front().size(); });
  writer.U8(same ? 1 : 0);
  for (const auto& row : rows) {
    writer.Varint(row.size());
    if (same) break;
  }
}

std::vector<std::size_t> ReadSizes(ItemReader& reader) {
  const std::size_t lines = reader.U8();
  const std::uint8_t same = reader.U8();
  if (lines < 1 || lines > kLinesPerBlock || same > 1) reader.SetFailed();
  std::vector<std::size_t> sizes;
  while (reader.ok() && sizes.size() < lines)
    sizes.push_back(same == 1 && !sizes.empty() ? sizes.front() : reader.Count(kMostBeamsOfALine));
  return sizes;
}

Status CheckBlock(std::span<const LidarLine* const> lines) {
  if (lines.empty() || lines.size() > kLinesPerBlock)
    return Fail(ErrorCode::kInvalidInput, "{} lines are no block of 1 to {}", lines.size(),
                kLinesPerBlock);
  for (const LidarLine* line : lines) {
    if (std::max(line->range_mm.size(), line->intensity.size()) > kMostBeamsOfALine)
      return Fail(ErrorCode::kInvalidInput, "lidar line {}: {} beams are more than {}", line->seq,
                  std::max(line->range_mm.size(), line->intensity.size()), kMostBeamsOfALine);
    if (!std::isfinite(line->time_s))
      return Fail(ErrorCode::kInvalidInput, "lidar line {}: time {} is not finite", line->seq,
                  line->time_s);
  }
  return {};
}

}  // namespace

Result<std::string> EncodeRanges(std::span<const LidarLine* const> lines) {
  FORESIGHT_CHECK(CheckBlock(lines));
  ValueSpans rows;
  std::vector<double> times_s;
  for (const LidarLine* line : lines) {
    rows.emplace_back(line->range_mm);
    times_s.push_back(line->time_s);
  }
  ItemWriter writer;
  writer.U8(kRangesForm);
  AppendSizes(writer, rows);
  std::uint64_t expected = 0;
  for (const LidarLine* line : lines) {
    const auto seq = static_cast<std::uint64_t>(line->seq);
    writer.Signed(static_cast<std::int64_t>(seq - expected));
    expected = seq + 1;
  }
  AppendEvenDoubles(writer, times_s);
  AppendValueGrid(writer, rows, kSmoothRange_mm);
  return writer.Take();
}

Result<std::vector<LidarLine>> DecodeRanges(std::string_view bytes) {
  ItemReader reader(bytes);
  if (reader.U8() != kRangesForm) return Fail(ErrorCode::kBadData, "ranges: form is not known");
  const std::vector<std::size_t> sizes = ReadSizes(reader);
  std::vector<LidarLine> lines(sizes.size());
  std::uint64_t expected = 0;
  for (LidarLine& line : lines) {
    expected += static_cast<std::uint64_t>(reader.Signed());
    line.seq = static_cast<std::int64_t>(expected++);
  }
  const std::vector<double> times_s = ReadEvenDoubles(reader, lines.size());
  ValueRows rows;
  if (reader.ok()) rows = ReadValueGrid(reader, sizes, kSmoothRange_mm);
  FORESIGHT_CHECK(reader.Finish("ranges"));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].time_s = times_s[i];
    lines[i].range_mm = std::move(rows[i]);
    if (!std::isfinite(times_s[i]))
      return Fail(ErrorCode::kBadData, "ranges: line {}: time {} is not finite", lines[i].seq,
                  times_s[i]);
  }
  return lines;
}

Result<std::string> EncodeIntensities(std::span<const LidarLine* const> lines) {
  FORESIGHT_CHECK(CheckBlock(lines));
  ValueSpans rows;
  for (const LidarLine* line : lines) rows.emplace_back(line->intensity);
  ItemWriter writer;
  writer.U8(kIntensitiesForm);
  AppendSizes(writer, rows);
  AppendValueGrid(writer, rows, kSmoothIntensity);
  return writer.Take();
}

Result<IntensityBlock> DecodeIntensities(std::string_view bytes) {
  ItemReader reader(bytes);
  if (reader.U8() != kIntensitiesForm)
    return Fail(ErrorCode::kBadData, "intensities: form is not known");
  const std::vector<std::size_t> sizes = ReadSizes(reader);
  IntensityBlock rows;
  if (reader.ok()) rows = ReadValueGrid(reader, sizes, kSmoothIntensity);
  FORESIGHT_CHECK(reader.Finish("intensities"));
  return rows;
}

}  // namespace foresight
