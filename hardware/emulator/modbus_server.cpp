#include "hardware/emulator/modbus_server.h"

#include <array>

#include "core/base/log.h"

namespace foresight {
namespace {

constexpr std::chrono::seconds kSendTimeout{1};
/// Nothing happens when a wait ends; whoever wants the thread wakes it.
constexpr std::chrono::hours kForever{1};

/// The device as one client sees it.
class ClientBank final : public RegisterBank {
 public:
  ClientBank(RegisterDevice& device, RegisterDevice::ClientId client)
      : device_(device), client_(client) {}

  std::optional<std::vector<std::uint16_t>> Read(std::uint16_t first,
                                                 std::uint16_t count) override {
    return device_.Read(client_, first, count);
  }
  bool Write(std::uint16_t first, std::span<const std::uint16_t> values) override {
    return device_.Write(client_, first, values);
  }

 private:
  RegisterDevice& device_;
  const RegisterDevice::ClientId client_;
};

}  // namespace

Result<std::unique_ptr<ModbusServer>> ModbusServer::Start(const TcpAddress& address,
                                                          RegisterDevice& device) {
  FORESIGHT_TRY(TcpListener listener, TcpListener::Listen(address));
  return std::unique_ptr<ModbusServer>(new ModbusServer(std::move(listener), device));
}

ModbusServer::ModbusServer(TcpListener listener, RegisterDevice& device)
    : listener_(std::move(listener)), address_(listener_.address()), device_(device) {
  thread_ = std::jthread([this](const std::stop_token& stop) { AcceptClients(stop); });
}

ModbusServer::~ModbusServer() {
  thread_.request_stop();
  wake_.Raise();
  thread_.join();
  for (Client& client : clients_) {
    client.thread.request_stop();
    client.wake.Raise();
  }
}

int ModbusServer::ResetConnections() {
  const std::lock_guard lock(mutex_);
  int ended = 0;
  for (Client& client : clients_) {
    ended += client.finished ? 0 : 1;
    client.thread.request_stop();
    client.wake.Raise();
  }
  return ended;
}

void ModbusServer::AcceptClients(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Result<std::optional<TcpSocket>> socket = listener_.Accept(kForever, &wake_);
    if (!socket) return LogError("{}", socket.error().message);
    const std::lock_guard lock(mutex_);
    clients_.remove_if([](const Client& client) { return client.finished.load(); });
    // A client too many is closed at once, as devices do.
    if (!*socket || clients_.size() >= kMostClients) continue;
    Client& client = clients_.emplace_back();
    client.id = ++clients_so_far_;
    client.socket = std::move(**socket);
    client.thread =
        std::jthread([this, &client](const std::stop_token& reset) { Serve(client, reset); });
  }
}

void ModbusServer::Serve(Client& client, const std::stop_token& stop) {
  try {
    std::array<char, 512> buffer;
    std::vector<std::uint8_t> received;
    for (;;) {
      const Result<std::size_t> count = client.socket.Receive(buffer, kForever, &client.wake);
      if (!count) break;  // the client has gone
      if (stop.stop_requested()) {
        client.socket.Reset();
        break;
      }
      if (silent_) {
        received.clear();
        if (*count > 0) ++lost_requests_;
        continue;
      }
      received.insert(received.end(), buffer.begin(),
                      buffer.begin() + static_cast<std::ptrdiff_t>(*count));
      if (!AnswerAll(client, received)) break;
    }
  } catch (const std::exception& error) {
    LogError("{}: {}", address_.ToText(), error.what());
  }
  client.socket.Close();
  client.finished = true;
}

/// Answers the whole requests at the front; false: the connection is of no use any more.
bool ModbusServer::AnswerAll(Client& client, std::vector<std::uint8_t>& received) {
  ClientBank bank(device_, client.id);
  for (;;) {
    const std::optional<std::size_t> length = modbus::FrameLength(received);
    if (!length) return false;
    if (*length == 0 || received.size() < *length) return true;
    const auto answer = modbus::Answer(std::span(received).first(*length), bank);
    if (!client.socket.Send(std::as_bytes(std::span(answer)), kSendTimeout)) return false;
    received.erase(received.begin(), received.begin() + static_cast<std::ptrdiff_t>(*length));
  }
}

}  // namespace foresight
