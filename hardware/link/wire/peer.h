#pragma once

#include "hardware/link/pki/certificate_gate.h"

namespace grpc {
class AuthContext;
}

namespace foresight {

/// Who is at the other end of a connection, as its certificate says. Fails with kBadData where it
/// says nothing, which no connection does that HeadCredentials or StationCredentials let in.
Result<LinkIdentity> PeerOf(const grpc::AuthContext& context);

/// The same at the begin of a call, and whether the certificate is still good: a connection
/// may outlast it. 0.2 ms. Without TLS the peer is the operator "local".
Result<LinkIdentity> CheckPeer(const grpc::AuthContext& context, CertificateGate* gate);

}  // namespace foresight
