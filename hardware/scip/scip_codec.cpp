#include "hardware/scip/scip_codec.h"

#include <charconv>
#include <cmath>

#include "hardware/scip/scip_encoding.h"
#include "hardware/scip/scip_status.h"

namespace foresight {
namespace {

constexpr std::size_t kLine = 64;
constexpr int kRangeCharacters = 3;
constexpr int kIntensityCharacters = 3;
constexpr int kStampCharacters = 4;
/// Before the second and third echo of a step.
constexpr char kFurtherEcho = '&';

template <class... Args>
tl::unexpected<Error> Damaged(const ScipReply& reply, fmt::format_string<Args...> format,
                              Args&&... args) {
  return Fail(ErrorCode::kBadData, "reply to {}: {}", reply.echo,
              fmt::format(format, std::forward<Args>(args)...));
}

std::string_view StatusOfScans(ScipCommand command) {
  return IsStream(command) ? scip_status::kScan : scip_status::kOk;
}

Result<std::uint32_t> StampOf(const ScipReply& reply) {
  if (reply.body.empty()) return Damaged(reply, "has no time stamp");
  const std::string& line = reply.body.front();
  const auto stamp = DecodeScipValue(std::string_view(line).substr(0, kStampCharacters));
  if (line.size() != kStampCharacters + 1 || !ScipSumMatches(line) || !stamp)
    return Damaged(reply, "damaged time stamp '{}'", line);
  return *stamp;
}

/// All values of a scan in one piece: they and their echo marks straddle the lines' ends.
Result<std::string> DataOf(const ScipReply& reply) {
  std::string data;
  for (std::size_t i = 1; i < reply.body.size(); ++i) {
    const std::string& line = reply.body[i];
    if (!ScipSumMatches(line)) return Damaged(reply, "wrong sum in line {} of the scan", i);
    data.append(line, 0, line.size() - 1);
  }
  return data;
}

/// Takes one echo from the front of `data`.
std::optional<ScipEcho> TakeEcho(std::string_view& data, bool intensity) {
  const std::size_t size = kRangeCharacters + (intensity ? kIntensityCharacters : 0);
  if (data.size() < size) return std::nullopt;
  const auto range = DecodeScipValue(data.substr(0, kRangeCharacters));
  const auto strength = DecodeScipValue(data.substr(kRangeCharacters, size - kRangeCharacters));
  data.remove_prefix(size);
  if (!range || !strength) return std::nullopt;
  return ScipEcho{*range, *strength};
}

std::optional<ScipStep> TakeStep(std::string_view& data, const ScipRequest& request) {
  ScipStep step;
  for (step.count = 0; step.count < ScipStep::kMostEchoes; ++step.count) {
    if (step.count > 0) {
      if (!HasEchoes(request.command) || data.empty() || data.front() != kFurtherEcho) break;
      data.remove_prefix(1);
    }
    const auto echo = TakeEcho(data, HasIntensity(request.command));
    if (!echo) return std::nullopt;
    step.echoes[step.count] = *echo;
  }
  return step;
}

tl::unexpected<Error> WrongCount(const ScipReply& reply, int steps, const ScipRequest& request) {
  return Fail(ErrorCode::kInvalidInput, "reply to {}: {} beams instead of {}", reply.echo, steps,
              request.Values());
}

/// The text before the delimiter of a `KEY:VALUE;S` line. The sum itself may be ';', so it is read
/// from the end; firmwares differ in what it covers.
std::optional<std::string_view> InfoText(std::string_view line) {
  if (line.size() < 2 || line[line.size() - 2] != ';') return std::nullopt;
  const std::string_view text = line.substr(0, line.size() - 2);
  const std::string_view with_delimiter = line.substr(0, line.size() - 1);
  const std::string_view without_comment = text.substr(0, text.find("<-"));
  for (const std::string_view covered : {text, with_delimiter, without_comment})
    if (line.back() == ScipSum(covered)) return without_comment;
  return std::nullopt;
}

Result<int> IntegerOf(const ScipInfo& info, const std::string& key) {
  const auto field = info.find(key);
  if (field == info.end()) return Fail(ErrorCode::kBadData, "parameters: {} is missing", key);
  const std::string& text = field->second;
  int value = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc())
    return Fail(ErrorCode::kBadData, "parameters: {} is '{}', no number", key, text);
  return value;
}

}  // namespace

