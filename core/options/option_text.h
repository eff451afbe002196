#pragma once

#include <string>

#include "core/options/option.h"

namespace foresight {

/// A value as people type it, in the option's unit: "30", "on", "397,390". Numbers have as many
/// digits as they need to be read back as they are.
std::string OptionText(const OptionInfo& info, const OptionValue& value);

/// The same with its unit, for texts: "30 mm"; what 0 stands for where it stands for a rule.
std::string OptionInWords(const OptionInfo& info, const OptionValue& value);

/// The reverse of OptionText. Fails with kInvalidOptions, saying what is expected.
Result<OptionValue> OptionFromText(const OptionInfo& info, const std::string& text);

/// "a number", "one of max, min, off", ...
std::string TypeText(const OptionInfo& info);
/// "from 0 to 1", "0 mm or more", "one of max, min, off"
std::string RangeText(const OptionInfo& info);

}  // namespace foresight
