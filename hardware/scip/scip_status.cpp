#include "hardware/scip/scip_status.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <utility>

namespace foresight {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 21> kMeanings{{
    {"00", "accepted"},
    {"01", "the start step is no number"},
    {"02", "already in that state, or the end step is no number"},
    {"03", "not in time mode, or the group is no number"},
    {"04", "the end step is out of range"},
    {"05", "the end step lies before the start step"},
    {"06", "the skipped scans are no number"},
    {"07", "the count of scans is no number"},
    {"0A", "a reply cannot be built"},
    {"0B", "the buffer is full, or the request was a duplicate"},
    {"0C", "characters are missing or left over"},
    {"0D", "characters are missing or left over"},
    {"0E", "unknown command"},
    {"0F", "characters are missing or left over"},
    {"0G", "the tag is longer than 16 characters"},
    {"0H", "the tag has characters that are not allowed"},
    {"0I", "in firmware update mode"},
    {"0L", "in an abnormal state, it needs a reboot"},
    {"10", "refused in this state"},
    {"98", "resumed after a self-check"},
    {"99", "a scan"},
}};

int NumberOf(std::string_view status) {
  if (status.size() != 2) return -1;
  const auto digit = [&](std::size_t i) { return static_cast<unsigned char>(status[i]); };
  if (!std::isdigit(digit(0)) || !std::isdigit(digit(1))) return -1;
  return 10 * (digit(0) - '0') + digit(1) - '0';
}

}  // namespace

std::string_view ScipStatusMeaning(std::string_view status) {
  for (const auto& [code, meaning] : kMeanings)
    if (code == status) return meaning;
  const int number = NumberOf(status);
  if (number >= 21 && number <= 49) return "checking itself, will pass by itself";
  if (number >= 50 && number <= 97) return "hardware fault";
  return "unknown status";
}

std::string DescribeScipStatus(std::string_view status) {
  return fmt::format("status {}: {}", status, ScipStatusMeaning(status));
}

}  // namespace foresight
