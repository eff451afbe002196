#pragma once

#include <openssl/evp.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace foresight {

/// The bytes as a block of PEM, so that a fuzzer changes what is encoded and not the letters of its
/// encoding. Bytes that begin as PEM does stay as they are.
inline std::string ToPemBlock(std::string_view bytes, const std::string& label) {
  if (bytes.starts_with("-----")) return std::string(bytes);
  constexpr std::size_t kBytesOfLine = 48;  // 64 letters
  std::string pem = "-----BEGIN " + label + "-----\n";
  for (std::size_t i = 0; i < bytes.size(); i += kBytesOfLine) {
    const std::string_view line = bytes.substr(i, kBytesOfLine);
    unsigned char letters[65] = {};
    EVP_EncodeBlock(letters, reinterpret_cast<const unsigned char*>(line.data()),
                    static_cast<int>(line.size()));
    pem += std::string(reinterpret_cast<const char*>(letters)) + "\n";
  }
  return pem + "-----END " + label + "-----\n";
}

}  // namespace foresight
