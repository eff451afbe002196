#include "ui/viewmodels/region_first.h"

#include "core/fitting/ray_set.h"

namespace foresight {

RegionFirst::RegionFirst(HeadViewModel* head, SessionModel* session, HeadLink* link,
                         QObject* parent)
    : QObject(parent), head_(head), session_(session), link_(link) {
  // The head's end of the link forgets with each scan, too.
  connect(head_, &HeadViewModel::scanStarted, this, [this] {
    early_.reset();
    asked_.reset();
  });
  connect(head_, &HeadViewModel::scanCame, this,
          [this](const std::shared_ptr<const EarlyScan>& early) {
            early_ = early;
            Ask();
          });
  connect(session_, &SessionModel::roiChanged, this, &RegionFirst::Ask);
  // More lines tell more exactly which ones see it.
  connect(session_, &SessionModel::cloudChanged, this, &RegionFirst::Ask);
}

void RegionFirst::Ask() {
  if (!head_->Scanning()) return;
  std::optional<Seqs> wanted;
  if (session_->Region()) {
    const std::vector<std::int64_t> seqs = SeqsOfRows();
    if (seqs.empty()) return;  // nothing is here yet that tells
    wanted = SeqsOfRegion(seqs);
  }
  if (wanted == asked_) return;
  asked_ = wanted;
  link_->LinesFirst(wanted);
}

std::vector<std::int64_t> RegionFirst::SeqsOfRows() const {
  std::vector<std::int64_t> seqs;
  if (!session_->Cloud()) return seqs;
  if (early_ && early_->cloud == session_->Cloud()) {
    seqs = early_->cloud_seqs;
  } else if (const auto& part = session_->Part().scan) {
    for (const LidarLine& line : part->lines) seqs.push_back(line.seq);
  }
  if (std::ssize(seqs) != session_->Cloud()->lines) seqs.clear();
  return seqs;
}

std::optional<RegionFirst::Seqs> RegionFirst::SeqsOfRegion(
    const std::vector<std::int64_t>& seqs) const {
  const auto rows = RowsInRegion(*session_->Cloud(), session_->Rig(), *session_->Region());
  if (!rows) return std::nullopt;
  // What lies between the rows that see it and their neighbours may see it as well.
  const auto at = [&](int row) { return seqs[static_cast<std::size_t>(row)]; };
  const bool begins = rows->first == 0, ends = rows->second + 1 == std::ssize(seqs);
  return Seqs(begins ? at(0) : at(rows->first - 1) + 1,
              ends ? at(rows->second) : at(rows->second + 1) - 1);
}

}  // namespace foresight
