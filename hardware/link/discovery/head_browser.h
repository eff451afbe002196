#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hardware/link/discovery/announced_head.h"

namespace foresight {

/// Looks for heads on the local network while it lives. Safe from any thread.
class HeadBrowser {
 public:
  HeadBrowser();
  ~HeadBrowser();
  HeadBrowser(const HeadBrowser&) = delete;
  HeadBrowser& operator=(const HeadBrowser&) = delete;

  /// Those that are announced now, each address once, by name.
  std::vector<AnnouncedHead> Heads() const;
  /// Why none can be found: "no mDNS on this computer: ..."; empty when the network is searched.
  std::string Trouble() const;

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

}  // namespace foresight
