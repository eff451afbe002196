#include "hardware/link/discovery/head_announcement.h"

#include <avahi-client/publish.h>
#include <avahi-common/alternative.h>
#include <avahi-common/error.h>
#include <avahi-common/malloc.h>
#include <avahi-common/strlst.h>

#include <utility>

#include "core/base/log.h"
#include "hardware/link/discovery/announced_head.h"
#include "hardware/link/discovery/avahi_connection.h"

namespace foresight {

/// Lives in the connection's thread, but for its making and going.
class HeadAnnouncement::Service {
 public:
  Service(const std::string& name, std::uint16_t port, bool simulated)
      : texts_(AnnouncementTexts({name, {}, simulated})),
        port_(port),
        label_(name),
        connection_([this](AvahiClient* client) { Publish(client); }, [this] { Forget(); }) {
    connection_.Start();
  }

  std::string Trouble() const { return connection_.Trouble(); }

 private:
  static void OnGroup(AvahiEntryGroup* group, AvahiEntryGroupState state, void* self) {
    auto* service = static_cast<Service*>(self);
    if (state == AVAHI_ENTRY_GROUP_COLLISION) service->PublishUnderAnotherLabel(group);
    if (state == AVAHI_ENTRY_GROUP_FAILURE)
      LogWarning("mDNS: head '{}' is not announced: {}", service->label_,
                 avahi_strerror(avahi_client_errno(avahi_entry_group_get_client(group))));
  }

  void Publish(AvahiClient* client) {
    if (group_ == nullptr) group_ = avahi_entry_group_new(client, &Service::OnGroup, this);
    if (group_ != nullptr) Fill(group_);
  }

  void Fill(AvahiEntryGroup* group) {
    AvahiStringList* list = nullptr;
    for (const std::string& text : texts_) list = avahi_string_list_add(list, text.c_str());
    int error = avahi_entry_group_add_service_strlst(
        group, AVAHI_IF_UNSPEC, AVAHI_PROTO_UNSPEC, AvahiPublishFlags{}, label_.c_str(),
        kHeadServiceType, nullptr, nullptr, port_, list);
    avahi_string_list_free(list);
    if (error == AVAHI_ERR_COLLISION) return PublishUnderAnotherLabel(group);
    if (error >= 0) error = avahi_entry_group_commit(group);
    if (error < 0)
      LogWarning("mDNS: head '{}' is not announced: {}", label_, avahi_strerror(error));
  }

  /// Two heads with one label: the network tells them apart, their certificates do anyway.
  void PublishUnderAnotherLabel(AvahiEntryGroup* group) {
    char* other = avahi_alternative_service_name(label_.c_str());
    label_ = other;
    avahi_free(other);
    avahi_entry_group_reset(group);
    Fill(group);
  }

  void Forget() {
    if (group_ != nullptr) avahi_entry_group_free(std::exchange(group_, nullptr));
  }

  const std::vector<std::string> texts_;
  const std::uint16_t port_;
  std::string label_;
  AvahiEntryGroup* group_ = nullptr;
  AvahiConnection connection_;  ///< last: its thread uses the others
};

HeadAnnouncement::HeadAnnouncement(const std::string& name, std::uint16_t port, bool simulated)
    : service_(std::make_unique<Service>(name, port, simulated)) {}
HeadAnnouncement::~HeadAnnouncement() = default;

std::string HeadAnnouncement::Trouble() const {
  return service_->Trouble();
}

}  // namespace foresight
