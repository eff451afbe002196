#pragma once

namespace foresight {

/// Whether a sanitizer watches this build: it runs some ten times slower than others, and so do
/// emulated devices, which have to keep up with real time.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
/// For limits on time.
inline constexpr double kSanitizerFactor = kSanitized ? 10.0 : 1.0;

}  // namespace foresight
