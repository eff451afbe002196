#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "core/io/cloud_columns.h"
#include "core/io/cloud_table.h"
#include "core/io/read_point_cloud.h"

namespace foresight {
namespace {

struct Field {
  std::string_view name;
  char type = 'F';
  std::size_t size = 4;
  std::size_t count = 1;  ///< values a point

  std::size_t Bytes() const { return size * count; }
  std::optional<CloudScalar> Scalar() const {
    using enum CloudScalar;
    if (type == 'F')
      return size == 4   ? std::optional(kFloat32)
             : size == 8 ? std::optional(kFloat64)
                         : std::nullopt;
    const bool is_signed = type == 'I';
    if (!is_signed && type != 'U') return std::nullopt;
    if (size == 1) return is_signed ? kInt8 : kUint8;
    if (size == 2) return is_signed ? kInt16 : kUint16;
    if (size == 4) return is_signed ? kInt32 : kUint32;
    return std::nullopt;
  }
};

// So that points times bytes cannot overflow.
constexpr std::size_t kMostFields = 1000;
constexpr std::size_t kMostRecordBytes = std::size_t{1} << 20;

struct Header {
  std::vector<Field> fields;
  std::size_t points = 0;
  std::size_t width = 0;  ///< 0 = not said
  std::size_t height = 0;
  std::vector<std::string> comments;
  std::optional<Eigen::Vector3d> viewpoint;
  std::string_view data;  ///< ascii, binary, binary_compressed

