#include "core/exchange/gltf_colors.h"

#include <vtkBase64Utilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace foresight {
namespace {

constexpr int kUnsignedShort = 5123;  // glTF 2.0, section 3.6.2.2
constexpr int kTriangles = 4;
constexpr Rgb8 kUnpainted = {128, 128, 128};

/// A file's colours are sRGB, those of a glTF vertex are linear (section 3.7.2.1). IEC 61966-2-1.
std::array<std::uint16_t, 256> LinearOfSrgb() {
  std::array<std::uint16_t, 256> linear = {};
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const double c = static_cast<double>(i) / 255.0;
    const double value = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    linear[i] = static_cast<std::uint16_t>(std::lround(65535.0 * value));
  }
  return linear;
}

bool IsPainted(const CloudPoint& point) {
  return !std::isnan(point.confidence);
}

/// Little endian, eight bytes a vertex.
std::vector<std::uint8_t> BytesOf(std::span<const CloudPoint> points) {
  const std::array<std::uint16_t, 256> linear = LinearOfSrgb();
  std::vector<std::uint8_t> bytes;
  bytes.reserve(8 * points.size());
  for (const CloudPoint& point : points) {
    const Rgb8 c = IsPainted(point) ? point.color : kUnpainted;
    for (const std::uint16_t value :
         {linear[c.r], linear[c.g], linear[c.b], std::uint16_t{0xffff}}) {
      bytes.push_back(static_cast<std::uint8_t>(value & 0xff));
      bytes.push_back(static_cast<std::uint8_t>(value >> 8));
    }
  }
  return bytes;
}

std::string Inline(const std::vector<std::uint8_t>& bytes) {
  std::string base64(4 * ((bytes.size() + 2) / 3), '\0');
  base64.resize(vtkBase64Utilities::Encode(bytes.data(), bytes.size(),
                                           reinterpret_cast<unsigned char*>(base64.data())));
  return "data:application/octet-stream;base64," + base64;
}

}  // namespace

bool AddGltfColors(std::span<const CloudPoint> points, nlohmann::json& gltf) {
  if (std::none_of(points.begin(), points.end(), IsPainted)) return true;
  try {
    nlohmann::json& primitive = gltf.at("meshes").at(0).at("primitives").at(0);
    nlohmann::json& attributes = primitive.at("attributes");
    const auto position = attributes.at("POSITION").get<std::size_t>();
    if (primitive.at("mode") != kTriangles ||
        gltf.at("accessors").at(position).at("count") != points.size())
      return false;
    const std::vector<std::uint8_t> bytes = BytesOf(points);
    attributes["COLOR_0"] = gltf.at("accessors").size();
    gltf["accessors"].push_back({{"bufferView", gltf.at("bufferViews").size()},
                                 {"byteOffset", 0},
                                 {"componentType", kUnsignedShort},
                                 {"normalized", true},
                                 {"count", points.size()},
                                 {"type", "VEC4"}});
    gltf["bufferViews"].push_back(
        {{"buffer", gltf.at("buffers").size()}, {"byteOffset", 0}, {"byteLength", bytes.size()}});
    gltf["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", Inline(bytes)}});
  } catch (const nlohmann::json::exception&) {
    return false;
  }
  return true;
}

}  // namespace foresight
