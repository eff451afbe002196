#pragma once

#include <array>
#include <filesystem>
#include <span>

#include "core/depth/pipeline.h"
#include "core/io/point_cloud_file.h"

namespace foresight {

/// Points with all their fields as point data, for ParaView: VTK XML (.vtp), zlib, appended.
/// Metres, in the points' frame. Writes the whole file or nothing; fails with kIo.
Status WriteVtp(const std::filesystem::path& path, std::span<const CloudPoint> points);

/// A depth map as VTK image (.vti): depth_m (NaN = none), confidence, mask, rgb. Pixel (x, y) of
/// the image is point (x, height - 1 - y): VTK's y runs upwards. Same errors.
Status WriteVti(const std::filesystem::path& path, const DepthResult& depth,
                const ColorImage& image);

/// A triangulated surface: PLY, OBJ, glTF (one file, data inline) or VTP, as the file's name ends.
/// The points' colours are with it, but for OBJ, whose form has none.
/// Fails with kInvalidInput for any other name, and with kIo.
Status WriteSurface(const std::filesystem::path& path, std::span<const CloudPoint> points,
                    std::span<const std::array<std::int32_t, 3>> triangles);

}  // namespace foresight
