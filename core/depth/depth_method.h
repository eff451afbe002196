#pragma once

#include <span>
#include <string>

#include "core/depth/pipeline.h"

namespace foresight {

/// What people see and type of a method.
struct DepthMethodInfo {
  DepthMethod method;
  const char* name;         ///< on the command line and in files: "paper"
  const char* title;        ///< on the screen: "Paper (Shim 2016)"
  const char* description;  ///< one sentence
};

/// All methods, the default first.
std::span<const DepthMethodInfo> DepthMethods();
const DepthMethodInfo& InfoOf(DepthMethod method);
/// Fails with kInvalidOptions, listing the names there are.
Result<DepthMethod> DepthMethodFromName(const std::string& name);

/// The options that a method is meant to run with, its rejection stages included.
DepthOptions DefaultsOf(DepthMethod method);

}  // namespace foresight
