#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/base/result.h"

struct _modbus;

namespace foresight {

/// One Modbus TCP connection to a drive. Errors are kDevice without the address. After a timeout or
/// a broken connection the link is closed: what comes late would answer the wrong question. An
/// exception that the drive answers leaves it open. One thread at a time.
class ModbusLink {
 public:
  ModbusLink(std::string host, std::uint16_t port, std::chrono::milliseconds response_timeout);
  ~ModbusLink();

  Status Connect();
  bool IsOpen() const { return context_ != nullptr; }
  void Close() { context_.reset(); }

  /// Function 03.
  Status Read(std::uint16_t first, std::span<std::uint16_t> registers);
  /// Function 06 for one register, 10h for more.
  Status Write(std::uint16_t first, std::span<const std::uint16_t> registers);

 private:
  struct Delete {
    void operator()(_modbus* context) const;
  };

  Status Failed(const char* what, std::uint16_t first);

  const std::string host_;
  const std::uint16_t port_;
  const std::chrono::milliseconds response_timeout_;
  std::unique_ptr<_modbus, Delete> context_;
};

}  // namespace foresight
