#pragma once

#include <cstdint>
#include <string>

namespace foresight {

/// Nanoseconds since 1970 by this computer's wall clock.
std::int64_t NowUtc_ns();

/// "2026-11-22T13:06:33.250Z" of nanoseconds since 1970.
std::string UtcText(std::int64_t utc_ns);

/// The present time in whole seconds, as rig files have it: "2026-11-22T13:06:33Z".
std::string UtcDateNow();

}  // namespace foresight
