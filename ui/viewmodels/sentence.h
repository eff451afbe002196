#pragma once

#include <QString>
#include <string>

namespace foresight {

/// A message of the core as a sentence of its own: "the plan is empty" -> "The plan is empty."
inline QString Sentence(const std::string& text) {
  QString sentence = QString::fromStdString(text);
  if (!sentence.isEmpty()) sentence[0] = sentence[0].toUpper();
  return sentence + QLatin1Char('.');
}

}  // namespace foresight
