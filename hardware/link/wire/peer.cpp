#include "hardware/link/wire/peer.h"

#include <grpc/grpc_security_constants.h>
#include <grpcpp/security/auth_context.h>

#include <string>

namespace foresight {
namespace {

std::string First(const grpc::AuthContext& context, const char* property) {
  const auto values = context.FindPropertyValues(property);
  return values.empty() ? "" : std::string(values.front().data(), values.front().size());
}

bool IsLocal(const grpc::AuthContext& context) {
  constexpr const char* kLocal = "local";  // gRPC has no constant of it in its headers
  return First(context, GRPC_TRANSPORT_SECURITY_TYPE_PROPERTY_NAME) == kLocal;
}

}  // namespace

Result<LinkIdentity> PeerOf(const grpc::AuthContext& context) {
  if (IsLocal(context)) return LinkIdentity{LinkRole::kOperator, "local"};
  const std::string pem = First(context, GRPC_X509_PEM_CERT_PROPERTY_NAME);
  FORESIGHT_TRY(LinkCertificate certificate, ReadLinkCertificate(pem, "peer"));
  return std::move(certificate.identity);
}

Result<LinkIdentity> CheckPeer(const grpc::AuthContext& context, CertificateGate* gate) {
  if (gate == nullptr || IsLocal(context)) return PeerOf(context);
  FORESIGHT_TRY(LinkCertificate certificate,
                gate->CheckStillGood(First(context, GRPC_X509_PEM_CERT_PROPERTY_NAME)));
  return std::move(certificate.identity);
}

}  // namespace foresight
