#include "core/calibration/session_tables.h"

#include <cmath>

#include "core/calibration/number_table.h"

namespace foresight {
namespace {

constexpr std::size_t kMostLines = 100000;  // of one file: 40 minutes of a lidar

const NumberTable kCornerTable{{"board", "corner", "u", "v"}, false, "ab"};
const NumberTable kLineTable{{"seq", "time_s", "range_mm"}, true, ""};
const NumberTable kMotorTable{{"time_s", "angle_rad"}, false, ""};

void AppendCorners(char board, const BoardView& view, std::string* text) {
  for (std::size_t i = 0; i < view.corner_ids.size(); ++i)
    fmt::format_to(std::back_inserter(*text), "{},{},{},{}\n", board, view.corner_ids[i],
                   view.pixels[i].x(), view.pixels[i].y());
}

}  // namespace

std::string CornersText(const MountView& view) {
  std::string text = "board,corner,u,v\n";
  if (view.a) AppendCorners('a', *view.a, &text);
  if (view.b) AppendCorners('b', *view.b, &text);
  return text;
}

std::string LinesText(const std::vector<LidarLine>& lines) {
  std::string text = "seq,time_s,range_mm\n";
  for (const LidarLine& line : lines) {
    fmt::format_to(std::back_inserter(text), "{},{}", line.seq, line.time_s);
    for (const std::uint16_t range : line.range_mm)
      fmt::format_to(std::back_inserter(text), ",{}", range);
    text += '\n';
  }
  return text;
}

std::string MotorText(const MotorTrack& track) {
  std::string text = "time_s,angle_rad\n";
  for (const MotorSample& sample : track.samples())
    fmt::format_to(std::back_inserter(text), "{},{}\n", sample.time_s, sample.angle_rad);
  return text;
}

Result<MountView> ReadCorners(const std::filesystem::path& path) {
  MountView view;
  view.source = path.filename().string();
  const auto on_row = [&](int line, std::span<const double> row) -> Status {
    if (row[0] != 0.0 && row[0] != 1.0)
      return Fail(ErrorCode::kBadData, "{}:{}: the board is a or b", path.string(), line);
    if (row[1] < 0.0 || row[1] > 10000.0 || row[1] != std::floor(row[1]))
      return Fail(ErrorCode::kBadData, "{}:{}: {} is no corner", path.string(), line, row[1]);
    auto& board = row[0] == 0.0 ? view.a : view.b;
    if (!board) board.emplace();
    board->corner_ids.push_back(static_cast<int>(row[1]));
    board->pixels.emplace_back(row[2], row[3]);
    return {};
  };
  FORESIGHT_CHECK(ReadNumberTable(path, kCornerTable, on_row));
  return view;
}

Result<std::vector<LidarLine>> ReadLines(const std::filesystem::path& path,
                                         const LidarModel& lidar) {
  std::vector<LidarLine> lines;
  const auto on_row = [&](int number, std::span<const double> row) -> Status {
    if (row.size() - 2 != static_cast<std::size_t>(lidar.beams))
      return Fail(ErrorCode::kBadData, "{}:{}: {} ranges, the rig's lidar has {} beams",
                  path.string(), number, row.size() - 2, lidar.beams);
    if (lines.size() == kMostLines)
      return Fail(ErrorCode::kBadData, "{}:{}: more than {} lines", path.string(), number,
                  kMostLines);
    LidarLine line;
    if (std::abs(row[0]) > 1e15)
      return Fail(ErrorCode::kBadData, "{}:{}: {} is no number of a line", path.string(), number,
                  row[0]);
    line.seq = static_cast<std::int64_t>(row[0]);
    line.time_s = row[1];
    for (const double range : row.subspan(2)) {
      if (range < 0.0 || range > 65535.0 || range != std::floor(range))
        return Fail(ErrorCode::kBadData, "{}:{}: {} is no range in millimetres", path.string(),
                    number, range);
      line.range_mm.push_back(static_cast<std::uint16_t>(range));
    }
    lines.push_back(std::move(line));
    return {};
  };
  FORESIGHT_CHECK(ReadNumberTable(path, kLineTable, on_row));
  return lines;
}

Result<MotorTrack> ReadTrack(const std::filesystem::path& path) {
  std::vector<MotorSample> samples;
  FORESIGHT_CHECK(
      ReadNumberTable(path, kMotorTable, [&](int, std::span<const double> row) -> Status {
        samples.push_back({row[0], row[1]});
        return {};
      }));
  auto track = MotorTrack::FromSamples(std::move(samples));
  if (!track) return Fail(ErrorCode::kBadData, "{}: {}", path.string(), track.error().message);
  return track;
}

}  // namespace foresight
