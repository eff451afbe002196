#pragma once

namespace foresight {

/// Sends what gRPC logs as errors to our log: handshakes that TLS refused (no certificate, a
/// foreign CA, an expired one) stand there. Of more than 20 lines in a second the rest is counted:
/// strangers make these lines. For main(); may be called more than once.
void SendGrpcLogToOurs();

}  // namespace foresight
