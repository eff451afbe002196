#include "hardware/scip/scip_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace foresight {
namespace {

struct Entry {
  ScipCommand command;
  std::string_view text;
};
constexpr std::array<Entry, 18> kCommands{{
    {ScipCommand::kVersion, "VV"},
    {ScipCommand::kParameters, "PP"},
    {ScipCommand::kState, "II"},
    {ScipCommand::kLaserOn, "BM"},
    {ScipCommand::kQuit, "QT"},
    {ScipCommand::kReset, "RS"},
    {ScipCommand::kReboot, "RB"},
    {ScipCommand::kEnterTime, "TM0"},
    {ScipCommand::kReadTime, "TM1"},
    {ScipCommand::kLeaveTime, "TM2"},
    {ScipCommand::kStream, "MD"},
    {ScipCommand::kStreamIntensity, "ME"},
    {ScipCommand::kStreamEchoes, "ND"},
    {ScipCommand::kStreamAll, "NE"},
    {ScipCommand::kSingle, "GD"},
    {ScipCommand::kSingleIntensity, "GE"},
    {ScipCommand::kSingleEchoes, "HD"},
    {ScipCommand::kSingleAll, "HE"},
}};

/// The number in all of `digits`.
std::optional<int> Number(std::string_view digits) {
  int value = 0;
  const char* end = digits.data() + digits.size();
  const bool all_digits =
      std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!all_digits || std::from_chars(digits.data(), end, value).ptr != end) return std::nullopt;
  return value;
}

tl::unexpected<std::string> Refused(std::string_view status) {
  return tl::unexpected<std::string>(std::string(status));
}

/// Fills in what stands behind the letters of a scan's request.
tl::expected<ScipRequest, std::string> ParseWindow(ScipRequest request, std::string_view digits) {
  const std::size_t expected = IsStream(request.command) ? 13 : 10;
  if (digits.size() < expected) return Refused("0C");
  if (digits.size() > expected) return Refused("0D");
  struct Field {
    int* value;
    std::size_t at, size;
    std::string_view status;
  };
  const std::array<Field, 5> fields{{{&request.first_step, 0, 4, "01"},
                                     {&request.last_step, 4, 4, "02"},
                                     {&request.group, 8, 2, "03"},
                                     {&request.skip, 10, 1, "06"},
                                     {&request.count, 11, 2, "07"}}};
  for (const Field& field : fields) {
    if (field.at >= expected) break;
    const auto number = Number(digits.substr(field.at, field.size));
    if (!number) return Refused(field.status);
    *field.value = *number;
  }
  if (request.last_step < request.first_step) return Refused("05");
  return request;
}

}  // namespace

std::string_view ToText(ScipCommand command) {
  return kCommands[static_cast<std::size_t>(command)].text;
}

bool IsStream(ScipCommand command) {
  return command >= ScipCommand::kStream && command <= ScipCommand::kStreamAll;
}

bool IsSingle(ScipCommand command) {
  return command >= ScipCommand::kSingle;
}

bool HasIntensity(ScipCommand command) {
  return command == ScipCommand::kStreamIntensity || command == ScipCommand::kStreamAll ||
         command == ScipCommand::kSingleIntensity || command == ScipCommand::kSingleAll;
}

bool HasEchoes(ScipCommand command) {
  return command == ScipCommand::kStreamEchoes || command == ScipCommand::kStreamAll ||
         command == ScipCommand::kSingleEchoes || command == ScipCommand::kSingleAll;
}

int ScipRequest::Values() const {
  const int steps_per_value = std::max(1, group);
  return (last_step - first_step + steps_per_value) / steps_per_value;
}

std::string EncodeScipRequest(const ScipRequest& request) {
  std::string text(ToText(request.command));
  if (IsStream(request.command) || IsSingle(request.command))
    text += fmt::format("{:04}{:04}{:02}", request.first_step, request.last_step, request.group);
  if (IsStream(request.command)) text += fmt::format("{}{:02}", request.skip, request.count);
  if (!request.tag.empty()) text += ";" + request.tag;
  return text;
}

tl::expected<ScipRequest, std::string> ParseScipRequest(std::string_view line) {
  const auto semicolon = line.find(';');
  const std::string_view text = line.substr(0, semicolon);
  const auto entry = std::find_if(kCommands.begin(), kCommands.end(), [&](const Entry& candidate) {
    return text.substr(0, candidate.text.size()) == candidate.text;
  });
  if (entry == kCommands.end()) return Refused("0E");
  ScipRequest request;
  request.command = entry->command;
  if (semicolon != std::string_view::npos) request.tag = line.substr(semicolon + 1);
  if (request.tag.size() > ScipRequest::kLongestTag) return Refused("0G");
  if (std::any_of(request.tag.begin(), request.tag.end(),
                  [](char c) { return c < ' ' || c > '~'; }))
    return Refused("0H");
  const std::string_view rest = text.substr(entry->text.size());
  if (IsStream(request.command) || IsSingle(request.command)) return ParseWindow(request, rest);
  if (!rest.empty()) return Refused("0D");
  return request;
}

}  // namespace foresight