  std::size_t RecordBytes() const {
    std::size_t bytes = 0;
    for (const Field& field : fields) bytes += field.Bytes();
    return bytes;
  }
};

/// SIZE, TYPE and COUNT: one word a field.
Status ReadFieldWords(const std::vector<std::string_view>& words, std::vector<Field>& fields,
                      const std::string& source) {
  constexpr std::size_t kLargest = 4096;
  if (words.size() != fields.size() + 1)
    return Fail(ErrorCode::kBadData, "{}: PCD header: {} has {} words for {} fields", source,
                words[0], words.size() - 1, fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string_view word = words[i + 1];
    if (words[0] == "TYPE") {
      fields[i].type = word[0];
      continue;
    }
    const auto number = ParseCount(word, kLargest);
    if (!number)
      return Fail(ErrorCode::kBadData, "{}: PCD header: {} '{}' is not 0 to {}", source, words[0],
                  word.substr(0, 32), kLargest);
    (words[0] == "SIZE" ? fields[i].size : fields[i].count) = *number;
  }
  return {};
}

/// Where the points were measured from; nullopt where it cannot be read.
std::optional<Eigen::Vector3d> ViewpointFrom(const std::vector<std::string_view>& words) {
  if (words.size() < 4) return std::nullopt;
  std::string row;
  for (std::size_t i = 1; i < 4; ++i) row.append(words[i]).push_back(' ');
  constexpr std::array<std::size_t, 3> kXyz = {0, 1, 2};
  const auto point = PointsFromText(row, kXyz, 3, 1, "");
  if (!point || !point->front().allFinite()) return std::nullopt;
  return point->front();
}

/// Leaves `rest` at the first byte after the header.
Result<Header> ReadHeader(std::string_view& rest, const std::string& source) {
  Header header;
  std::optional<std::size_t> width, height, points;
  while (const auto line = TakeLine(rest)) {
    const std::vector<std::string_view> words = Words(*line);
    if (words.empty()) continue;
    if (words[0].starts_with('#')) {
      header.comments.emplace_back(line->substr(line->find('#') + 1));
      continue;
    }
    const std::string_view second = words.size() > 1 ? words[1] : std::string_view();
    if (words[0] == "FIELDS") {
      for (std::size_t i = 1; i < words.size(); ++i) header.fields.push_back({words[i], 'F', 4, 1});
    } else if (words[0] == "SIZE" || words[0] == "TYPE" || words[0] == "COUNT") {
      FORESIGHT_CHECK(ReadFieldWords(words, header.fields, source));
    } else if (words[0] == "WIDTH") {
      width = ParseCount(second, kMostCloudPoints);
    } else if (words[0] == "HEIGHT") {
      height = ParseCount(second, kMostCloudPoints);
    } else if (words[0] == "POINTS") {
      points = ParseCount(second, kMostCloudPoints);
    } else if (words[0] == "DATA") {
      header.data = second;
      break;
    } else if (words[0] == "VIEWPOINT") {
      header.viewpoint = ViewpointFrom(words);
    } else if (words[0] != "VERSION") {
      return Fail(ErrorCode::kBadData, "{}: PCD header: '{}' is not known", source,
                  words[0].substr(0, 32));
    }
  }
  if (!points && width && height) points = *width * *height;
  if (header.data.empty() || !points || *points > kMostCloudPoints)
    return Fail(ErrorCode::kBadData, "{}: PCD header without DATA, or without 0 to {} points",
                source, kMostCloudPoints);
  header.points = *points;
  header.width = width.value_or(0);
  header.height = height.value_or(0);
  if (header.fields.size() > kMostFields || header.RecordBytes() > kMostRecordBytes)
    return Fail(ErrorCode::kBadData, "{}: PCD header: {} fields of {} bytes a point are too many",
                source, header.fields.size(), header.RecordBytes());
  return header;
}

/// Where x, y and z are among the fields.
Result<std::array<std::size_t, 3>> FindXyz(const Header& header, const std::string& source) {
  std::array<std::size_t, 3> at{};
  constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found = std::find_if(header.fields.begin(), header.fields.end(),
                                    [&](const Field& f) { return f.name == kNames[axis]; });
    if (found == header.fields.end() || !found->Scalar() || found->count != 1)
      return Fail(ErrorCode::kBadData, "{}: its points have no number '{}'", source, kNames[axis]);
    at[axis] = static_cast<std::size_t>(found - header.fields.begin());
  }
  return at;
}

/// Undoes LZF; nullopt where the bytes are damaged or the result has another length.
std::optional<std::string> UndoLzf(std::string_view in, std::size_t length) {
  std::string out;
  out.reserve(length);
  std::size_t at = 0;
  const auto next = [&] { return static_cast<std::size_t>(static_cast<unsigned char>(in[at++])); };
  while (at < in.size()) {
    const std::size_t control = next();
    if (control < 32) {  // literals
      if (control + 1 > in.size() - at || control + 1 > length - out.size()) return std::nullopt;
      out.append(in.substr(at, control + 1));
      at += control + 1;
      continue;
    }
    std::size_t copied = control >> 5;
    if (copied == 7) {
      if (at >= in.size()) return std::nullopt;
      copied += next();
    }
    copied += 2;
    if (at >= in.size()) return std::nullopt;
    const std::size_t back = ((control & 31) << 8 | next()) + 1;
    if (back > out.size() || copied > length - out.size()) return std::nullopt;
    for (std::size_t i = 0; i < copied; ++i) out.push_back(out[out.size() - back]);
  }
  if (out.size() != length) return std::nullopt;
  return out;
}

/// The field values of a compressed file: all x, then all y, ...
Result<std::string> Decompress(const Header& header, std::string_view rest,
                               const std::string& source) {
  // LZF cannot expand more than this: a small file that claims a large cloud is damaged.
  constexpr std::size_t kMaxExpansion = 132;
  std::uint32_t compressed = 0, whole = 0;
  if (rest.size() >= 8) {
    std::memcpy(&compressed, rest.data(), 4);
    std::memcpy(&whole, rest.data() + 4, 4);
    rest.remove_prefix(8);
  }
  if (compressed == 0 || compressed > rest.size() ||
      whole != header.points * header.RecordBytes() ||
      whole > std::size_t{compressed} * kMaxExpansion)
    return Fail(ErrorCode::kBadData,
                "{}: is truncated or damaged: {} compressed bytes for {} points", source,
                std::min<std::size_t>(compressed, rest.size()), header.points);
  auto block = UndoLzf(rest.substr(0, compressed), whole);
  if (!block) return Fail(ErrorCode::kBadData, "{}: its compressed points are damaged", source);
  return std::move(*block);
}

CloudColumn ColumnOf(const Header& header, std::size_t index, CloudScalar type,
                     bool field_by_field) {
  std::size_t before = 0;
  for (std::size_t i = 0; i < index; ++i) before += header.fields[i].Bytes();
  const Field& field = header.fields[index];
  return {type, field_by_field ? before * header.points : before,
          field_by_field ? field.Bytes() : header.RecordBytes()};
}

std::array<CloudColumn, 3> ColumnsOf(const Header& header, const std::array<std::size_t, 3>& xyz,
                                     bool field_by_field) {
  std::array<CloudColumn, 3> columns;
  for (std::size_t axis = 0; axis < 3; ++axis)
    columns[axis] = ColumnOf(header, xyz[axis], *header.fields[xyz[axis]].Scalar(), field_by_field);
  return columns;
}

/// The word of each field in a line of text: a field of several values is several words.
std::vector<std::size_t> WordsOfFields(const Header& header, std::size_t& all) {
  std::vector<std::size_t> first;
  all = 0;
  for (const Field& field : header.fields) {
    first.push_back(all);
    all += field.count;
  }
  return first;
}

/// The block of a binary file; `storage` holds it where it was compressed.
Result<std::string_view> BinaryBlock(const Header& header, std::string_view bytes,
                                     std::string& storage, const std::string& source) {
  if (header.data == "binary") {
    const std::size_t needed = header.points * header.RecordBytes();
    if (needed > bytes.size())
      return Fail(ErrorCode::kBadData, "{}: {} points need {} bytes, the file has {}", source,
                  header.points, needed, bytes.size());
    return bytes;
  }
  if (header.data != "binary_compressed")
    return Fail(ErrorCode::kBadData, "{}: PCD data '{}' is not known", source,
                header.data.substr(0, 32));
  FORESIGHT_TRY(storage, Decompress(header, bytes, source));
  return std::string_view(storage);
}

/// Fields that an import knows, with one value a point.
Result<std::vector<NamedColumn>> KnownColumns(const Header& header, std::string_view bytes,
                                              const std::string& source) {
  std::vector<NamedColumn> columns;
  std::vector<std::size_t> fields;
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const Field& field = header.fields[i];
    if (!IsCloudColumn(field.name) || field.count != 1 || !field.Scalar()) continue;
    columns.push_back({std::string(field.name), field.type == 'F', false, {}});
    fields.push_back(i);
  }
  if (header.data == "ascii") {
    std::size_t words = 0;
    const std::vector<std::size_t> first = WordsOfFields(header, words);
    std::vector<std::size_t> wanted;
    for (const std::size_t field : fields) wanted.push_back(first[field]);
    FORESIGHT_TRY(
        std::vector<std::vector<double>> values,
        ColumnsFromText(bytes, wanted, words, header.points, source, WhichAreCoordinates(columns)));
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].values = std::move(values[i]);
    return columns;
  }
  std::string storage;
  FORESIGHT_TRY(const std::string_view block, BinaryBlock(header, bytes, storage, source));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Field& field = header.fields[fields[i]];
    columns[i].has_color_bits = field.name.starts_with("rgb") && field.size == 4;
    const CloudScalar type = columns[i].has_color_bits ? CloudScalar::kUint32 : *field.Scalar();
    columns[i].values = ValuesFromColumn(
        block, ColumnOf(header, fields[i], type, header.data != "binary"), header.points, false);
  }
  return columns;
}

}  // namespace

