#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"

namespace foresight {

/// What a support bundle is made of.
struct SupportBundleSources {
  std::optional<std::filesystem::path> mission;  ///< its last scan, its tables, its rig
  /// Logs, settings, configurations, as files: those that are missing are told, not an error.
  std::vector<std::filesystem::path> texts;
  /// Anything else: screenshots as PNG, ...; name and bytes.
  std::vector<std::pair<std::string, std::string>> attachments;
  /// Facts of the caller's for versions.txt: "Qt 5.15.8".
  std::vector<std::string> versions;
};

struct SupportBundleReport {
  std::vector<std::string> files;     ///< in the archive
  std::vector<std::string> left_out;  ///< one sentence each
};

/// Writes a ZIP archive for who has to find out what went wrong: versions.txt (program, libraries,
/// computer), the texts, the attachments, and of the mission last_scan.foresight (a mission of its
/// own that opens everywhere), scans.csv, detections.csv, events.csv, rig.yaml. contents.txt lists
/// what is there and what is not. Nothing secret gets in: of texts, lines that hold a password, a
/// token or a private key are replaced by `(removed)`, and keys and certificates are no text. Fails
/// with kIo, kBadData where the mission cannot be read, and kCancelled.
Result<SupportBundleReport> WriteSupportBundle(const std::filesystem::path& path,
                                               const SupportBundleSources& sources,
                                               const RunContext& context);

/// The text without its secrets, as it gets into a bundle.
std::string WithoutSecrets(const std::string& text);

}  // namespace foresight
