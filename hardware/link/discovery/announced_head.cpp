#include "hardware/link/discovery/announced_head.h"

#include <arpa/inet.h>
#include <fmt/format.h>

#include "hardware/link/pki/link_role.h"

namespace foresight {
namespace {

constexpr std::string_view kName = "name=";
constexpr std::string_view kSimulated = "simulated=1";

bool IsIpv4(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

}  // namespace

std::vector<std::string> AnnouncementTexts(const AnnouncedHead& head) {
  std::vector<std::string> texts{std::string(kName) + head.name};
  if (head.simulated) texts.emplace_back(kSimulated);
  return texts;
}

std::optional<AnnouncedHead> ReadAnnouncement(const std::vector<std::string>& texts,
                                              std::string_view host, std::uint16_t port) {
  AnnouncedHead head;
  for (const std::string& text : texts) {
    if (text.starts_with(kName)) head.name = text.substr(kName.size());
    if (text == kSimulated) head.simulated = true;
  }
  if (port == 0 || !IsIpv4(std::string(host)) || !CheckLinkName(LinkRole::kHead, head.name))
    return std::nullopt;
  head.address = fmt::format("{}:{}", host, port);
  return head;
}

}  // namespace foresight
