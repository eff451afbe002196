#include "hardware/link/pki/link_role.h"

#include <algorithm>

#include "core/base/printable.h"

namespace foresight {
namespace {

constexpr std::string_view kScheme = "foresight:";
constexpr std::size_t kLongestName = 40;

bool IsLower(char c) {
  return c >= 'a' && c <= 'z';
}

bool IsDigit(char c) {
  return c >= '0' && c <= '9';
}

bool IsLetterOrDigit(char c) {
  return IsLower(c) || (c >= 'A' && c <= 'Z') || IsDigit(c);
}

bool IsInName(char c) {
  return IsLetterOrDigit(c) || c == '-' || c == '_' || c == '.';
}

bool IsInNameOfHead(char c) {
  return IsLower(c) || IsDigit(c) || c == '-';
}

}  // namespace

std::string ToString(LinkRole role) {
  switch (role) {
    case LinkRole::kHead:
      return "head";
    case LinkRole::kOperator:
      return "operator";
    case LinkRole::kObserver:
      break;
  }
  return "observer";
}

std::optional<LinkRole> LinkRoleFromText(std::string_view text) {
  for (const LinkRole role : {LinkRole::kHead, LinkRole::kOperator, LinkRole::kObserver})
    if (text == ToString(role)) return role;
  return std::nullopt;
}

std::string LinkIdentity::ToUri() const {
  return fmt::format("{}{}:{}", kScheme, ToString(role), name);
}

std::optional<LinkIdentity> LinkIdentity::FromUri(std::string_view uri) {
  if (!uri.starts_with(kScheme)) return std::nullopt;
  uri.remove_prefix(kScheme.size());
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const std::optional<LinkRole> role = LinkRoleFromText(uri.substr(0, colon));
  const std::string_view name = uri.substr(colon + 1);
  if (!role || !CheckLinkName(*role, name)) return std::nullopt;
  return LinkIdentity{*role, std::string(name)};
}

Status CheckLinkName(LinkRole role, std::string_view name) {
  const bool head = role == LinkRole::kHead;
  if (!name.empty() && name.size() <= kLongestName && IsLetterOrDigit(name.front()) &&
      name.back() != '-' && std::all_of(name.begin(), name.end(), head ? IsInNameOfHead : IsInName))
    return {};
  return Fail(ErrorCode::kInvalidOptions,
              "{} is no name of {} {}: use 1 to {} {}, beginning with a letter or a digit",
              name.empty() ? "an empty text" : Printable(name.substr(0, 2 * kLongestName)),
              head ? "a" : "an", ToString(role), kLongestName,
              head ? "lower-case letters, digits and '-'" : "letters, digits, '-', '_' and '.'");
}

std::string StableHostOfHead(std::string_view name) {
  return fmt::format("{}.foresight.internal", name);
}

}  // namespace foresight
