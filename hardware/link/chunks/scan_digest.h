#pragma once

#include <string>

#include "core/sensor/scan.h"

namespace foresight {

/// SHA-256, 64 hexadecimal digits, over everything in a scan (docs/formats.md has the form): two
/// scans have the same digest when and only when they are the same, their lines, track, frames and
/// plan ==, and their rigs the same YAML. Also of a scan that was read back from a mission. 2 ns a
/// byte.
std::string ScanDigest(const Scan& scan);

}  // namespace foresight
