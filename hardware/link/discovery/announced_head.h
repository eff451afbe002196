#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foresight {

/// The type of the service that a listening head is, by RFC 6763.
inline constexpr const char* kHeadServiceType = "_foresight._tcp";

/// A head that says on the local network by mDNS that it listens. Anybody can say so: who the head
/// is, its certificate tells.
struct AnnouncedHead {
  std::string name;     ///< of its certificate: StableHostOfHead(name) stands there
  std::string address;  ///< "10.0.0.7:47130"
  bool simulated = false;

  bool operator==(const AnnouncedHead&) const = default;
};

/// The texts that go with the service: "name=left", "simulated=1".
std::vector<std::string> AnnouncementTexts(const AnnouncedHead& head);

/// What a service of the network says of itself; nothing where it names no valid head, no IPv4
/// address or no port.
std::optional<AnnouncedHead> ReadAnnouncement(const std::vector<std::string>& texts,
                                              std::string_view host, std::uint16_t port);

}  // namespace foresight
