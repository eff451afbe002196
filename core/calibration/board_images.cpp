#include "core/calibration/board_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include "core/base/contract.h"
#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/base/sha256.h"
#include "core/io/image_file.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

/// Blurred against the others: edges this many times wider than the median, and wide.
constexpr double kBlurredAgainstOthers = 3.0;
constexpr double kWideEdge_px = 6.0;

/// By name, with digits compared as numbers: "img9" before "img10".
bool NaturalLess(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto number_end = [&](const std::string& text, std::size_t begin) {
    while (begin < text.size() && is_digit(text[begin])) ++begin;
    return begin;
  };
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
      continue;
    }
    while (i < a.size() && a[i] == '0') ++i;
    while (j < b.size() && b[j] == '0') ++j;
    const std::size_t end_a = number_end(a, i), end_b = number_end(b, j);
    if (end_a - i != end_b - j) return end_a - i < end_b - j;
    const int order = a.compare(i, end_a - i, b, j, end_b - j);
    if (order != 0) return order < 0;
    i = end_a;
    j = end_b;
  }
  if (i == a.size() && j == b.size()) return a < b;
  return i == a.size();
}

struct Size {
  int width = 0;
  int height = 0;
  auto operator<=>(const Size&) const = default;
};

Size MostCommonSize(const std::vector<BoardImage>& results) {
  std::map<Size, int> counts;
  for (const BoardImage& result : results)
    if (result.fault.empty()) ++counts[{result.width, result.height}];
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? Size{} : most->first;
}

void RejectOddOnes(const std::vector<std::string>& names, Size size,
                   std::vector<BoardImage>& results) {
  std::map<std::string, std::size_t> first_with;
  for (std::size_t i = 0; i < results.size(); ++i) {
    BoardImage& result = results[i];
    if (!result.fault.empty()) continue;
    if (Size{result.width, result.height} != size) {
      result.fault = fmt::format("its size is {}x{} where the other images have {}x{}",
                                 result.width, result.height, size.width, size.height);
      continue;
    }
    const auto [at, is_new] = first_with.emplace(result.hash, i);
    if (!is_new) result.fault = fmt::format("the same image as {}", names[at->second]);
  }
}

void RejectBlurred(BoardImages& images) {
  std::vector<double> widths;
  for (const ImageRating& rating : images.ratings)
    if (std::isfinite(rating.edge_width_px)) widths.push_back(rating.edge_width_px);
  if (widths.size() < 3) return;
  const double median = UpperMedian(std::move(widths));
  const double limit = std::max(kBlurredAgainstOthers * median, kWideEdge_px);
  for (std::size_t i = images.images.size(); i-- > 0;) {
    const double width = images.ratings[i].edge_width_px;
    if (!(width > limit)) continue;
    images.rejected.push_back(
        {images.images[i].name,
         fmt::format("blurred: edges are {:.1f} px wide where the other images have {:.1f} px",
                     width, median)});
    images.images.erase(images.images.begin() + static_cast<std::ptrdiff_t>(i));
    images.ratings.erase(images.ratings.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

Result<std::vector<fs::path>> ListImageFiles(const std::vector<std::string>& places) {
  std::vector<fs::path> files;
  for (const std::string& place : places) {
    std::error_code error;
    if (!fs::is_directory(place, error)) {
      if (!fs::exists(place, error))
        return Fail(ErrorCode::kIo, "{}: there is no such file or folder", place);
      files.emplace_back(place);
      continue;
    }
    std::vector<fs::path> inside;
    for (fs::directory_iterator at(place, error), end; !error && at != end; at.increment(error))
      if (HasImageExtension(at->path()) && !at->is_directory(error)) inside.push_back(at->path());
    if (error) return Fail(ErrorCode::kIo, "{}: cannot list: {}", place, error.message());
    if (inside.empty())
      return Fail(ErrorCode::kIo, "{}: the folder holds no .png, .jpg, .jpeg or .pgm file", place);
    std::sort(inside.begin(), inside.end(), [](const fs::path& a, const fs::path& b) {
      return NaturalLess(a.filename().string(), b.filename().string());
    });
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

BoardImage ReadBoardImage(const fs::path& file, const CalibrationBoard& board) {
  const auto image = ReadImageGray(file);
  if (image) return InspectBoardImage(*image, board);
  BoardImage result;
  result.fault = image.error().message;
  if (const std::string prefix = file.string() + ": "; result.fault.starts_with(prefix))
    result.fault.erase(0, prefix.size());  // the file is named beside the reason
  return result;
}

BoardImage InspectBoardImage(const GrayImage& image, const CalibrationBoard& board) {
  BoardImage result;
  result.width = image.width();
  result.height = image.height();
  result.hash =
      Sha256Hex(std::string_view(reinterpret_cast<const char*>(image.data()), image.size()));
  result.detection = DetectBoard(image, board);
  return result;
}

BoardImages SortBoardImages(const std::vector<std::string>& names,
                            std::vector<BoardImage> results) {
  FORESIGHT_EXPECTS(names.size() == results.size(), "each image has a name");
  const Size size = MostCommonSize(results);
  RejectOddOnes(names, size, results);

  BoardImages images;
  images.width = size.width;
  images.height = size.height;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!results[i].fault.empty()) {
      images.rejected.push_back({names[i], results[i].fault});
    } else if (!results[i].detection.rejection.empty()) {
      images.rejected.push_back({names[i], results[i].detection.rejection});
    } else {
      images.images.push_back({names[i], std::move(results[i].detection.view)});
      images.ratings.push_back(results[i].detection.rating);
    }
  }
  RejectBlurred(images);
  return images;
}

Result<BoardImages> DetectBoards(const std::vector<fs::path>& files, const CalibrationBoard& board,
                                 const RunContext& context) {
  std::vector<BoardImage> results(files.size());
  std::atomic<int> done = 0;
  context.Report(0.0, "boards");
  const bool finished = ParallelFor(static_cast<int>(files.size()), context, [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    results[i] = ReadBoardImage(files[i], board);
    context.Report(++done / static_cast<double>(files.size()), "boards");
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "detection of boards was cancelled");
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.string());
  return SortBoardImages(names, std::move(results));
}

}  // namespace foresight
