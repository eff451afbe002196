#pragma once

#include <string>

#include "core/base/result.h"

namespace foresight {

struct SensorRig;

/// Which rig this is: the SHA-256, 64 hexadecimal digits, of all values that a result depends on
/// (camera, lidar, transforms, angle correction; docs/formats.md has the text that is hashed).
/// Name, date and parent do not count: two rigs of one id give the same results to the last bit.
std::string RigId(const SensorRig& rig);

/// The first 8 digits of the id, for people.
std::string ShortRigId(const SensorRig& rig);

/// Fails unless `id` is 64 lower-case hexadecimal digits.
Status CheckRigId(const std::string& id);

/// Fails unless `date` is a time that there was, in UTC, as ISO 8601 writes it:
/// "2026-03-01T09:30:00Z".
Status CheckUtcDate(const std::string& date);

}  // namespace foresight
