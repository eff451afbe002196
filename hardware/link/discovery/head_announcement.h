#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace foresight {

/// While it lives, a listening head is announced on the local network by mDNS (AnnouncedHead).
class HeadAnnouncement {
 public:
  /// @param name of the head's certificate.
  HeadAnnouncement(const std::string& name, std::uint16_t port, bool simulated);
  ~HeadAnnouncement();
  HeadAnnouncement(const HeadAnnouncement&) = delete;
  HeadAnnouncement& operator=(const HeadAnnouncement&) = delete;

  /// Why it is not announced now: "no mDNS on this computer: ..."; empty when all is well. Safe
  /// from any thread.
  std::string Trouble() const;

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace foresight
