#include <algorithm>
#include <array>
#include <optional>

#include "core/io/cloud_columns.h"
#include "core/io/cloud_table.h"
#include "core/io/read_point_cloud.h"
#include "core/io/triangle_mesh.h"

namespace foresight {
namespace {

enum class Format { kAscii, kLittleEndian, kBigEndian };

struct Property {
  std::string_view name;
  CloudScalar type = CloudScalar::kFloat32;
};

struct Element {
  std::string_view name;
  std::size_t count = 0;
  std::vector<Property> properties;
  bool has_list = false;
  /// Of the last list: its length's type and its entries', and how many properties stand before it.
  CloudScalar list_length = CloudScalar::kUint8, list_entry = CloudScalar::kInt32;
  std::size_t before_list = 0;
  int lists = 0;

  std::size_t RecordBytes() const {
    std::size_t bytes = 0;
    for (const Property& property : properties) bytes += SizeOf(property.type);
    return bytes;
  }
};

struct PlyHeader {
  Format format = Format::kAscii;
  std::vector<std::string> comments;
  std::vector<Element> elements;
};

std::optional<CloudScalar> ScalarNamed(std::string_view name) {
  using enum CloudScalar;
  struct Name {
    std::string_view name;
    CloudScalar type;
  };
  constexpr Name kNames[] = {
      {"char", kInt8},     {"int8", kInt8},       {"uchar", kUint8},    {"uint8", kUint8},
      {"short", kInt16},   {"int16", kInt16},     {"ushort", kUint16},  {"uint16", kUint16},
      {"int", kInt32},     {"int32", kInt32},     {"uint", kUint32},    {"uint32", kUint32},
      {"float", kFloat32}, {"float32", kFloat32}, {"double", kFloat64}, {"float64", kFloat64}};
  for (const Name& known : kNames)
    if (known.name == name) return known.type;
  return std::nullopt;
}

Result<Format> FormatNamed(std::string_view name, const std::string& source) {
  if (name == "ascii") return Format::kAscii;
  if (name == "binary_little_endian") return Format::kLittleEndian;
  if (name == "binary_big_endian") return Format::kBigEndian;
  return Fail(ErrorCode::kBadData, "{}: PLY format '{}' is not known", source, name.substr(0, 32));
}

Status ReadHeaderLine(const std::vector<std::string_view>& words, PlyHeader& header,
                      const std::string& source) {
  const auto fail = [&] {
    return Fail(ErrorCode::kBadData, "{}: PLY header: '{} ...' makes no sense", source,
                words[0].substr(0, 32));
  };
  if (words[0] == "comment" || words[0] == "obj_info") return {};
  if (words[0] == "format" && words.size() >= 2) {
    FORESIGHT_TRY(header.format, FormatNamed(words[1], source));
    return {};
  }
  if (words[0] == "element" && words.size() == 3) {
    const auto count = ParseCount(words[2], kMostCloudPoints);
    if (!count)
      return Fail(ErrorCode::kBadData, "{}: '{}' elements '{}' are not 0 to {}", source,
                  words[2].substr(0, 32), words[1].substr(0, 32), kMostCloudPoints);
    Element element;
    element.name = words[1];
    element.count = *count;
    header.elements.push_back(std::move(element));
    return {};
  }
  if (words[0] != "property" || words.size() < 3 || header.elements.empty()) return fail();
  Element& element = header.elements.back();
  if (words[1] == "list") {
    element.has_list = true;
    element.before_list = element.properties.size();
    ++element.lists;
    const auto length = words.size() >= 5 ? ScalarNamed(words[2]) : std::nullopt;
    const auto entry = words.size() >= 5 ? ScalarNamed(words[3]) : std::nullopt;
    if (length && entry) {
      element.list_length = *length;
      element.list_entry = *entry;
    }
    return {};
  }
  const auto type = ScalarNamed(words[1]);
  if (!type) return fail();
  element.properties.push_back({words[2], *type});
  return {};
}

/// Leaves `rest` at the first byte after the header.
Result<PlyHeader> ReadHeaderLines(std::string_view& rest, const std::string& source) {
  PlyHeader header;
  bool has_format = false;
  TakeLine(rest);
  while (const auto line = TakeLine(rest)) {
    const std::vector<std::string_view> words = Words(*line);
    if (words.empty()) continue;
    if (words[0] == "end_header") {
      if (has_format) return header;
      return Fail(ErrorCode::kBadData, "{}: PLY header without a format", source);
    }
    has_format = has_format || words[0] == "format";
    if (words[0] == "comment") header.comments.emplace_back(line->substr(line->find('c') + 7));
    FORESIGHT_CHECK(ReadHeaderLine(words, header, source));
  }
  return Fail(ErrorCode::kBadData, "{}: PLY header without an end", source);
}

Result<std::array<std::size_t, 3>> FindXyz(const Element& vertex, const std::string& source) {
  std::array<std::size_t, 3> at{};
  constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found = std::find_if(vertex.properties.begin(), vertex.properties.end(),
                                    [&](const Property& p) { return p.name == kNames[axis]; });
    if (found == vertex.properties.end())
      return Fail(ErrorCode::kBadData, "{}: its vertices have no '{}'", source, kNames[axis]);
    at[axis] = static_cast<std::size_t>(found - vertex.properties.begin());
  }
  return at;
}

Status SkipElement(const Element& element, Format format, std::string_view& rest,
                   const std::string& source) {
  if (format == Format::kAscii) {
    for (std::size_t i = 0; i < element.count; ++i)
      if (!TakeLine(rest)) return Fail(ErrorCode::kBadData, "{}: ends before its vertices", source);
    return {};
  }
  const std::size_t bytes = element.count * element.RecordBytes();
  if (element.has_list)
    return Fail(ErrorCode::kBadData, "{}: lists of '{}' before the vertices are not read", source,
                element.name.substr(0, 32));
  if (bytes > rest.size()) return Fail(ErrorCode::kBadData, "{}: ends before its vertices", source);
  rest.remove_prefix(bytes);
  return {};
}

CloudColumn ColumnOf(const Element& vertex, std::size_t index) {
  CloudColumn column{vertex.properties[index].type, 0, vertex.RecordBytes()};
  for (std::size_t i = 0; i < index; ++i) column.first += SizeOf(vertex.properties[i].type);
  return column;
}

Status CheckVertices(const Element& vertex, Format format, std::string_view rest,
                     const std::string& source) {
  if (vertex.has_list)
    return Fail(ErrorCode::kBadData, "{}: vertices with lists are not read", source);
  const std::size_t record = vertex.RecordBytes();
  if (format == Format::kAscii || vertex.count * record <= rest.size()) return {};
  return Fail(ErrorCode::kBadData, "{}: {} points need {} bytes, the file has {}", source,
              vertex.count, vertex.count * record, rest.size());
}

Result<std::vector<Eigen::Vector3d>> ReadVertices(const Element& vertex, Format format,
                                                  std::string_view rest,
                                                  const std::string& source) {
  FORESIGHT_TRY(const auto xyz, FindXyz(vertex, source));
  FORESIGHT_CHECK(CheckVertices(vertex, format, rest, source));
  if (format == Format::kAscii)
    return PointsFromText(rest, xyz, vertex.properties.size(), vertex.count, source);
  const std::array<CloudColumn, 3> columns = {ColumnOf(vertex, xyz[0]), ColumnOf(vertex, xyz[1]),
                                              ColumnOf(vertex, xyz[2])};
  return PointsFromColumns(rest, columns, vertex.count, format == Format::kBigEndian);
}

/// Properties that an import knows.
Result<std::vector<NamedColumn>> KnownColumns(const Element& vertex, Format format,
                                              std::string_view rest, const std::string& source) {
  FORESIGHT_CHECK(FindXyz(vertex, source));
  FORESIGHT_CHECK(CheckVertices(vertex, format, rest, source));
  std::vector<NamedColumn> columns;
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
    const Property& property = vertex.properties[i];
    if (!IsCloudColumn(property.name)) continue;
    const bool is_float =
        property.type == CloudScalar::kFloat32 || property.type == CloudScalar::kFloat64;
    columns.push_back({std::string(property.name), is_float, false, {}});
    wanted.push_back(i);
  }
  if (format == Format::kAscii) {
    FORESIGHT_TRY(std::vector<std::vector<double>> values,
                  ColumnsFromText(rest, wanted, vertex.properties.size(), vertex.count, source,
                                  WhichAreCoordinates(columns)));
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].values = std::move(values[i]);
  } else {
    for (std::size_t i = 0; i < columns.size(); ++i)
      columns[i].values = ValuesFromColumn(rest, ColumnOf(vertex, wanted[i]), vertex.count,
                                           format == Format::kBigEndian);
  }
  return columns;
}

