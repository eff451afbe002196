#include "hardware/link/discovery/head_browser.h"

#include <avahi-client/lookup.h>
#include <avahi-common/address.h>
#include <avahi-common/strlst.h>

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include "hardware/link/discovery/avahi_connection.h"

namespace foresight {
namespace {

/// A network that announces more is not a robot's.
constexpr std::size_t kMostServices = 256;

std::vector<std::string> TextsOf(AvahiStringList* list) {
  std::vector<std::string> texts;
  for (; list != nullptr; list = avahi_string_list_get_next(list))
    texts.emplace_back(reinterpret_cast<const char*>(avahi_string_list_get_text(list)),
                       avahi_string_list_get_size(list));
  return texts;
}

}  // namespace

/// Lives in the connection's thread, but for its making and going and what mutex_ keeps.
class HeadBrowser::Search {
 public:
  Search() : connection_([this](AvahiClient* client) { Begin(client); }, [this] { Forget(); }) {
    connection_.Start();
  }

  std::vector<AnnouncedHead> Heads() const {
    std::vector<AnnouncedHead> heads;
    {
      const std::lock_guard lock(mutex_);
      for (const auto& [key, service] : services_)
        if (service.head) heads.push_back(*service.head);
    }
    const auto order = [](const AnnouncedHead& head) { return std::tie(head.name, head.address); };
    std::sort(heads.begin(), heads.end(),
              [&](const auto& a, const auto& b) { return order(a) < order(b); });
    heads.erase(std::unique(heads.begin(), heads.end()), heads.end());
    return heads;
  }

  std::string Trouble() const { return connection_.Trouble(); }

 private:
  using Key = std::tuple<AvahiIfIndex, AvahiProtocol, std::string>;
  struct Service {
    AvahiServiceResolver* resolver = nullptr;  ///< goes on telling of changes
    std::optional<AnnouncedHead> head;
  };

  static void OnBrowse(AvahiServiceBrowser*, AvahiIfIndex interface, AvahiProtocol protocol,
                       AvahiBrowserEvent event, const char* name, const char* type,
                       const char* domain, AvahiLookupResultFlags, void* self) {
    auto* search = static_cast<Search*>(self);
    switch (event) {
      case AVAHI_BROWSER_NEW:
        return search->Resolve({interface, protocol, name}, type, domain);
      case AVAHI_BROWSER_REMOVE:
        return search->Remove({interface, protocol, name});
      case AVAHI_BROWSER_ALL_FOR_NOW:
      case AVAHI_BROWSER_CACHE_EXHAUSTED:
      case AVAHI_BROWSER_FAILURE:  // the client fails too, and is made again
        return;
    }
  }

  static void OnResolve(AvahiServiceResolver*, AvahiIfIndex interface, AvahiProtocol protocol,
                        AvahiResolverEvent event, const char* name, const char*, const char*,
                        const char*, const AvahiAddress* address, std::uint16_t port,
                        AvahiStringList* texts, AvahiLookupResultFlags, void* self) {
    auto* search = static_cast<Search*>(self);
    std::optional<AnnouncedHead> head;
    if (event == AVAHI_RESOLVER_FOUND) {
      std::array<char, AVAHI_ADDRESS_STR_MAX> host{};
      avahi_address_snprint(host.data(), host.size(), address);
      head = ReadAnnouncement(TextsOf(texts), host.data(), port);
    }
    const std::lock_guard lock(search->mutex_);
    const auto found = search->services_.find({interface, protocol, name});
    if (found == search->services_.end()) return;
    found->second.head = std::move(head);
  }

  void Begin(AvahiClient* client) {
    if (browser_ != nullptr) return;
    client_ = client;
    browser_ =
        avahi_service_browser_new(client, AVAHI_IF_UNSPEC, AVAHI_PROTO_INET, kHeadServiceType,
                                  nullptr, AvahiLookupFlags{}, &Search::OnBrowse, this);
  }

  void Resolve(const Key& key, const char* type, const char* domain) {
    const std::lock_guard lock(mutex_);
    if (services_.size() >= kMostServices || services_.contains(key)) return;
    const auto& [interface, protocol, name] = key;
    services_[key].resolver =
        avahi_service_resolver_new(client_, interface, protocol, name.c_str(), type, domain,
                                   AVAHI_PROTO_INET, AvahiLookupFlags{}, &Search::OnResolve, this);
  }

  void Remove(const Key& key) {
    const std::lock_guard lock(mutex_);
    const auto found = services_.find(key);
    if (found == services_.end()) return;
    if (found->second.resolver != nullptr) avahi_service_resolver_free(found->second.resolver);
    services_.erase(found);
  }

  void Forget() {
    const std::lock_guard lock(mutex_);
    for (auto& [key, service] : services_)
      if (service.resolver != nullptr) avahi_service_resolver_free(service.resolver);
    services_.clear();
    if (browser_ != nullptr) avahi_service_browser_free(std::exchange(browser_, nullptr));
  }

  mutable std::mutex mutex_;
  std::map<Key, Service> services_;  ///< by mutex_
  AvahiClient* client_ = nullptr;
  AvahiServiceBrowser* browser_ = nullptr;
  AvahiConnection connection_;  ///< last: its thread uses the others
};

HeadBrowser::HeadBrowser() : search_(std::make_unique<Search>()) {}
HeadBrowser::~HeadBrowser() = default;

std::vector<AnnouncedHead> HeadBrowser::Heads() const {
  return search_->Heads();
}
std::string HeadBrowser::Trouble() const {
  return search_->Trouble();
}

}  // namespace foresight
