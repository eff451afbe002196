#include "ui/viewmodels/bytes_text.h"

#include <QCoreApplication>

namespace foresight {
namespace {

struct Texts {
  Q_DECLARE_TR_FUNCTIONS(BytesText)
};

}  // namespace

QString BytesText(std::int64_t bytes) {
  if (bytes < 1000) return Texts::tr("%1 B").arg(bytes);
  const double thousands = 1e-3 * static_cast<double>(bytes);
  const bool mega = thousands >= 999.5;
  const double value = mega ? 1e-3 * thousands : thousands;
  const QString number = QString::number(value, 'f', value < 9.95 ? 1 : 0);
  return mega ? Texts::tr("%1 MB").arg(number) : Texts::tr("%1 kB").arg(number);
}

}  // namespace foresight
