#pragma once

#include <arv.h>

#include <memory>
#include <string>

namespace foresight {

struct UnrefObject {
  void operator()(void* object) const { g_object_unref(object); }
};
/// A reference to an object of GLib or Aravis.
template <class T>
using ArvHandle = std::unique_ptr<T, UnrefObject>;

/// Where a call of Aravis leaves its error.
class ArvFailure {
 public:
  ArvFailure() = default;
  ~ArvFailure() { g_clear_error(&error_); }
  ArvFailure(const ArvFailure&) = delete;
  ArvFailure& operator=(const ArvFailure&) = delete;

  GError** out() { return &error_; }
  explicit operator bool() const { return error_ != nullptr; }
  bool IsTimeout() const {
    return g_error_matches(error_, ARV_DEVICE_ERROR, ARV_DEVICE_ERROR_TIMEOUT) != 0;
  }
  std::string text() const { return error_ ? error_->message : "for an unknown reason"; }

 private:
  GError* error_ = nullptr;
};

}  // namespace foresight
