#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hardware/link/pki/certificate.h"

namespace foresight {

/// One thing that was looked at in a folder of keys.
struct KeyFinding {
  enum class Kind { kGood, kWarning, kProblem };
  Kind kind = Kind::kGood;
  std::string text;
};

struct KeyFolderReport {
  std::optional<LinkCertificate> certificate;
  std::vector<KeyFinding> findings;

  /// Programs can use the folder; a warning says until when.
  bool IsUsable() const;
};

/// Looks at the files of a folder of keys one by one, as a program would that starts with them at
/// `utc_s`. Fails with kIo where there is no such folder.
Result<KeyFolderReport> CheckKeyFolder(const std::filesystem::path& folder, std::int64_t utc_s);

}  // namespace foresight
