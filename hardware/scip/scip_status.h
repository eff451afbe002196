#pragma once

#include <string>
#include <string_view>

namespace foresight {

/// Two characters that begin every reply.
namespace scip_status {
inline constexpr std::string_view kOk = "00";
inline constexpr std::string_view kScan = "99";  ///< the body is a scan
/// Already in the state that was asked for: laser on (BM), time mode (TM0).
inline constexpr std::string_view kAlready = "02";
inline constexpr std::string_view kRefused = "10";   ///< not in this state
inline constexpr std::string_view kAbnormal = "0L";  ///< needs a reboot
}  // namespace scip_status

/// What a status says, for people. Firmwares disagree on single 0x codes, so nothing but the ones
/// above may be decided on: everything else is a refusal.
std::string_view ScipStatusMeaning(std::string_view status);
/// "status 10: refused in this state".
std::string DescribeScipStatus(std::string_view status);

}  // namespace foresight
