#include "core/calibration/board_detector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

#include "core/base/contract.h"
#include "core/calibration/charuco_finder.h"
#include "core/calibration/checkerboard_finder.h"
#include "core/calibration/grid_checks.h"
#include "core/calibration/image_rating.h"

namespace foresight {
namespace {

constexpr std::size_t kFewestCorners = 6;

std::string WithFault(std::string text, const GrayImage& image) {
  const std::string fault = ImageFault(image);
  return fault.empty() ? text : fmt::format("{}; {}", text, fault);
}

/// Without what is wrong with the whole image.
struct Miss {
  std::string text;
  bool image_may_say_why = false;
};

Miss WhyNotFound(const GrayImage& image, const CalibrationBoard& board,
                 const CheckerboardSearch& search) {
  const std::string asked = fmt::format("{}x{}", board.columns, board.rows);
  if (!search.other) return {fmt::format("no board of {} inner corners was found", asked), true};
  // Blur and glare make patterns of their own.
  if (const std::string fault = RatingFault(RateImage(image, *search.other)); !fault.empty())
    return {fmt::format("no board of {} inner corners was found; {}", asked, fault)};
  int columns = search.other->columns, rows = search.other->rows;
  // A board has no upright: as it is nearest to what was asked for.
  if (std::abs(columns - board.columns) + std::abs(rows - board.rows) >
      std::abs(rows - board.columns) + std::abs(columns - board.rows))
    std::swap(columns, rows);
  const std::string found = fmt::format("{}x{}", columns, rows);
  if (search.other_is_whole)
    return {
        fmt::format("a board of {} inner corners was found where {} was asked for", found, asked)};
  return {fmt::format("only {} inner corners of a board were found where {} was asked "
                      "for; it may be cut off or covered",
                      found, asked),
          true};
}

BoardDetection DetectCheckerboard(const GrayImage& image, const std::vector<CornerGrid>& grids,
                                  const CalibrationBoard& board, SearchEffort effort,
                                  bool look_at_image) {
  BoardDetection detection;
  CheckerboardSearch search = FindCheckerboard(image, grids, board.columns, board.rows, effort);
  if (!search.grid) {
    Miss miss = WhyNotFound(image, board, search);
    detection.rejection = miss.image_may_say_why && look_at_image
                              ? WithFault(std::move(miss.text), image)
                              : std::move(miss.text);
    return detection;
  }
  // The square beside corner 0 is black. A board that looks the same upside down has no other way.
  if (!board.LooksSameUpsideDown() && MeasureLevels(image, *search.grid).Contrast() < 0.0)
    search.grid = UpsideDown(*search.grid);
  detection.rating = RateImage(image, *search.grid);
  detection.rejection = RatingFault(detection.rating);
  if (!detection.rejection.empty()) return detection;
  const std::vector<int> uncertain = UncertainCorners(image, *search.grid);
  for (int id = 0; id < board.CornerCount(); ++id) {
    if (std::binary_search(uncertain.begin(), uncertain.end(), id)) continue;
    detection.view.corner_ids.push_back(id);
    detection.view.pixels.push_back(search.grid->pixels[static_cast<std::size_t>(id)]);
  }
  return detection;
}

bool InOneLine(const CalibrationBoard& board, const std::vector<int>& ids) {
  std::set<int> columns, rows;
  for (const int id : ids) {
    columns.insert(id % board.columns);
    rows.insert(id / board.columns);
  }
  return columns.size() < 2 || rows.size() < 2;
}

BoardDetection DetectCharuco(const GrayImage& image, const CalibrationBoard& board) {
  BoardDetection detection;
  CharucoSearch search = FindCharuco(image, board);
  const std::string_view dictionary = ToString(board.dictionary);
  if (search.mirrored) {
    detection.rejection = "the image is mirrored: markers were found in its mirror image only";
  } else if (search.markers == 0) {
    detection.rejection =
        WithFault(fmt::format("no marker of the dictionary {} was found", dictionary), image);
  } else if (search.view.corner_ids.size() < kFewestCorners ||
             InOneLine(board, search.view.corner_ids)) {
    detection.rejection = WithFault(
        fmt::format("{} corners beside {} markers were found, at least {} in two rows are needed",
                    search.view.corner_ids.size(), search.markers, kFewestCorners),
        image);
  } else {
    detection.rating = RateView(image, board, search.view);
    if (detection.rating.light_level > 0.0) detection.rejection = RatingFault(detection.rating);
    if (detection.rejection.empty()) detection.view = std::move(search.view);
  }
  return detection;
}

}  // namespace

BoardDetection DetectBoard(const GrayImage& image, const CalibrationBoard& board,
                           SearchEffort effort) {
  FORESIGHT_EXPECTS(board.Check().has_value(), "a board that can be");
  return board.kind == CalibrationBoard::Kind::kCharuco
             ? DetectCharuco(image, board)
             : DetectCheckerboard(image, FindGrids(image), board, effort, true);
}

BoardDetection DetectBoard(const GrayImage& image, const std::vector<CornerGrid>& grids,
                           const CalibrationBoard& board, SearchEffort effort) {
  FORESIGHT_EXPECTS(board.Check().has_value(), "a board that can be");
  return board.kind == CalibrationBoard::Kind::kCharuco
             ? DetectCharuco(image, board)
             : DetectCheckerboard(image, grids, board, effort, false);
}

}  // namespace foresight
