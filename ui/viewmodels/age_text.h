#pragma once

#include <QString>
#include <chrono>

namespace foresight {

/// "42 s", "3 min 5 s", "2 h 10 min", "4 days".
QString AgeText(std::chrono::seconds age);

}  // namespace foresight
