#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hardware/link/burst/burst_key.h"
#include "hardware/link/burst/replay_window.h"

struct evp_cipher_ctx_st;

namespace foresight {

// A datagram of a burst path (docs/protocols.md): "FSB1", u32 id of the key, u64 number, then
// AES-256-GCM of the content, then its tag. What stands openly is authenticated too; the number
// is the nonce.

inline constexpr std::size_t kDatagramHeadBytes = 16;
inline constexpr std::size_t kDatagramTagBytes = 16;
inline constexpr std::size_t kDatagramSealBytes = kDatagramHeadBytes + kDatagramTagBytes;
/// Of a sealed datagram, whatever a request says: with UDP and IP around it fits an Ethernet.
inline constexpr std::size_t kMostDatagramBytes = 1400;
inline constexpr std::size_t kLeastDatagramBytes = 256;

struct FreeCipher {
  void operator()(evp_cipher_ctx_st* context) const;
};
using CipherContext = std::unique_ptr<evp_cipher_ctx_st, FreeCipher>;

/// Seals datagrams under one key, each with a number that was never used under it. Not for several
/// threads at a time.
class DatagramSealer {
 public:
  /// Datagrams of one key. 2^38 blocks of AES leave a chance of 2^-51 to tell them from noise.
  static constexpr std::uint64_t kMostDatagrams = std::uint64_t{1} << 32;

  /// Fails with kDevice where OpenSSL has no AES-256-GCM.
  static Result<DatagramSealer> Make(const BurstKey& key);
  /// `sealed` becomes the datagram. Fails with kState when the key is used up, kDevice.
  Status Seal(std::span<const std::uint8_t> content, std::vector<std::uint8_t>& sealed);

 private:
  DatagramSealer(const BurstKey& key, CipherContext context)
      : key_id_(key.id), context_(std::move(context)) {}

  std::uint32_t key_id_;
  CipherContext context_;
  std::uint64_t number_ = 0;
};

/// What a datagram turned out to be.
enum class DatagramVerdict {
  kGood,
  kNoDatagram,  ///< too short or too long, or not begun as one
  kForeignKey,
  kReplayed,  ///< its number was used, or is too old to know
  kForged,
};

/// Opens datagrams of one key. Not for several threads at a time.
class DatagramOpener {
 public:
  /// Fails with kDevice where OpenSSL has no AES-256-GCM.
  static Result<DatagramOpener> Make(const BurstKey& key);
  /// `content` is the sealed content where the datagram is good; every other one leaves the opener
  /// as it was.
  DatagramVerdict Open(std::span<const std::uint8_t> datagram, std::vector<std::uint8_t>& content);

 private:
  DatagramOpener(const BurstKey& key, CipherContext context)
      : key_id_(key.id), context_(std::move(context)) {}

  std::uint32_t key_id_;
  CipherContext context_;
  ReplayWindow window_;
};

}  // namespace foresight
