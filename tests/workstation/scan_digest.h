#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "core/sensor/scan.h"

namespace foresight {

/// One number of the first `lines` lines of a scan: any changed bit changes it.
inline std::string DigestOfLines(const Scan& scan, std::size_t lines) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte)
      hash = (hash ^ ((value >> (8 * byte)) & 0xffu)) * 0x100000001b3u;
  };
  for (std::size_t i = 0; i < lines && i < scan.lines.size(); ++i) {
    const LidarLine& line = scan.lines[i];
    add(static_cast<std::uint64_t>(line.seq));
    add(std::bit_cast<std::uint64_t>(line.time_s));
    for (const std::uint16_t range : line.range_mm) add(range);
    for (const std::uint16_t intensity : line.intensity) add(intensity);
  }
  return fmt::format("{:016x}", hash);
}

/// The same of the whole scan, with its images and the encoder's readings.
inline std::string DigestOfScan(const Scan& scan) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](std::uint64_t value) { hash = (hash ^ value) * 0x100000001b3u; };
  for (const MotorSample& sample : scan.track.samples()) {
    add(std::bit_cast<std::uint64_t>(sample.time_s));
    add(std::bit_cast<std::uint64_t>(sample.angle_rad));
  }
  for (const CameraFrame& frame : scan.frames) {
    add(std::bit_cast<std::uint64_t>(frame.time_s));
    add(std::bit_cast<std::uint64_t>(frame.motor_angle_rad));
    for (const Rgb8& pixel : frame.image.values()) {
      add(pixel.r);
      add(pixel.g);
      add(pixel.b);
    }
  }
  return fmt::format("{}-{:016x}", DigestOfLines(scan, scan.lines.size()), hash);
}

}  // namespace foresight
