#include "app/workstation/document_stack.h"

namespace foresight {

DocumentStack::DocumentStack(QWidget* live, std::function<QWidget*()> make_review, QWidget* parent)
    : QStackedWidget(parent), make_review_(std::move(make_review)) {
  addWidget(live);
}

void DocumentStack::ShowDocument(bool review) {
  if (review && count() == 1) addWidget(make_review_());
  setCurrentIndex(review ? 1 : 0);
}

}  // namespace foresight
