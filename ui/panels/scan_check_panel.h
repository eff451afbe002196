#pragma once

#include <QWidget>

#include "ui/viewmodels/scan_check_model.h"

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace foresight {

/// The details behind the check lamp: every point with its own lamp and sentence, the points of all
/// scans of the mission together, what the scan cannot tell, and a button that checks the scan on
/// the screen again.
class ScanCheckPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ScanCheckPanel(ScanCheckModel* check, QWidget* parent = nullptr);

 private:
  void Show();
  QWidget* PointRow(CheckLight light, const std::string& sentence) const;
  QWidget* PointRows(const std::vector<CheckPoint>& points, const char* name) const;

  ScanCheckModel* check_;
  QLabel* sentence_;
  QLabel* when_;
  QVBoxLayout* points_;
  QLabel* together_title_;
  QVBoxLayout* together_;
  QWidget* list_ = nullptr;           ///< of the scan
  QWidget* together_list_ = nullptr;  ///< of all scans together
  QLabel* cannot_see_title_;
  QLabel* cannot_see_;
  QPushButton* again_;
  QPushButton* cancel_;
};

}  // namespace foresight