/// Calls `read(vertex, format, rest)` with what stands at the vertices.
template <class Read>
auto AtVertices(const PlyHeader& header, std::string_view bytes, const std::string& source,
                const Read& read) -> decltype(read(Element(), Format(), bytes)) {
  for (const Element& element : header.elements) {
    if (element.name == "vertex") return read(element, header.format, bytes);
    FORESIGHT_CHECK(SkipElement(element, header.format, bytes, source));
  }
  return Fail(ErrorCode::kBadData, "{}: PLY without vertices", source);
}

/// A number from the front of `rest`; nullopt where too few bytes are left.
std::optional<double> TakeBinary(CloudScalar type, bool big_endian, std::string_view& rest) {
  const std::size_t size = SizeOf(type);
  if (rest.size() < size) return std::nullopt;
  const double value = ValuesFromColumn(rest.substr(0, size), {type, 0, size}, 1, big_endian)[0];
  rest.remove_prefix(size);
  return value;
}

/// Adds a polygon's triangles; corners are checked later.
void AddFan(const std::vector<double>& corners, std::vector<Eigen::Vector3i>& triangles) {
  const auto index = [&](std::size_t i) {
    return corners[i] >= 0.0 && corners[i] < 1e9 ? static_cast<int>(corners[i]) : -1;
  };
  for (std::size_t i = 2; i < corners.size(); ++i)
    triangles.emplace_back(index(0), index(i - 1), index(i));
}

