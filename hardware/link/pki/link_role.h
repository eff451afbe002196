#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace foresight {

/// What the owner of a certificate may do on the link.
enum class LinkRole {
  kHead,      ///< is a server, never a client
  kOperator,  ///< reads, and acts while it holds control
  kObserver,  ///< reads
};

/// "head", "operator", "observer".
std::string ToString(LinkRole role);
std::optional<LinkRole> LinkRoleFromText(std::string_view text);

/// Who a certificate is of, as the URI in its alternative names says it: "foresight:operator:anna".
struct LinkIdentity {
  LinkRole role = LinkRole::kObserver;
  std::string name;

  std::string ToUri() const;
  /// Nothing where the text is no such URI, or its name is not a valid one.
  static std::optional<LinkIdentity> FromUri(std::string_view uri);

  bool operator==(const LinkIdentity&) const = default;
};

/// Names are 1 to 40 letters, digits, '-', '_' and '.', and begin with a letter or a digit. Those
/// of heads are part of a host name: lower-case letters, digits and '-' only. Fails with
/// kInvalidOptions.
Status CheckLinkName(LinkRole role, std::string_view name);

/// The host name that stands in each certificate of a head, whatever its addresses are:
/// "NAME.foresight.internal". No name server knows it; a station that reaches the head by an
/// address that its certificate does not have asks for this name instead.
std::string StableHostOfHead(std::string_view name);

}  // namespace foresight
