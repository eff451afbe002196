#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace foresight {

/// SHA-256 of bytes that may come in pieces (ADR 0012).
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  Sha256& Add(std::string_view bytes);
  /// The digest of everything so far as 64 lower-case hexadecimal digits. Nothing may be added
  /// afterwards.
  std::string Hex();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The digest of one text.
std::string Sha256Hex(std::string_view bytes);

}  // namespace foresight
