#pragma once

#include <QObject>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hardware/api/head_link.h"
#include "ui/viewmodels/head_view_model.h"
#include "ui/viewmodels/session_model.h"

namespace foresight {

/// Over a link: while a scan comes, the lines that see the operator's region come before its
/// others, so that a fit can begin before all is here.
class RegionFirst : public QObject {
  Q_OBJECT

 public:
  /// Both outlive it; `link` is the head's.
  RegionFirst(HeadViewModel* head, SessionModel* session, HeadLink* link,
              QObject* parent = nullptr);

 private:
  using Seqs = std::pair<std::int64_t, std::int64_t>;
  void Ask();
  /// Of the rows of the cloud that is shown; empty where that is not known.
  std::vector<std::int64_t> SeqsOfRows() const;
  /// First and last seq that may see the region, as far as the rows tell.
  std::optional<Seqs> SeqsOfRegion(const std::vector<std::int64_t>& seqs) const;

  HeadViewModel* head_;
  SessionModel* session_;
  HeadLink* link_;
  std::shared_ptr<const EarlyScan> early_;
  std::optional<Seqs> asked_;
};

}  // namespace foresight
