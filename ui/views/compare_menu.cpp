#include "ui/views/compare_menu.h"

namespace foresight {

using Kind = CompareViewModel::Kind;

CompareMenu::CompareMenu(SessionModel* session, CompareViewModel* compare, QWidget* parent)
    : QMenu(parent), session_(session), compare_(compare) {
  connect(this, &QMenu::aboutToShow, this, &CompareMenu::Fill);
}

QAction* CompareMenu::Add(const QString& text, bool checked) {
  QAction* action = addAction(text);
  action->setCheckable(true);
  action->setChecked(checked);
  return action;
}

void CompareMenu::Fill() {
  clear();
  const Kind kind = compare_->With();
  connect(Add(tr("Nothing"), kind == Kind::kNothing), &QAction::triggered, compare_,
          &CompareViewModel::compareWithNothing);
  connect(Add(tr("Camera image"), kind == Kind::kImage), &QAction::triggered, compare_,
          &CompareViewModel::compareWithImage);
  QAction* freeze = Add(tr("This depth, frozen as it is now"), kind == Kind::kFrozen);
  freeze->setEnabled(session_->Depth() != nullptr);
  connect(freeze, &QAction::triggered, compare_, &CompareViewModel::compareWithFrozen);
  if (kind == Kind::kResults)  // chosen in the list of side results; here it only can be ended
    Add(tr("%1 and %2").arg(compare_->FirstTitle(), compare_->SecondTitle()), true)
        ->setEnabled(false);
  addSection(tr("Method"));
  for (const DepthMethodInfo& info : DepthMethods()) {
    const bool checked = kind == Kind::kMethod && compare_->OtherMethod() == info.method;
    connect(Add(QString::fromUtf8(info.title), checked), &QAction::triggered, compare_,
            [this, method = info.method] { compare_->compareWithMethod(method); });
  }
}

}  // namespace foresight
