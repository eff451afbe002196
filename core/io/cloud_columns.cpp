#include "core/io/cloud_columns.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace foresight {
namespace {

bool IsBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

template <class Number>
double Decoded(const char* bytes, bool swap) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), bytes, raw.size());
  if (swap) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<Number>(raw));
}

double Decoded(const char* bytes, CloudScalar type, bool swap) {
  switch (type) {
    case CloudScalar::kInt8:
      return Decoded<std::int8_t>(bytes, swap);
    case CloudScalar::kUint8:
      return Decoded<std::uint8_t>(bytes, swap);
    case CloudScalar::kInt16:
      return Decoded<std::int16_t>(bytes, swap);
    case CloudScalar::kUint16:
      return Decoded<std::uint16_t>(bytes, swap);
    case CloudScalar::kInt32:
      return Decoded<std::int32_t>(bytes, swap);
    case CloudScalar::kUint32:
      return Decoded<std::uint32_t>(bytes, swap);
    case CloudScalar::kFloat32:
      return Decoded<float>(bytes, swap);
    case CloudScalar::kFloat64:
      return Decoded<double>(bytes, swap);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::size_t SizeOf(CloudScalar type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::vector<Eigen::Vector3d> PointsFromColumns(std::string_view block,
                                               const std::array<CloudColumn, 3>& columns,
                                               std::size_t count, bool big_endian) {
  const bool swap = big_endian != (std::endian::native == std::endian::big);
  std::vector<Eigen::Vector3d> points(count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const CloudColumn& column = columns[axis];
    for (std::size_t i = 0; i < count; ++i)
      points[i][static_cast<Eigen::Index>(axis)] =
          Decoded(block.data() + column.first + i * column.stride, column.type, swap);
  }
  return points;
}

std::vector<double> ValuesFromColumn(std::string_view block, const CloudColumn& column,
                                     std::size_t count, bool big_endian) {
  const bool swap = big_endian != (std::endian::native == std::endian::big);
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = Decoded(block.data() + column.first + i * column.stride, column.type, swap);
  return values;
}

Result<std::vector<std::vector<double>>> ColumnsFromText(std::string_view text,
                                                         std::span<const std::size_t> wanted,
                                                         std::size_t fields, std::size_t count,
                                                         const std::string& source,
                                                         const std::vector<bool>& needed) {
  std::vector<std::vector<double>> columns(wanted.size());
  for (std::size_t point = 0; point < count;) {
    const auto line = TakeLine(text);
    if (!line)
      return Fail(ErrorCode::kBadData, "{}: ends after {} of {} points", source, point, count);
    const std::vector<std::string_view> words = Words(*line);
    if (words.empty()) continue;
    if (words.size() < fields)
      return Fail(ErrorCode::kBadData, "{}: point {} has {} of {} values", source, point,
                  words.size(), fields);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const auto value = ParseNumber(words[wanted[i]]);
      if (!value && (needed.empty() || needed[i]))
        return Fail(ErrorCode::kBadData, "{}: point {}: '{}' is not a number", source, point,
                    words[wanted[i]].substr(0, 32));
      columns[i].push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    ++point;
  }
  return columns;
}

Result<std::vector<Eigen::Vector3d>> PointsFromText(std::string_view text,
                                                    const std::array<std::size_t, 3>& xyz,
                                                    std::size_t fields, std::size_t count,
                                                    const std::string& source) {
  FORESIGHT_TRY(const std::vector<std::vector<double>> columns,
                ColumnsFromText(text, xyz, fields, count, source));
  std::vector<Eigen::Vector3d> points(columns[0].size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = {columns[0][i], columns[1][i], columns[2][i]};
  return points;
}

std::optional<double> ParseNumber(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::optional<std::string_view> TakeLine(std::string_view& rest) {
  if (rest.empty()) return std::nullopt;
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    while (!line.empty() && IsBlank(line.front())) line.remove_prefix(1);
    if (line.empty()) return words;
    const auto end = std::find_if(line.begin(), line.end(), IsBlank);
    const auto length = static_cast<std::size_t>(end - line.begin());
    words.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

std::optional<std::size_t> ParseCount(std::string_view word, std::size_t limit) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value > limit)
    return std::nullopt;
  return value;
}

}  // namespace foresight
