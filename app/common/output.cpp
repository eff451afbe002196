#include "app/common/output.h"

#include <cstdio>

namespace foresight {

void PrintJson(const nlohmann::ordered_json& json) {
  PrintLine(json.dump(2));
}

void PrintLine(const std::string& line) {
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace foresight
