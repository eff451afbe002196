#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "hardware/link/pki/issue.h"

namespace foresight {

/// What the CA says of certificates that were taken back before their end.
struct RevocationList {
  std::int64_t number = 0;  ///< of a later list is larger
  std::int64_t from_utc_s = 0;
  /// When a new list is due. One that is overdue still holds: a head in the field that
  /// shuts out everybody on that day would be worse than one that warns.
  std::int64_t due_utc_s = 0;
  std::set<std::string, std::less<>> serials;

  bool Contains(std::string_view serial) const { return serials.find(serial) != serials.end(); }
};

/// Fails with kBadData, also where this CA did not sign the list.
Result<RevocationList> ReadRevocationList(std::string_view pem, std::string_view ca_pem,
                                          std::string_view source);

/// PEM. All are said to be revoked since `from_utc_s`.
Result<std::string> SignRevocationList(const RevocationList& list, const KeyPair& ca);

}  // namespace foresight
