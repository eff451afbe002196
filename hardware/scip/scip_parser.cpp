#include "hardware/scip/scip_parser.h"

#include <algorithm>
#include <utility>

#include "hardware/scip/scip_encoding.h"
#include "hardware/scip/scip_request.h"

namespace foresight {
namespace {

/// A full scan with three echoes a step takes 21 kB.
constexpr std::size_t kLongestReply = 64 * 1024;
constexpr std::size_t kLongestRequest = 256;

bool IsStatusLine(const std::string& line) {
  return line.size() == 3 && ScipSumMatches(line);
}

}  // namespace

void ScipParser::Push(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto end = bytes.find('\n');
    line_ += bytes.substr(0, end);
    if (end == std::string_view::npos) bytes = {};
    if (bytes_in_reply_ + line_.size() > kLongestReply) {
      ++damaged_;
      lines_.clear();
      line_.clear();
      bytes_in_reply_ = 0;
    }
    if (bytes.empty()) return;
    bytes.remove_prefix(end + 1);
    EndLine();
  }
}

void ScipParser::EndLine() {
  if (line_.empty()) return EndReply();
  bytes_in_reply_ += line_.size();
  lines_.push_back(std::exchange(line_, {}));
  DropDamagedStart();
}

/// Where the empty line between two replies was lost, the second begins in the body of the first:
/// an echo and a status. No body has two such lines, a scan's lines before its last are 65 long.
void ScipParser::DropDamagedStart() {
  const std::size_t n = lines_.size();
  if (n < 3 || !IsStatusLine(lines_[n - 1]) || !ParseScipRequest(lines_[n - 2])) return;
  ++damaged_;
  lines_.erase(lines_.begin(), lines_.end() - 2);
  bytes_in_reply_ = lines_[0].size() + lines_[1].size();
}

void ScipParser::EndReply() {
  bytes_in_reply_ = 0;
  if (lines_.empty()) return;
  std::vector<std::string> lines = std::exchange(lines_, {});
  if (lines.size() < 2 || !IsStatusLine(lines[1])) {
    ++damaged_;
    return;
  }
  ScipReply reply;
  reply.echo = std::move(lines[0]);
  reply.status = lines[1].substr(0, 2);
  reply.body.assign(std::make_move_iterator(lines.begin() + 2),
                    std::make_move_iterator(lines.end()));
  replies_.push_back(std::move(reply));
}

std::optional<ScipReply> ScipParser::Take() {
  if (replies_.empty()) return std::nullopt;
  ScipReply reply = std::move(replies_.front());
  replies_.pop_front();
  return reply;
}

void ScipParser::Clear() {
  line_.clear();
  lines_.clear();
  replies_.clear();
  bytes_in_reply_ = 0;
}

void ScipRequestReader::Push(std::string_view bytes) {
  for (const char byte : bytes) {
    if (byte != '\n' && byte != '\r') {
      // The rest of an endless line is dropped; what is left of it will be refused.
      if (line_.size() < kLongestRequest) line_ += byte;
    } else if (!line_.empty()) {
      lines_.push_back(std::exchange(line_, {}));
    }
  }
}

std::optional<std::string> ScipRequestReader::Take() {
  if (lines_.empty()) return std::nullopt;
  std::string line = std::move(lines_.front());
  lines_.pop_front();
  return line;
}

}  // namespace foresight
