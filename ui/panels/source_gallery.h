#pragma once

#include <QWidget>
#include <vector>

#include "ui/viewmodels/source_gallery_model.h"

class QGridLayout;

namespace foresight {

/// Sets the answers of every source side by side: a picture with the outline, the verdict with its
/// icon, the answer in words. A part of the main window: it never takes the focus.
class SourceGallery : public QWidget {
  Q_OBJECT

 public:
  explicit SourceGallery(QWidget* parent = nullptr);
  void Show(const std::vector<SourceAnswer>& answers);

 private:
  QGridLayout* grid_;
};

}  // namespace foresight
