#include "hardware/link/discovery/avahi_connection.h"

#include <avahi-common/error.h>
#include <avahi-common/timeval.h>
#include <fmt/format.h>

#include <utility>

namespace foresight {
namespace {

constexpr unsigned kRetry_ms = 2000;

}  // namespace

AvahiConnection::AvahiConnection(Ready ready, Gone gone)
    : ready_(std::move(ready)), gone_(std::move(gone)), poll_(avahi_threaded_poll_new()) {}

AvahiConnection::~AvahiConnection() {
  avahi_threaded_poll_stop(poll_.get());
  gone_();
  if (client_ != nullptr) avahi_client_free(client_);
}

void AvahiConnection::Start() {
  Connect();
  avahi_threaded_poll_start(poll_.get());
}

std::string AvahiConnection::Trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

void AvahiConnection::SetTrouble(std::string trouble) {
  const std::lock_guard lock(mutex_);
  trouble_ = std::move(trouble);
}

void AvahiConnection::Connect() {
  int error = 0;
  // OnState may be called from inside, before this returns.
  AvahiClient* made = avahi_client_new(avahi_threaded_poll_get(poll_.get()), AVAHI_CLIENT_NO_FAIL,
                                       &AvahiConnection::OnState, this, &error);
  if (made == nullptr) {
    SetTrouble(fmt::format("no mDNS on this computer: {}", avahi_strerror(error)));
    RetryLater();
  }
  client_ = made;
}

void AvahiConnection::RetryLater() {
  const AvahiPoll* api = avahi_threaded_poll_get(poll_.get());
  timeval when{};
  avahi_elapse_time(&when, kRetry_ms, 0);
  if (retry_ == nullptr)
    retry_ = api->timeout_new(api, &when, &AvahiConnection::OnRetry, this);
  else
    api->timeout_update(retry_, &when);
}

void AvahiConnection::OnRetry(AvahiTimeout* timeout, void* self) {
  auto* connection = static_cast<AvahiConnection*>(self);
  avahi_threaded_poll_get(connection->poll_.get())->timeout_update(timeout, nullptr);
  connection->gone_();
  if (connection->client_ != nullptr)
    avahi_client_free(std::exchange(connection->client_, nullptr));
  connection->Connect();
}

void AvahiConnection::OnState(AvahiClient* client, AvahiClientState state, void* self) {
  auto* connection = static_cast<AvahiConnection*>(self);
  switch (state) {
    case AVAHI_CLIENT_S_RUNNING:
      connection->SetTrouble({});
      connection->ready_(client);
      return;
    case AVAHI_CLIENT_FAILURE:
      connection->SetTrouble(
          fmt::format("no mDNS on this computer: {}", avahi_strerror(avahi_client_errno(client))));
      connection->RetryLater();  // a client is not freed in its own callback
      return;
    case AVAHI_CLIENT_CONNECTING:
      connection->SetTrouble("no mDNS on this computer: avahi-daemon does not run");
      return;
    case AVAHI_CLIENT_S_COLLISION:
    case AVAHI_CLIENT_S_REGISTERING:
      connection->gone_();
      return;
  }
}

}  // namespace foresight
