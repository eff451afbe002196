#pragma once

#include <atomic>
#include <list>
#include <memory>
#include <mutex>
#include <thread>

#include "hardware/emulator/modbus_frame.h"
#include "hardware/net/tcp_listener.h"

namespace foresight {

/// A device whose registers several clients read and write.
class RegisterDevice {
 public:
  /// A connection; never used twice.
  using ClientId = std::int64_t;

  virtual ~RegisterDevice() = default;
  /// As RegisterBank's.
  virtual std::optional<std::vector<std::uint16_t>> Read(ClientId client, std::uint16_t first,
                                                         std::uint16_t count) = 0;
  virtual bool Write(ClientId client, std::uint16_t first,
                     std::span<const std::uint16_t> values) = 0;
};

/// Serves registers over Modbus TCP, a thread for each of at most kMostClients clients. The device
/// is asked from all of them and must be safe for that; it outlives the server.
class ModbusServer {
 public:
  static constexpr std::size_t kMostClients = 4;

  /// On a numeric address; port 0 takes a free one. Fails with kDevice.
  static Result<std::unique_ptr<ModbusServer>> Start(const TcpAddress& address,
                                                     RegisterDevice& device);
  ~ModbusServer();

  const TcpAddress& address() const { return address_; }
  /// A silent server takes connections and requests, and loses the requests.
  void SetSilent(bool silent) { silent_ = silent; }
  int lost_requests() const { return lost_requests_; }
  /// Ends all connections as a crash would; says how many.
  int ResetConnections();

 private:
  struct Client {
    RegisterDevice::ClientId id = 0;
    TcpSocket socket;
    WakeUp wake;
    std::atomic<bool> finished{false};
    std::jthread thread;  ///< last: ends before what it uses
  };

  ModbusServer(TcpListener listener, RegisterDevice& device);
  void AcceptClients(const std::stop_token& stop);
  void Serve(Client& client, const std::stop_token& stop);
  bool AnswerAll(Client& client, std::vector<std::uint8_t>& received);

  TcpListener listener_;
  const TcpAddress address_;
  RegisterDevice& device_;
  RegisterDevice::ClientId clients_so_far_ = 0;
  std::atomic<bool> silent_{false};
  std::atomic<int> lost_requests_{0};
  WakeUp wake_;
  std::mutex mutex_;
  std::list<Client> clients_;
  std::jthread thread_;  ///< last: starts when everything else is there
};

}  // namespace foresight
