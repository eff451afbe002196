#pragma once

#include <memory>
#include <string_view>

#include "hardware/link/pki/certificate_gate.h"
#include "hardware/link/pki/tls_files.h"

namespace grpc {
class ChannelCredentials;
class ServerCredentials;
}  // namespace grpc

namespace foresight {

/// TLS 1.3 for a head's server: who has no certificate of the CA, or one that `gate` does not
/// admit, gets no further than the handshake. Refusals by the gate are logged as warnings with name
/// and reason; those by TLS itself are logged by gRPC (grpc_log.h).
std::shared_ptr<grpc::ServerCredentials> HeadCredentials(
    const TlsFiles& files, const std::shared_ptr<CertificateGate>& gate);

/// TLS 1.3 for a station's channel: the peer is a head of the CA, admitted by `gate`, and has the
/// name or address that the channel was made for (GRPC_SSL_TARGET_NAME_OVERRIDE_ARG:
/// StableHostOfHead).
std::shared_ptr<grpc::ChannelCredentials> StationCredentials(
    const TlsFiles& files, const std::shared_ptr<CertificateGate>& gate);

/// Neither encrypted nor authenticated, for one machine: gRPC itself closes connections that are
/// not local. The peer counts as the operator "local". Fails with kInvalidOptions where `host` is
/// no loopback address.
Result<std::shared_ptr<grpc::ServerCredentials>> PlaintextHeadCredentials(std::string_view host);
Result<std::shared_ptr<grpc::ChannelCredentials>> PlaintextStationCredentials(
    std::string_view host);

/// "localhost", "::1", "127.0.0.1" and the rest of its net.
bool IsLoopback(std::string_view host);

}  // namespace foresight
