#include "core/mission/mission_records.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace foresight {
namespace {

using EventAction = DetectionEvent::Action;
constexpr std::pair<EventAction, const char*> kActions[] = {
    {EventAction::kAccepted, "accepted"}, {EventAction::kRejected, "rejected"},
    {EventAction::kReopened, "reopened"}, {EventAction::kRenamed, "renamed"},
    {EventAction::kDeleted, "deleted"},   {EventAction::kRestored, "restored"},
    {EventAction::kSent, "sent"}};

}  // namespace

const char* ToString(Decision decision) {
  switch (decision) {
    case Decision::kAccepted:
      return "accepted";
    case Decision::kRejected:
      return "rejected";
    default:
      return "open";
  }
}

int DecidedCandidateOf(const std::string& text) {
  constexpr std::string_view kAnswer = "answer ";
  if (!text.starts_with(kAnswer)) return 0;
  int number = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + kAnswer.size(), end, number);
  return read.ec == std::errc() && read.ptr == end && number >= 1 ? number - 1 : 0;
}

const char* ToString(EventAction action) {
  for (const auto& [known, name] : kActions)
    if (known == action) return name;
  return "unknown";
}

std::vector<NoteRecord> CurrentNotes(const std::vector<NoteRecord>& states) {
  std::vector<NoteRecord> notes;
  std::map<std::string, std::size_t> places;
  for (const NoteRecord& state : states) {
    const auto [place, is_new] = places.try_emplace(state.uuid, notes.size());
    const bool has_maker = !state.made_by.empty() || state.made_utc_ns != 0;
    NoteRecord current = state;
    if (is_new) {
      if (!has_maker) {
        current.made_utc_ns = state.utc_ns;
        current.made_by = state.author;
      }
      notes.push_back(std::move(current));
      continue;
    }
    NoteRecord& note = notes[place->second];
    current.made_utc_ns = note.made_utc_ns;
    current.made_by = note.made_by;
    note = std::move(current);
  }
  return notes;
}

Result<std::string> TagsFrom(const std::string& text) {
  constexpr std::size_t kLongestTag = 40;
  std::vector<std::string> tags;
  std::string word;
  const auto end_word = [&]() -> Status {
    if (word.size() > kLongestTag)
      return Fail(ErrorCode::kInvalidInput, "tag '{}...' is longer than {} characters",
                  word.substr(0, 12), kLongestTag);
    if (!word.empty() && std::find(tags.begin(), tags.end(), word) == tags.end())
      tags.push_back(word);
    word.clear();
    return {};
  };
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool parts = byte <= ' ' || byte == 127 || c == ',' || c == ';';
    if (parts)
      FORESIGHT_CHECK(end_word());
    else if (c != '#' || !word.empty())
      word += static_cast<char>(byte < 128 ? std::tolower(byte) : byte);
  }
  FORESIGHT_CHECK(end_word());
  std::string joined;
  for (const std::string& tag : tags) joined += (joined.empty() ? "" : " ") + tag;
  return joined;
}

Result<EventAction> DetectionActionFromString(const std::string& text) {
  for (const auto& [action, name] : kActions)
    if (text == name) return action;
  return Fail(ErrorCode::kBadData, "'{}' is no action on a detection", text);
}

}  // namespace foresight
