#pragma once

#include <QString>
#include <cstdint>

namespace foresight {

/// "812 B", "34 kB", "3.1 MB": two digits, so that what shows it need not be drawn again for every
/// packet.
QString BytesText(std::int64_t bytes);

}  // namespace foresight
