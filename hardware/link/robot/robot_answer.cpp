#include "hardware/link/robot/robot_answer.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/base/printable.h"
#include "core/io/json_reader.h"

namespace foresight {
namespace {

using Kind = RobotAnswer::Kind;

std::string TextIn(const nlohmann::json& object, const char* key, std::size_t longest) {
  const nlohmann::json& value = object.at(key);
  if (!value.is_string()) throw std::invalid_argument(fmt::format("'{}' is not text", key));
  auto text = value.get<std::string>();
  if (text.size() > longest)
    throw std::invalid_argument(
        fmt::format("'{}' has {} bytes, more than {}", key, text.size(), longest));
  return text;
}

RobotLine LineFrom(const nlohmann::json& value) {
  constexpr std::size_t kLongestWord = 200;
  RobotLine line;
  line.id = TextIn(value, "id", kLongestWord);
  const std::string answer = TextIn(value, "answer", kLongestWord);
  if (answer == ToString(Kind::kAccepted))
    line.answer.kind = Kind::kAccepted;
  else if (answer == ToString(Kind::kRefused))
    line.answer.kind = Kind::kRefused;
  else
    throw std::invalid_argument("'answer' is '" + answer + "', not 'accepted' or 'refused'");
  // An operator reads it: one line that a window can show.
  if (value.contains("reason"))
    line.answer.reason = Printable(TextIn(value, "reason", kLongestReason_bytes));
  return line;
}

}  // namespace

Result<RobotLine> RobotLineFromJson(std::string_view json) {
  if (json.size() > kLongestRobotLine_bytes)
    return Fail(ErrorCode::kBadData, "robot: a line of {} bytes, more than {}", json.size(),
                kLongestRobotLine_bytes);
  try {
    return LineFrom(ParseJson(json));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return Fail(ErrorCode::kBadData, "robot: {}", Printable(failure.what()));
  }
}

}  // namespace foresight
