#pragma once

#include <QObject>
#include <QTimer>
#include <functional>
#include <optional>
#include <vector>

#include "app/workstation/open_head.h"
#include "hardware/link/discovery/announced_head.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// Finds heads on the local network, and connects to the one that the operator chooses. The head
/// that the window has stays until the other one has answered.
class ConnectModel : public QObject {
  Q_OBJECT

 public:
  struct Network {
    std::vector<AnnouncedHead> heads;
    std::string trouble;  ///< why none can be found; empty = the network is searched

    bool operator==(const Network&) const = default;
  };
  using Search = std::function<Network()>;
  using Open = std::function<Result<OpenedHead>(const LinkArguments&)>;

  /// `open` is called from a task.
  ConnectModel(Search search, Open open, TaskQueue* tasks, QObject* parent = nullptr);

  const std::vector<AnnouncedHead>& Heads() const { return network_.heads; }
  /// What came of the search.
  QString SearchText() const;
  /// What came of connecting; empty before it was tried.
  const QString& StateText() const { return state_; }
  bool Failed() const { return failed_; }
  bool Connecting() const { return runner_.Busy(); }

  /// Does nothing while another head is asked.
  void Connect(const LinkArguments& link);
  /// HOST:PORT of the head that was asked last.
  const std::string& Address() const { return address_; }
  /// The head that answered, once.
  std::optional<OpenedHead> TakeHead() { return std::exchange(opened_, std::nullopt); }

 public Q_SLOTS:
  void cancel();  ///< the answer of the head that is asked is not waited for any more

 Q_SIGNALS:
  void changed();
  void opened();  ///< TakeHead has one

 private:
  void Look();

  const Search search_;
  const Open open_;
  Network network_;
  std::string address_;
  QString state_;
  bool failed_ = false;
  std::optional<OpenedHead> opened_;
  QTimer timer_;
  TaskRunner runner_;
};

}  // namespace foresight
