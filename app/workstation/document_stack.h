#pragma once

#include <QStackedWidget>
#include <functional>

namespace foresight {

/// One place of the window that shows a widget for each document: the live one, and the one for
/// review, which is made when it is first asked for. What is hidden draws nothing.
class DocumentStack : public QStackedWidget {
  Q_OBJECT

 public:
  DocumentStack(QWidget* live, std::function<QWidget*()> make_review, QWidget* parent = nullptr);
  void ShowDocument(bool review);

 private:
  std::function<QWidget*()> make_review_;
};

}  // namespace foresight
