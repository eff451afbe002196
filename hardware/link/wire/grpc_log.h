#pragma once

namespace foresight {

/// Sends what gRPC logs as errors to our log, as warnings: handshakes that TLS refused (no
/// certificate, a foreign CA, an expired one) stand there. LineLimit holds repeats back. For
/// main(); called again, it forgets what was repeated.
void SendGrpcLogToOurs();

}  // namespace foresight