Result<ScipScan> DecodeScipScan(const ScipReply& reply) {
  const auto request = ParseScipRequest(reply.echo);
  if (!request || !(IsStream(request->command) || IsSingle(request->command)))
    return Damaged(reply, "is no scan's");
  if (reply.status != StatusOfScans(request->command))
    return Damaged(reply, "no scan but {}", DescribeScipStatus(reply.status));
  ScipScan scan;
  scan.request = *request;
  FORESIGHT_TRY(scan.stamp_ms, StampOf(reply));
  FORESIGHT_TRY(const std::string data, DataOf(reply));
  std::string_view rest = data;
  scan.steps.reserve(static_cast<std::size_t>(request->Values()));
  for (int i = 0; i < request->Values(); ++i) {
    if (rest.empty()) return WrongCount(reply, i, *request);
    const auto step = TakeStep(rest, *request);
    if (!step) return Damaged(reply, "value {} of {} is damaged", i, request->Values());
    scan.steps.push_back(*step);
  }
  int steps = request->Values();
  while (!rest.empty()) {
    if (!TakeStep(rest, *request)) return Damaged(reply, "{} characters too many", rest.size());
    ++steps;
  }
  if (steps > request->Values()) return WrongCount(reply, steps, *request);
  return scan;
}

Result<ScipInfo> DecodeScipInfo(const ScipReply& reply) {
  ScipInfo info;
  for (const std::string& line : reply.body) {
    const auto text = InfoText(line);
    const auto colon = text ? text->find(':') : std::string_view::npos;
    if (colon == std::string_view::npos) return Damaged(reply, "damaged line '{}'", line);
    info[std::string(text->substr(0, colon))] = text->substr(colon + 1);
  }
  return info;
}

Result<ScipParameters> DecodeScipParameters(const ScipInfo& info) {
  ScipParameters parameters;
  const auto model = info.find("MODL");
  if (model == info.end()) return Fail(ErrorCode::kBadData, "parameters: MODL is missing");
  parameters.model = model->second;
  FORESIGHT_TRY(parameters.min_range_mm, IntegerOf(info, "DMIN"));
  FORESIGHT_TRY(parameters.max_range_mm, IntegerOf(info, "DMAX"));
  FORESIGHT_TRY(parameters.steps_per_turn, IntegerOf(info, "ARES"));
  FORESIGHT_TRY(parameters.first_step, IntegerOf(info, "AMIN"));
  FORESIGHT_TRY(parameters.last_step, IntegerOf(info, "AMAX"));
  FORESIGHT_TRY(parameters.front_step, IntegerOf(info, "AFRT"));
  FORESIGHT_TRY(parameters.turns_per_min, IntegerOf(info, "SCAN"));
  if (parameters.steps_per_turn <= 0 || parameters.turns_per_min <= 0)
    return Fail(ErrorCode::kBadData, "parameters: ARES {} and SCAN {} must be positive",
                parameters.steps_per_turn, parameters.turns_per_min);
  return parameters;
}

Result<std::uint32_t> DecodeScipTime(const ScipReply& reply) {
  return StampOf(reply);
}

std::string EncodeScipReply(std::string_view echo, std::string_view status) {
  return fmt::format("{}\n{}\n\n", echo, WithScipSum(status));
}

std::string EncodeScipScan(const ScipScan& scan) {
  std::string data;
  for (const ScipStep& step : scan.steps) {
    for (std::size_t i = 0; i < step.count; ++i) {
      if (i > 0) data += kFurtherEcho;
      data += EncodeScipValue(step.echoes[i].range_mm, kRangeCharacters);
      if (HasIntensity(scan.request.command))
        data += EncodeScipValue(step.echoes[i].intensity, kIntensityCharacters);
    }
  }
  std::string bytes = fmt::format("{}\n{}\n{}\n", EncodeScipRequest(scan.request),
                                  WithScipSum(StatusOfScans(scan.request.command)),
                                  WithScipSum(EncodeScipValue(scan.stamp_ms, kStampCharacters)));
  for (std::size_t at = 0; at < data.size(); at += kLine)
    bytes += WithScipSum(std::string_view(data).substr(at, kLine)) + "\n";
  return bytes + "\n";
}

std::string EncodeScipInfo(std::string_view echo,
                           std::span<const std::pair<std::string, std::string>> fields) {
  std::string bytes = fmt::format("{}\n{}\n", echo, WithScipSum(scip_status::kOk));
  for (const auto& [key, value] : fields) {
    const std::string text = key + ":" + value;
    bytes += text + ";" + ScipSum(text) + "\n";
  }
  return bytes + "\n";
}

std::string EncodeScipTime(std::string_view echo, std::uint32_t stamp_ms) {
  return fmt::format("{}\n{}\n{}\n\n", echo, WithScipSum(scip_status::kOk),
                     WithScipSum(EncodeScipValue(stamp_ms, kStampCharacters)));
}

std::vector<std::pair<std::string, std::string>> ToFields(const ScipParameters& parameters) {
  return {{"MODL", parameters.model},
          {"DMIN", std::to_string(parameters.min_range_mm)},
          {"DMAX", std::to_string(parameters.max_range_mm)},
          {"ARES", std::to_string(parameters.steps_per_turn)},
          {"AMIN", std::to_string(parameters.first_step)},
          {"AMAX", std::to_string(parameters.last_step)},
          {"AFRT", std::to_string(parameters.front_step)},
          {"SCAN", std::to_string(std::lround(parameters.turns_per_min))}};
}

}  // namespace foresight
