#include "core/objects/calibration_board.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

#include "core/base/contract.h"
#include "core/objects/board_dictionaries.h"

namespace foresight {
namespace {

constexpr int kFewestCorners = 3;
constexpr int kMostCorners = 60;
constexpr double kSmallestSquare_m = 0.0005;
constexpr double kLargestSquare_m = 5.0;

struct DictionaryRow {
  CalibrationBoard::Dictionary dictionary;
  std::string_view name;
  int markers;
};
using D = CalibrationBoard::Dictionary;
constexpr std::array<DictionaryRow, 9> kDictionaries = {{{D::k4x4_50, "4x4_50", 50},
                                                         {D::k4x4_100, "4x4_100", 100},
                                                         {D::k4x4_250, "4x4_250", 250},
                                                         {D::k5x5_50, "5x5_50", 50},
                                                         {D::k5x5_100, "5x5_100", 100},
                                                         {D::k5x5_250, "5x5_250", 250},
                                                         {D::k6x6_50, "6x6_50", 50},
                                                         {D::k6x6_100, "6x6_100", 100},
                                                         {D::k6x6_250, "6x6_250", 250}}};

const DictionaryRow& RowOf(D dictionary) {
  for (const DictionaryRow& row : kDictionaries)
    if (row.dictionary == dictionary) return row;
  FORESIGHT_EXPECTS(false, "a dictionary of the enumeration");
  return kDictionaries.front();
}

std::vector<std::string_view> Split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

template <class T>
bool ReadNumber(std::string_view text, T& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size();
}

/// The shortest number of millimetres that comes back as this number of metres.
std::string Millimetres(double length_m) {
  for (int digits = 4; digits < 17; ++digits) {
    const std::string text = fmt::format("{:.{}g}", 1000.0 * length_m, digits);
    double length_mm = 0.0;
    if (ReadNumber(text, length_mm) && length_mm / 1000.0 == length_m) return text;
  }
  return fmt::format("{:.17g}", 1000.0 * length_m);
}

constexpr const char* kForm =
    "expected checkerboard:COLUMNSxROWS:SQUARE_MM, or charuco:COLUMNSxROWS:SQUARE_MM[:MARKER_MM"
    "[:DICTIONARY]], with the inner corners a row and a column, e.g. checkerboard:7x6:50";

Result<D> DictionaryFromText(std::string_view text) {
  std::string names;
  for (const DictionaryRow& row : kDictionaries) {
    if (row.name == text) return row.dictionary;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", row.name);
  }
  return Fail(ErrorCode::kInvalidOptions, "dictionary '{}' is not known; known are {}", text,
              names);
}

Status ReadCharucoParts(const std::vector<std::string_view>& parts, double square_mm,
                        CalibrationBoard& board) {
  if (parts.size() > 3) {
    double marker_mm = 0.0;
    if (!ReadNumber(parts[3], marker_mm))
      return Fail(ErrorCode::kInvalidOptions, "side of a marker '{}' is not a number of mm",
                  parts[3]);
    board.marker_per_square = marker_mm / square_mm;
  }
  if (parts.size() > 4) {
    FORESIGHT_TRY(board.dictionary, DictionaryFromText(parts[4]));
  }
  return {};
}

Result<CalibrationBoard> ReadParts(std::string_view text) {
  const std::vector<std::string_view> parts = Split(text, ':');
  CalibrationBoard board;
  const bool charuco = parts[0] == "charuco";
  if (!charuco && parts[0] != "checkerboard")
    return Fail(ErrorCode::kInvalidOptions, "'{}' is no kind of board; {}", parts[0], kForm);
  if (charuco) board.kind = CalibrationBoard::Kind::kCharuco;
  if (parts.size() < 3 || parts.size() > (charuco ? 5u : 3u))
    return Fail(ErrorCode::kInvalidOptions, "{} parts between colons; {}", parts.size(), kForm);
  const std::vector<std::string_view> counts = Split(parts[1], 'x');
  if (counts.size() != 2 || !ReadNumber(counts[0], board.columns) ||
      !ReadNumber(counts[1], board.rows))
    return Fail(ErrorCode::kInvalidOptions, "'{}' is not COLUMNSxROWS; {}", parts[1], kForm);
  double square_mm = 0.0;
  if (!ReadNumber(parts[2], square_mm))
    return Fail(ErrorCode::kInvalidOptions, "side of a square '{}' is not a number of mm; {}",
                parts[2], kForm);
  board.square_m = square_mm / 1000.0;
  if (charuco) FORESIGHT_CHECK(ReadCharucoParts(parts, square_mm, board));
  FORESIGHT_CHECK(board.Check());
  return board;
}

}  // namespace

Status CalibrationBoard::Check() const {
  for (const auto& [what, count] : {std::pair("columns", columns), std::pair("rows", rows)})
    if (count < kFewestCorners || count > kMostCorners)
      return Fail(ErrorCode::kInvalidOptions,
                  "board: {} {} of inner corners is not between {} and {}", count, what,
                  kFewestCorners, kMostCorners);
  if (!(square_m >= kSmallestSquare_m) || !(square_m <= kLargestSquare_m))
    return Fail(ErrorCode::kInvalidOptions,
                "board: side of a square {} mm is not between {} and {} mm", 1000.0 * square_m,
                1000.0 * kSmallestSquare_m, 1000.0 * kLargestSquare_m);
  if (kind == Kind::kCheckerboard) return {};
  if (!(marker_per_square >= 0.3) || !(marker_per_square <= 0.95))
    return Fail(ErrorCode::kInvalidOptions,
                "board: side of a marker {} mm is not between 0.3 and 0.95 of a square's {} mm",
                1000.0 * marker_per_square * square_m, 1000.0 * square_m);
  if (const int available = foresight::MarkerCount(dictionary); MarkerCount() > available)
    return Fail(ErrorCode::kInvalidOptions,
                "board: {} markers are needed, but dictionary {} has {}; take a larger one",
                MarkerCount(), foresight::ToString(dictionary), available);
  return {};
}

Eigen::Vector3d CalibrationBoard::Corner(int id, const BoardWarp& warp) const {
  FORESIGHT_EXPECTS(id >= 0 && id < CornerCount(), "a corner's id");
  const double z = CornerByWarp(id).dot(Eigen::Vector2d(warp.x_m, warp.y_m));
  return {(id % columns) * square_m, (id / columns) * square_m, z};
}

Eigen::Vector2d CalibrationBoard::CornerByWarp(int id) const {
  const double x = 2.0 * (id % columns) / (columns - 1) - 1.0;
  const double y = 2.0 * (id / columns) / (rows - 1) - 1.0;
  return {1.0 - x * x, 1.0 - y * y};
}

std::array<Eigen::Vector3d, 4> CalibrationBoard::Outline() const {
  const double left = -square_m, right = columns * square_m;
  const double top = -square_m, bottom = rows * square_m;
  return {Eigen::Vector3d(left, top, 0.0), Eigen::Vector3d(right, top, 0.0),
          Eigen::Vector3d(right, bottom, 0.0), Eigen::Vector3d(left, bottom, 0.0)};
}

int CalibrationBoard::MarkerAt(int column, int row) const {
  if (kind == Kind::kCheckerboard || IsBlack(column, row)) return -1;
  // White squares before this one, in the rows above and in its own.
  return (row * (columns + 1)) / 2 + column / 2;
}

int CalibrationBoard::MarkerCount() const {
  return kind == Kind::kCheckerboard ? 0 : (columns + 1) * (rows + 1) / 2;
}

std::vector<CalibrationBoard::Dictionary> BoardDictionaries() {
  std::vector<D> all;
  for (const DictionaryRow& row : kDictionaries) all.push_back(row.dictionary);
  return all;
}

std::string_view ToString(CalibrationBoard::Dictionary dictionary) {
  return RowOf(dictionary).name;
}

int MarkerCount(CalibrationBoard::Dictionary dictionary) {
  return RowOf(dictionary).markers;
}

std::string ToText(const CalibrationBoard& board) {
  const std::string text =
      fmt::format("{}x{}:{}", board.columns, board.rows, Millimetres(board.square_m));
  if (board.kind == CalibrationBoard::Kind::kCheckerboard) return "checkerboard:" + text;
  return fmt::format("charuco:{}:{:.9g}:{}", text,
                     1000.0 * board.square_m * board.marker_per_square, ToString(board.dictionary));
}

Result<CalibrationBoard> CalibrationBoardFromText(std::string_view text) {
  auto board = ReadParts(text);
  if (!board)
    return Fail(ErrorCode::kInvalidOptions, "board '{}': {}", text, board.error().message);
  return board;
}

Status BoardView::Check(const CalibrationBoard& board) const {
  FORESIGHT_CHECK(board.Check());
  if (corner_ids.size() != pixels.size())
    return Fail(ErrorCode::kInvalidInput, "view of a board: {} corners have {} pixels",
                corner_ids.size(), pixels.size());
  std::vector<bool> seen(static_cast<std::size_t>(board.CornerCount()), false);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int id = corner_ids[i];
    if (id < 0 || id >= board.CornerCount())
      return Fail(ErrorCode::kInvalidInput, "view of a board: corner {} is not one of {}", id,
                  board.CornerCount());
    if (seen[static_cast<std::size_t>(id)])
      return Fail(ErrorCode::kInvalidInput, "view of a board: corner {} occurs twice", id);
    seen[static_cast<std::size_t>(id)] = true;
    if (!pixels[i].allFinite())
      return Fail(ErrorCode::kInvalidInput, "view of a board: corner {} has no finite pixel", id);
  }
  return {};
}

}  // namespace foresight
