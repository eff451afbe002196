#include "hardware/motor/modbus_link.h"

#include <modbus/modbus.h>

#include <cerrno>

namespace foresight {
namespace {

constexpr int kUnit = 1;

/// Whether libmodbus reports an exception that the device answered.
bool IsAnswer(int error) {
  return error >= EMBXILFUN && error <= EMBXGTAR;
}

}  // namespace

ModbusLink::ModbusLink(std::string host, std::uint16_t port,
                       std::chrono::milliseconds response_timeout)
    : host_(std::move(host)), port_(port), response_timeout_(response_timeout) {}

ModbusLink::~ModbusLink() = default;

void ModbusLink::Delete::operator()(_modbus* context) const {
  modbus_close(context);
  modbus_free(context);
}

Status ModbusLink::Connect() {
  // Made anew each time: libmodbus keeps the state of a connection in here.
  context_.reset(modbus_new_tcp_pi(host_.c_str(), std::to_string(port_).c_str()));
  if (!context_) return Fail(ErrorCode::kDevice, "{}", modbus_strerror(errno));
  const auto us = std::chrono::microseconds(response_timeout_).count();
  modbus_set_response_timeout(context_.get(), static_cast<std::uint32_t>(us / 1'000'000),
                              static_cast<std::uint32_t>(us % 1'000'000));
  // Its own recovery would reconnect inside a call and block for as long as that takes.
  modbus_set_error_recovery(context_.get(), MODBUS_ERROR_RECOVERY_NONE);
  modbus_set_slave(context_.get(), kUnit);
  if (modbus_connect(context_.get()) == 0) return {};
  const int error = errno;
  Close();
  return Fail(ErrorCode::kDevice, "cannot connect ({})", modbus_strerror(error));
}

Status ModbusLink::Read(std::uint16_t first, std::span<std::uint16_t> registers) {
  if (!IsOpen()) return Fail(ErrorCode::kDevice, "is not connected");
  const int count = static_cast<int>(registers.size());
  if (modbus_read_registers(context_.get(), first, count, registers.data()) == count) return {};
  return Failed("reading", first);
}

Status ModbusLink::Write(std::uint16_t first, std::span<const std::uint16_t> registers) {
  if (!IsOpen()) return Fail(ErrorCode::kDevice, "is not connected");
  const int count = static_cast<int>(registers.size());
  const int written = count == 1
                          ? modbus_write_register(context_.get(), first, registers[0])
                          : modbus_write_registers(context_.get(), first, count, registers.data());
  if (written == count) return {};
  return Failed("writing", first);
}

Status ModbusLink::Failed(const char* what, std::uint16_t first) {
  const int error = errno;
  if (IsAnswer(error))
    return Fail(ErrorCode::kDevice, "refused {} register {} ({})", what, first,
                modbus_strerror(error));
  Close();
  if (error == ETIMEDOUT)
    return Fail(ErrorCode::kDevice, "no answer within {} ms", response_timeout_.count());
  return Fail(ErrorCode::kDevice, "connection lost ({})", modbus_strerror(error));
}

}  // namespace foresight