std::optional<std::vector<double>> TakeBinaryFace(const Element& face, bool big_endian,
                                                  std::string_view& rest) {
  std::vector<double> corners;
  for (std::size_t i = 0; i <= face.properties.size(); ++i) {
    if (i == face.before_list) {
      const auto length = TakeBinary(face.list_length, big_endian, rest);
      if (!length || !(*length >= 0.0) || *length > static_cast<double>(rest.size()))
        return std::nullopt;
      for (int k = 0; k < static_cast<int>(*length); ++k) {
        const auto corner = TakeBinary(face.list_entry, big_endian, rest);
        if (!corner) return std::nullopt;
        corners.push_back(*corner);
      }
    }
    if (i < face.properties.size() && !TakeBinary(face.properties[i].type, big_endian, rest))
      return std::nullopt;
  }
  return corners;
}

std::optional<std::vector<double>> TakeTextFace(const Element& face, std::string_view& rest) {
  const auto line = TakeLine(rest);
  const std::vector<std::string_view> words = line ? Words(*line) : std::vector<std::string_view>();
  if (words.size() <= face.before_list) return std::nullopt;
  const auto length = ParseCount(words[face.before_list], words.size());
  if (!length || words.size() < face.before_list + 1 + *length) return std::nullopt;
  std::vector<double> corners;
  for (std::size_t k = 0; k < *length; ++k) {
    const auto corner = ParseCount(words[face.before_list + 1 + k], kMostCloudPoints);
    if (!corner) return std::nullopt;
    corners.push_back(static_cast<double>(*corner));
  }
  return corners;
}

Result<std::vector<Eigen::Vector3i>> ReadFaces(const Element& face, Format format,
                                               std::string_view rest, const std::string& source) {
  if (face.lists != 1)
    return Fail(ErrorCode::kBadData, "{}: faces with {} lists are not read", source, face.lists);
  std::vector<Eigen::Vector3i> triangles;
  for (std::size_t i = 0; i < face.count; ++i) {
    const auto corners = format == Format::kAscii
                             ? TakeTextFace(face, rest)
                             : TakeBinaryFace(face, format == Format::kBigEndian, rest);
    if (!corners)
      return Fail(ErrorCode::kBadData, "{}: face {} of {} cannot be read", source, i + 1,
                  face.count);
    AddFan(*corners, triangles);
    if (triangles.size() > TriangleMesh::kMostTriangles) break;  // Check says so
  }
  return triangles;
}

Result<PlyHeader> ReadPlyHeader(std::string_view& bytes, const std::string& source) {
  if (!bytes.starts_with("ply\n") && !bytes.starts_with("ply\r\n"))
    return Fail(ErrorCode::kBadData, "{}: is not a PLY file: it does not start with 'ply'", source);
  return ReadHeaderLines(bytes, source);
}

}  // namespace

Result<std::vector<Eigen::Vector3d>> DecodePly(std::string_view bytes, const std::string& source) {
  FORESIGHT_TRY(const PlyHeader header, ReadPlyHeader(bytes, source));
  return AtVertices(header, bytes, source,
                    [&](const Element& vertex, Format format, std::string_view rest) {
                      return ReadVertices(vertex, format, rest, source);
                    });
}

Result<TriangleMesh> DecodePlyMesh(std::string_view bytes, const std::string& source) {
  FORESIGHT_TRY(const PlyHeader header, ReadPlyHeader(bytes, source));
  TriangleMesh mesh;
  bool has_faces = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      FORESIGHT_TRY(mesh.vertices, ReadVertices(element, header.format, bytes, source));
    } else if (element.name == "face") {
      FORESIGHT_TRY(mesh.triangles, ReadFaces(element, header.format, bytes, source));
      has_faces = true;
    }
    if (has_faces && !mesh.vertices.empty()) break;
    FORESIGHT_CHECK(SkipElement(element, header.format, bytes, source));
  }
  FORESIGHT_CHECK(mesh.Check(source));
  return mesh;
}

Result<CloudTable> DecodePlyTable(std::string_view bytes, const std::string& source) {
  FORESIGHT_TRY(PlyHeader header, ReadPlyHeader(bytes, source));
  FORESIGHT_TRY(std::vector<NamedColumn> columns,
                AtVertices(header, bytes, source,
                           [&](const Element& vertex, Format format, std::string_view rest) {
                             return KnownColumns(vertex, format, rest, source);
                           }));
  CloudTable table;
  table.comments = std::move(header.comments);
  FORESIGHT_CHECK(TakeColumns(std::move(columns), table, source));
  return table;
}

}  // namespace foresight