Result<std::vector<Eigen::Vector3d>> DecodePcd(std::string_view bytes, const std::string& source) {
  FORESIGHT_TRY(const Header header, ReadHeader(bytes, source));
  FORESIGHT_TRY(const auto xyz, FindXyz(header, source));
  if (header.data == "ascii") {
    std::size_t words = 0;
    const std::vector<std::size_t> first = WordsOfFields(header, words);
    return PointsFromText(bytes, {first[xyz[0]], first[xyz[1]], first[xyz[2]]}, words,
                          header.points, source);
  }
  std::string storage;
  FORESIGHT_TRY(const std::string_view block, BinaryBlock(header, bytes, storage, source));
  return PointsFromColumns(block, ColumnsOf(header, xyz, header.data != "binary"), header.points,
                           false);
}

Result<CloudTable> DecodePcdTable(std::string_view bytes, const std::string& source) {
  FORESIGHT_TRY(Header header, ReadHeader(bytes, source));
  FORESIGHT_CHECK(FindXyz(header, source));
  FORESIGHT_TRY(std::vector<NamedColumn> columns, KnownColumns(header, bytes, source));
  CloudTable table;
  table.width = header.width;
  table.height = header.height;
  table.comments = std::move(header.comments);
  table.viewpoint = header.viewpoint;
  FORESIGHT_CHECK(TakeColumns(std::move(columns), table, source));
  return table;
}

}  // namespace foresight
