#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QLabel>
#include <cmath>

#include "ui/panels/source_gallery.h"

namespace foresight {
namespace {

/// Relative luminance as WCAG 2.1 has it.
double Luminance(const QColor& color) {
  const auto linear = [](double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
         0.0722 * linear(color.blueF());
}

double Contrast(const QColor& a, const QColor& b) {
  const double first = Luminance(a), second = Luminance(b);
  return (std::max(first, second) + 0.05) / (std::min(first, second) + 0.05);
}

/// The largest contrast of a pixel of `part` with what `badge` is filled with.
double ContrastOf(const QImage& badge, const QRect& part) {
  const QColor fill = badge.pixelColor(badge.width() / 2, 1);
  double most = 1.0;
  for (int y = part.top(); y <= part.bottom(); ++y)
    for (int x = part.left(); x <= part.right(); ++x)
      most = std::max(most, Contrast(badge.pixelColor(x, y), fill));
  return most;
}

SourceAnswer AnswerOf(bool found, VerdictLevel level) {
  SourceAnswer answer;
  answer.source = QStringLiteral("lidar returns");
  answer.found = found;
  answer.level = level;
  answer.probability = 0.9;
  answer.picture = ColorImage(30, 20, Rgb8{90, 90, 90});
  return answer;
}

TEST(SourceGalleryOnScreen, IconAndWordsOfEveryVerdictStandOutFromTheirBadge) {
  SourceGallery gallery;
  gallery.Show({AnswerOf(true, VerdictLevel::kConfirmed), AnswerOf(true, VerdictLevel::kLikely),
                AnswerOf(true, VerdictLevel::kUnsure), AnswerOf(false, VerdictLevel::kUnsure)});
  gallery.resize(1400, 400);
  gallery.show();
  QCoreApplication::processEvents();
  int badges = 0;
  for (QFrame* badge : gallery.findChildren<QFrame*>(QStringLiteral("verdict_badge"))) {
    const QImage image = badge->grab().toImage();
    for (const QLabel* label : badge->findChildren<QLabel*>()) {
      const QString what = label->text().isEmpty() ? QStringLiteral("icon") : label->text();
      // WCAG 2.1: 4.5 for words (1.4.3), 3 for icons (1.4.11).
      EXPECT_GE(ContrastOf(image, label->geometry()), label->text().isEmpty() ? 3.0 : 4.5)
          << what.toStdString() << " of badge " << badges;
    }
    ++badges;
  }
  EXPECT_EQ(badges, 4);
}

}  // namespace
}  // namespace foresight
