#pragma once

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QEvent>
#include <QMap>
#include <QMetaObject>
#include <QTest>
#include <QWidget>
#include <string>

#include "tests/ui/wait_for.h"

namespace foresight {

/// Counts what is drawn in the whole program while it lives, and says which widgets those were.
class PaintCounter : public QObject {
 public:
  PaintCounter() { qApp->installEventFilter(this); }
  ~PaintCounter() override { qApp->removeEventFilter(this); }

  int Paints() const { return paints_; }
  /// A widget a line: how often it was drawn, its name and those of the widgets that it is in.
  std::string Widgets() const {
    QString text;
    for (auto widget = counts_.begin(); widget != counts_.end(); ++widget)
      text += QStringLiteral("%1 x %2\n").arg(widget.value()).arg(widget.key());
    return text.toStdString();
  }

  bool eventFilter(QObject* object, QEvent* event) override {
    if (event->type() != QEvent::Paint) return false;
    ++paints_;
    ++counts_[NameOf(object)];
    return false;
  }

 private:
  static QString NameOf(const QObject* object) {
    QString name;
    for (; object != nullptr; object = object->parent()) {
      if (!name.isEmpty()) name += QStringLiteral(" in ");
      name += QString::fromLatin1(object->metaObject()->className());
      if (!object->objectName().isEmpty()) name += QLatin1Char('#') + object->objectName();
      if (const QVariant text = object->property("text"); !text.toString().isEmpty())
        name += QStringLiteral(" \"%1\"").arg(text.toString());
    }
    return name;
  }

  int paints_ = 0;
  QMap<QString, int> counts_;
};

/// Waits until a window that was shown is drawn and nothing has been drawn for a while: a busy X
/// server asks for the first drawing whenever it comes to it, and what counts drawings starts then.
inline bool WaitUntilDrawn(QWidget& window) {
  constexpr int kQuiet_ms = 250;
  if (!QTest::qWaitForWindowExposed(&window)) return false;
  const PaintCounter counter;
  QElapsedTimer quiet;
  quiet.start();
  int seen = 0;
  return WaitFor([&] {
    if (counter.Paints() != seen) quiet.restart();
    seen = counter.Paints();
    return quiet.elapsed() > kQuiet_ms;
  });
}

}  // namespace foresight
