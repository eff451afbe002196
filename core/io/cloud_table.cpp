#include "core/io/cloud_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/base/atomic_file.h"
#include "core/io/cloud_columns.h"
#include "core/io/read_point_cloud.h"

namespace foresight {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

enum class Meaning {
  kX,
  kY,
  kZ,
  kIntensity,
  kLine,
  kBeam,
  kRing,
  kSeconds,
  kNanoseconds,
  kPackedColor,
  kRed,
  kGreen,
  kBlue
};

std::optional<Meaning> MeaningOf(std::string_view name) {
  using enum Meaning;
  struct Name {
    std::string_view name;
    Meaning meaning;
  };
  constexpr Name kNames[] = {{"x", kX},
                             {"y", kY},
                             {"z", kZ},
                             {"intensity", kIntensity},
                             {"i", kIntensity},
                             {"reflectance", kIntensity},
                             {"reflectivity", kIntensity},
                             {"scalar_Intensity", kIntensity},
                             {"line", kLine},
                             {"beam", kBeam},
                             {"ring", kRing},
                             {"time", kSeconds},
                             {"timestamp", kSeconds},
                             {"t", kNanoseconds},
                             {"rgb", kPackedColor},
                             {"rgba", kPackedColor},
                             {"red", kRed},
                             {"green", kGreen},
                             {"blue", kBlue},
                             {"r", kRed},
                             {"g", kGreen},
                             {"b", kBlue},
                             {"diffuse_red", kRed},
                             {"diffuse_green", kGreen},
                             {"diffuse_blue", kBlue}};
  for (const Name& known : kNames)
    if (known.name == name) return known.meaning;
  return std::nullopt;
}

/// Whole numbers of a grid; -1 = none.
std::vector<std::int32_t> AsPlaces(const std::vector<double>& values) {
  std::vector<std::int32_t> places(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool fits = values[i] >= 0.0 && values[i] <= 1e9 && values[i] == std::floor(values[i]);
    places[i] = fits ? static_cast<std::int32_t>(values[i]) : -1;
  }
  return places;
}

std::vector<double> AsSeconds(std::vector<double> values, bool nanoseconds) {
  if (nanoseconds)
    for (double& value : values) value *= 1e-9;
  return values;
}

Rgb8 Unpacked(double bits) {
  const auto packed = static_cast<std::uint32_t>(bits);
  return {static_cast<std::uint8_t>(packed >> 16), static_cast<std::uint8_t>(packed >> 8),
          static_cast<std::uint8_t>(packed)};
}

std::uint8_t AsChannel(double value, bool is_float) {
  const double scaled = is_float ? 255.0 * value : value;
  return static_cast<std::uint8_t>(std::clamp(std::isfinite(scaled) ? scaled : 0.0, 0.0, 255.0));
}

void SetChannel(const NamedColumn& column, std::uint8_t Rgb8::*channel, std::vector<Rgb8>& color) {
  color.resize(column.values.size());
  for (std::size_t i = 0; i < color.size(); ++i)
    color[i].*channel = AsChannel(column.values[i], column.is_float);
}

/// What a text column of a packed colour means: PCL writes the bits as a float.
double ColorBits(double value, bool is_float) {
  if (is_float) return static_cast<double>(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  return value >= 0.0 && value <= 4294967295.0 ? value : 0.0;
}

void TakeOne(NamedColumn& column, Meaning meaning, CloudTable& table) {
  switch (meaning) {
    case Meaning::kX:
    case Meaning::kY:
    case Meaning::kZ: {
      const auto axis = static_cast<Eigen::Index>(meaning);
      table.points.resize(column.values.size(), Eigen::Vector3d::Constant(kNaN));
      for (std::size_t i = 0; i < column.values.size(); ++i)
        table.points[i][axis] = column.values[i];
      return;
    }
    case Meaning::kIntensity:
      table.intensity.assign(column.values.begin(), column.values.end());
      return;
    case Meaning::kLine:
      table.line = AsPlaces(column.values);
      return;
    case Meaning::kBeam:
      table.beam = AsPlaces(column.values);
      return;
    case Meaning::kRing:
      table.ring = AsPlaces(column.values);
      return;
    case Meaning::kSeconds:
      table.time_s = AsSeconds(std::move(column.values), false);
      return;
    case Meaning::kNanoseconds:
      table.time_s = AsSeconds(std::move(column.values), !column.is_float);
      return;
    case Meaning::kPackedColor:
      table.color.resize(column.values.size());
      for (std::size_t i = 0; i < column.values.size(); ++i)
        table.color[i] =
            Unpacked(column.has_color_bits ? column.values[i]
                                           : ColorBits(column.values[i], column.is_float));
      return;
    case Meaning::kRed:
      return SetChannel(column, &Rgb8::r, table.color);
    case Meaning::kGreen:
      return SetChannel(column, &Rgb8::g, table.color);
    case Meaning::kBlue:
      return SetChannel(column, &Rgb8::b, table.color);
  }
}

bool IsText(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  for (const char* known : {".xyz", ".txt", ".csv", ".asc", ".3d", ".pts"})
    if (extension == known) return true;
  return false;
}

void TurnFrom3dtk(CloudTable& table) {
  for (Eigen::Vector3d& p : table.points) p = 0.01 * Eigen::Vector3d(p.z(), -p.x(), p.y());
}

/// A column's name as TakeColumns knows it: without quotes and CloudCompare's "//", in small
/// letters where it is not known as it is written.
std::string ColumnName(std::string_view word) {
  std::string name(word);
  std::erase_if(name, [](char c) { return c == '"' || c == '\'' || c == '/'; });
  if (MeaningOf(name)) return name;
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

/// The names of a text's columns: those of its first line where that has no number, which is taken
/// off; else what three and four columns usually are.
std::vector<std::string> TakeColumnNames(std::string_view& rows, std::size_t& count) {
  std::string_view rest = rows;
  const auto first = TakeLine(rest);
  if (!first) return {};
  const std::vector<std::string_view> words = Words(*first);
  const auto is_number = [](std::string_view word) { return ParseNumber(word).has_value(); };
  if (std::any_of(words.begin(), words.end(), is_number)) {
    std::vector<std::string> usual(words.size());
    constexpr std::array<const char*, 4> kUsual = {"x", "y", "z", "intensity"};
    std::copy_n(kUsual.begin(), std::min<std::size_t>(words.size(), words.size() == 4 ? 4 : 3),
                usual.begin());
    return usual;
  }
  rows = rest;
  --count;
  std::vector<std::string> names;
  for (const std::string_view word : words) names.push_back(ColumnName(word));
  return names;
}

/// A text does not say what its numbers are: times in whole numbers are nanoseconds, and colours
/// are 0 to 255 where any of the three is above 1.
void SetNumberTypes(std::vector<NamedColumn>& columns) {
  const auto is_color = [](const NamedColumn& column) {
    const auto meaning = MeaningOf(column.name);
    return meaning && *meaning >= Meaning::kRed;
  };
  const auto above_one = [](double value) { return value > 1.0; };
  const bool bytes = std::any_of(columns.begin(), columns.end(), [&](const NamedColumn& column) {
    return is_color(column) && std::any_of(column.values.begin(), column.values.end(), above_one);
  });
  for (NamedColumn& column : columns)
    column.is_float =
        is_color(column)
            ? !bytes
            : !std::all_of(column.values.begin(), column.values.end(), [](double value) {
                return !std::isfinite(value) || value == std::floor(value);
              });
}

}  // namespace

bool IsCloudColumn(std::string_view name) {
  return MeaningOf(name).has_value();
}

std::vector<bool> WhichAreCoordinates(const std::vector<NamedColumn>& columns) {
  std::vector<bool> coordinates;
  for (const NamedColumn& column : columns) {
    const auto meaning = MeaningOf(column.name);
    coordinates.push_back(meaning && *meaning <= Meaning::kZ);
  }
  return coordinates;
}

Status TakeColumns(std::vector<NamedColumn> columns, CloudTable& table, const std::string& source) {
  std::array<bool, 3> has_axis{};
  for (NamedColumn& column : columns) {
    const auto meaning = MeaningOf(column.name);
    if (!meaning) continue;
    if (*meaning <= Meaning::kZ) has_axis[static_cast<std::size_t>(*meaning)] = true;
    TakeOne(column, *meaning, table);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!has_axis[axis])
      return Fail(ErrorCode::kBadData, "{}: its points have no number '{}'", source, "xyz"[axis]);
  if (table.height <= 1 || table.width * table.height != table.points.size()) {
    table.width = table.points.size();
    table.height = 1;
  }
  return {};
}

Result<CloudTable> DecodeFloatRecordTable(std::string_view bytes, const std::string& source) {
  FORESIGHT_TRY(std::vector<Eigen::Vector3d> points, DecodeFloatRecords(bytes, source));
  constexpr std::size_t kRecord = 16;
  CloudTable table;
  table.width = points.size();
  table.points = std::move(points);
  const std::vector<double> reflectance =
      ValuesFromColumn(bytes, {CloudScalar::kFloat32, 12, kRecord}, table.points.size(), false);
  table.intensity.assign(reflectance.begin(), reflectance.end());
  return table;
}

Result<CloudTable> DecodeTextTable(std::string_view bytes, const std::string& source) {
  CloudTable table;
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  std::string text(bytes);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::replace(text.begin(), text.end(), ';', ' ');
  // Comments are taken out, so that what is left are rows.
  std::string rows;
  std::size_t count = 0;
  std::string_view rest = text;
  while (const auto line = TakeLine(rest)) {
    const std::vector<std::string_view> words = Words(*line);
    if (words.empty()) continue;
    if (words[0][0] == '#') continue;
    rows.append(*line).push_back('\n');
    if (++count > kMostCloudPoints)
      return Fail(ErrorCode::kBadData, "{}: more than {} points", source, kMostCloudPoints);
  }
  std::string_view numbers = rows;
  const std::vector<std::string> names = TakeColumnNames(numbers, count);
  if (names.size() < 3)
    return Fail(ErrorCode::kBadData, "{}: is no text of points: {} columns in its first line",
                source, names.size());
  std::string_view first_point = numbers;
  if (const auto line = TakeLine(first_point); line && Words(*line).size() != names.size())
    return Fail(ErrorCode::kBadData,
                "{}: its first line names {} columns, the next one has {} numbers", source,
                names.size(), Words(*line).size());
  std::vector<NamedColumn> columns;
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!IsCloudColumn(names[i])) continue;
    columns.push_back({.name = names[i], .values = {}});
    wanted.push_back(i);
  }
  FORESIGHT_TRY(
      std::vector<std::vector<double>> values,
      ColumnsFromText(numbers, wanted, names.size(), count, source, WhichAreCoordinates(columns)));
  for (std::size_t i = 0; i < values.size(); ++i) columns[i].values = std::move(values[i]);
  SetNumberTypes(columns);
  FORESIGHT_CHECK(TakeColumns(std::move(columns), table, source));
  return table;
}

