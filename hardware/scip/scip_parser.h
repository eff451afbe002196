#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foresight {

/// One reply as it came: nothing is checked but the status' sum.
struct ScipReply {
  std::string echo;               ///< the request it answers, with its tag
  std::string status;             ///< two characters, see scip_status
  std::vector<std::string> body;  ///< lines with their sums

  bool operator==(const ScipReply&) const = default;
};

/// Cuts a stream of bytes into replies; any split of the bytes gives the same replies. Damaged
/// replies are dropped and counted; the next clean one gets through.
class ScipParser {
 public:
  void Push(std::string_view bytes);
  /// The oldest reply not yet taken.
  std::optional<ScipReply> Take();

  /// Whether the bytes so far end within a reply.
  bool InReply() const { return !lines_.empty() || !line_.empty(); }
  std::int64_t damaged() const { return damaged_; }
  /// Forgets everything but the count of damaged replies.
  void Clear();

 private:
  void EndLine();
  void EndReply();
  void DropDamagedStart();

  std::string line_;
  std::vector<std::string> lines_;
  std::size_t bytes_in_reply_ = 0;
  std::deque<ScipReply> replies_;
  std::int64_t damaged_ = 0;
};

/// Cuts what a client sends into requests, which end with a line feed or a carriage return.
class ScipRequestReader {
 public:
  void Push(std::string_view bytes);
  std::optional<std::string> Take();

 private:
  std::string line_;
  std::deque<std::string> lines_;
};

}  // namespace foresight
