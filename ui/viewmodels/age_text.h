#pragma once

#include <QString>
#include <chrono>

namespace foresight {

/// "under 10 s", "40 s", "3 min", "2 h 10 min", "4 days": as exact as an age is read, so that what
/// shows it need not be drawn again every second.
QString AgeText(std::chrono::seconds age);

}  // namespace foresight