Result<double> MetresIn(const std::string& unit) {
  if (unit == "m") return 1.0;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  return Fail(ErrorCode::kInvalidOptions, "unit '{}' is none of m, cm and mm", unit);
}

void ScaleToMetres(double unit_m, CloudTable& table) {
  for (Eigen::Vector3d& point : table.points) point *= unit_m;
  if (table.viewpoint) *table.viewpoint *= unit_m;
}

Result<CloudTable> ReadCloudTable(const std::filesystem::path& path, double unit_m) {
  FORESIGHT_TRY(const std::string bytes, ReadFile(path));
  const std::string source = path.string();
  CloudTable table;
  if (bytes.empty()) return Fail(ErrorCode::kBadData, "{}: is empty", source);
  if (path.extension() == ".bin") {
    FORESIGHT_TRY(table, DecodeFloatRecordTable(bytes, source));
  } else if (bytes.starts_with("ply")) {
    FORESIGHT_TRY(table, DecodePlyTable(bytes, source));
  } else if (LooksLikePcd(bytes)) {
    FORESIGHT_TRY(table, DecodePcdTable(bytes, source));
  } else if (IsText(path)) {
    FORESIGHT_TRY(table, DecodeTextTable(bytes, source));
  } else {
    return Fail(ErrorCode::kBadData,
                "{}: is no point cloud: neither PLY nor PCD, and its name ends neither in .bin nor "
                "as text of points does (.xyz, .txt, .csv, .asc, .pts, .3d)",
                source);
  }
  if (path.extension() == ".3d")
    TurnFrom3dtk(table);
  else
    ScaleToMetres(unit_m, table);
  FORESIGHT_CHECK(CheckCloudPoints(table.points, source));
  return table;
}

}  // namespace foresight
