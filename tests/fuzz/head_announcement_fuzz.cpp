// What anybody on the local network says to be a head: host and texts, each behind a zero.
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/printable.h"
#include "hardware/link/discovery/announced_head.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  std::vector<std::string> texts(1);
  for (std::size_t i = 0; i < size; ++i)
    if (bytes[i] == 0)
      texts.emplace_back();
    else
      texts.back().push_back(static_cast<char>(bytes[i]));
  const std::string host = texts.front();
  texts.erase(texts.begin());
  const auto head = ReadAnnouncement(texts, host, 47130);
  if (!head) return 0;
  Require(Printable(head->name) == head->name, "a window can show the name");
  Require(ReadAnnouncement(AnnouncementTexts(*head), host, 47130) == head,
          "what was read can be announced");
  return 0;
}
