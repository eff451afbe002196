#include "hardware/link/chunks/cloud_items.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/registration/line_registrar.h"
#include "hardware/link/chunks/line_blocks.h"
#include "hardware/link/chunks/value_grid.h"

namespace foresight {
namespace {

constexpr std::uint8_t kCloudForm = 1;
// Beams of a cloud are far apart: neighbours that differ by more than 30 mm lie on a slope.
constexpr int kSmooth = 3;

std::uint16_t UnitsOf(std::uint16_t range_mm) {
  if (range_mm < LidarLine::kFirstValidRange_mm) return 0;
  return static_cast<std::uint16_t>((range_mm + kCloudUnit_mm / 2) / kCloudUnit_mm);
}

double LastBeamTime(const LidarLine& line, const SensorRig& rig) {
  const int beams = static_cast<int>(line.range_mm.size());
  return line.time_s + rig.lidar.BeamTime(std::max(0, beams - 1));
}

/// Whether no later sample changes what the track says of the line's beams.
bool TrackIsFinal(const Scan& scan, const LidarLine& line) {
  const auto samples = scan.track.samples();
  return !samples.empty() &&
         samples.back().time_s > LastBeamTime(line, scan.rig) + MotorTrack::kWindow_s;
}

/// Beams of a cloud's line of so many beams.
std::size_t ThinnedBeams(std::size_t beams, int step) {
  return (beams + static_cast<std::size_t>(step) - 1) / static_cast<std::size_t>(step);
}

CloudLine ThinnedLine(const Scan& scan, const LidarLine& line, int beam_step) {
  CloudLine thinned;
  thinned.seq = line.seq;
  thinned.time_s = line.time_s;
  thinned.first_rad =
      static_cast<float>(scan.track.AngleAt(line.time_s + scan.rig.lidar.BeamTime(0)));
  thinned.last_rad = static_cast<float>(scan.track.AngleAt(LastBeamTime(line, scan.rig)));
  thinned.beams = static_cast<int>(line.range_mm.size());
  for (std::size_t beam = 0; beam < line.range_mm.size();
       beam += static_cast<std::size_t>(beam_step))
    thinned.range_mm.push_back(UnitsOf(line.range_mm[beam]));
  return thinned;
}

/// The line with all beams: those that the cloud left out have no return.
LidarLine FullLine(const CloudLine& thinned, int beam_step) {
  LidarLine line;
  line.seq = thinned.seq;
  line.time_s = thinned.time_s;
  line.range_mm.resize(static_cast<std::size_t>(thinned.beams));
  for (std::size_t i = 0; i < thinned.range_mm.size(); ++i)
    line.range_mm[i * static_cast<std::size_t>(beam_step)] = thinned.range_mm[i];
  return line;
}

/// A straight motion while the line was taken.
MotorTrack TrackOf(const CloudLine& line, const LidarModel& lidar) {
  constexpr int kSteps = 4;  // no gap is longer than MotorTrack::kMaxGap_s up to 0.4 s a turn
  const double first_s = line.time_s + lidar.BeamTime(0);
  const double last_s = line.time_s + lidar.BeamTime(std::max(0, line.beams - 1));
  MotorTrack track;
  if (std::isnan(line.first_rad) || std::isnan(line.last_rad)) return track;
  for (int i = 0; i < kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps;
    track.Add({first_s + part * (last_s - first_s),
               line.first_rad + part * (double{line.last_rad} - line.first_rad)});
  }
  track.Add({last_s, line.last_rad});
  return track;
}

}  // namespace

std::int64_t CloudBlocksOf(const Scan& scan, const CloudStep& step) {
  const auto lines = static_cast<std::int64_t>(scan.lines.size());
  if (scan.state != ScanState::kRunning)
    return (lines + kLinesPerCloudBlock - 1) / kLinesPerCloudBlock;
  const std::int64_t last_of_block = kLinesPerCloudBlock - step.lines;
  std::int64_t blocks = (lines + kLinesPerCloudBlock - 1 - last_of_block) / kLinesPerCloudBlock;
  const auto is_final = [&](std::int64_t block) {
    const std::int64_t line = block * kLinesPerCloudBlock + last_of_block;
    return TrackIsFinal(scan, scan.lines[static_cast<std::size_t>(line)]);
  };
  while (blocks > 0 && !is_final(blocks - 1)) --blocks;
  return blocks;
}

Result<std::string> EncodeCloudBlock(const Scan& scan, std::int64_t block, const CloudStep& step) {
  const auto begin = static_cast<std::size_t>(block * kLinesPerCloudBlock);
  const std::size_t end = std::min(begin + kLinesPerCloudBlock, scan.lines.size());
  std::vector<CloudLine> lines;
  for (std::size_t i = begin; i < end; i += static_cast<std::size_t>(step.lines)) {
    if (scan.lines[i].range_mm.size() > kMostBeamsOfALine)
      return Fail(ErrorCode::kInvalidInput, "lidar line {}: {} beams are more than {}",
                  scan.lines[i].seq, scan.lines[i].range_mm.size(), kMostBeamsOfALine);
    lines.push_back(ThinnedLine(scan, scan.lines[i], step.beams));
  }
  ItemWriter writer;
  writer.U8(kCloudForm).U8(static_cast<std::uint8_t>(step.lines));
  writer.U8(static_cast<std::uint8_t>(step.beams)).U8(static_cast<std::uint8_t>(lines.size()));
  ValueSpans rows;
  for (const CloudLine& line : lines) {
    writer.Signed(line.seq).Double(line.time_s).Float(line.first_rad).Float(line.last_rad);
    writer.Varint(static_cast<std::uint64_t>(line.beams));
    rows.emplace_back(line.range_mm);
  }
  AppendValueGrid(writer, rows, kSmooth);
  return writer.Take();
}

Result<CloudBlock> DecodeCloudBlock(std::string_view bytes) {
  ItemReader reader(bytes);
  if (reader.U8() != kCloudForm) return Fail(ErrorCode::kBadData, "cloud: form is not known");
  CloudBlock block;
  block.step.lines = reader.U8();
  block.step.beams = reader.U8();
  const std::size_t count = reader.U8();
  if (block.step.lines < 1 || block.step.beams < 1 || count > kLinesPerCloudBlock)
    return Fail(ErrorCode::kBadData, "cloud: {} lines of steps {} x {}", count, block.step.lines,
                block.step.beams);
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < count && reader.ok(); ++i) {
    CloudLine line;
    line.seq = reader.Signed();
    line.time_s = reader.Double();
    line.first_rad = reader.Float();
    line.last_rad = reader.Float();
    line.beams = static_cast<int>(reader.Count(kMostBeamsOfALine));
    if (!std::isfinite(line.time_s) || std::isinf(line.first_rad) || std::isinf(line.last_rad))
      return Fail(ErrorCode::kBadData, "cloud: line {}: a time or angle is not finite", line.seq);
    sizes.push_back(ThinnedBeams(static_cast<std::size_t>(line.beams), block.step.beams));
    block.lines.push_back(std::move(line));
  }
  ValueRows rows;
  if (reader.ok()) rows = ReadValueGrid(reader, sizes, kSmooth);
  FORESIGHT_CHECK(reader.Finish("cloud"));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::uint16_t& range : rows[i]) {
      if (range > std::numeric_limits<std::uint16_t>::max() / kCloudUnit_mm)
        range = 0;  // no lidar's
      range = static_cast<std::uint16_t>(range * kCloudUnit_mm);
    }
    block.lines[i].range_mm = std::move(rows[i]);
  }
  return block;
}

PlacedCloud RegisterCloud(const std::vector<const CloudBlock*>& blocks, const SensorRig& rig) {
  const LineRegistrar registrar(rig);
  PlacedCloud cloud;
  cloud.points.beams = registrar.beams();
  for (const CloudBlock* block : blocks)
    for (const CloudLine& thinned : block->lines) {
      if (thinned.beams != registrar.beams()) continue;
      const LineRegistrar::Rows rows = LineRegistrar::Append(cloud.points, 1);
      registrar.Place(FullLine(thinned, block->step.beams), TrackOf(thinned, rig.lidar), rows, 0);
      cloud.seqs.push_back(thinned.seq);
    }
  return cloud;
}

}  // namespace foresight
