#include "ui/viewmodels/notice.h"

namespace foresight {
namespace {

QString NextStep(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidOptions:
      return QStringLiteral("Correct the value and try again.");
    case ErrorCode::kInvalidInput:
      return QStringLiteral("Scan again; if it stays, check the calibration.");
    case ErrorCode::kBadData:
      return QStringLiteral("Choose another file or scan again.");
    case ErrorCode::kIo:
      return QStringLiteral("Check that the folder exists and has room.");
    case ErrorCode::kDevice:
      return QStringLiteral("Check power and cables, then press Home.");
    case ErrorCode::kState:
      return QStringLiteral("Wait until the head is ready, or press Home.");
    case ErrorCode::kTooFewPoints:
      return QStringLiteral("Draw a larger region, or scan slower for more points.");
    case ErrorCode::kNoConvergence:
      return QStringLiteral("Draw the region closer around the object, or scan slower.");
    case ErrorCode::kCancelled:
      return QStringLiteral("What was shown before is kept.");
  }
  return {};
}

}  // namespace

Notice NoticeOf(const QString& doing, const Error& error) {
  const bool cancelled = error.code == ErrorCode::kCancelled;
  Notice notice;
  notice.level = cancelled ? Notice::Level::kInfo : Notice::Level::kError;
  notice.what = cancelled ? doing + QStringLiteral(" was cancelled.")
                          : doing + QStringLiteral(" failed: ") +
                                QString::fromStdString(error.message) + QStringLiteral(".");
  notice.next = NextStep(error.code);
  return notice;
}

}  // namespace foresight
