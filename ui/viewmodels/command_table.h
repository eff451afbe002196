#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <vector>

namespace foresight {

/// One thing that the operator can do. Menus, buttons, keys and the sheet of shortcuts are made
/// from these rows.
struct Command {
  enum class Scope {
    kWindow,  ///< its key acts in the main window and its docks
    kPane,    ///< its key acts while a pane has the focus; elsewhere the key means something else
    kEverywhere,  ///< its key acts in every window of the program, whatever has the focus
  };

  const char* id = "";    ///< "head.stop": stable, for tests and the journal
  const char* menu = "";  ///< "head": the menu that lists it; empty = none
  const char* icon = "";
  QString text = {};  ///< "Stop head"
  QString tip = {};   ///< one sentence
  QString keys = {};  ///< as QKeySequence writes them; empty = none
  Scope scope = Scope::kWindow;
  bool in_tool_bar = false;
  std::function<void()> run = nullptr;
  /// Empty while it may be run; else why not, as a sentence for the operator. nullptr = always.
  std::function<QString()> why_not = nullptr;
  /// Whether it is on, for a command that switches something.
  std::function<bool()> checked = nullptr;

  QString WhyNot() const { return why_not ? why_not() : QString(); }
  bool Allowed() const { return WhyNot().isEmpty(); }
};

/// All commands of the program, one row each.
class CommandTable : public QObject {
  Q_OBJECT

 public:
  explicit CommandTable(QObject* parent = nullptr) : QObject(parent) {}

  /// Throws ContractViolation where the id is taken or there is nothing to run.
  void Add(Command command);
  const std::vector<std::unique_ptr<Command>>& All() const { return commands_; }
  /// Throws ContractViolation where there is no such command.
  const Command& Get(const char* id) const;
  bool Has(const char* id) const;
  /// Runs it if it is allowed; else emits `refused` with the reason.
  bool Run(const char* id);

 public Q_SLOTS:
  /// What is allowed or on may have changed.
  void refresh() { Q_EMIT changed(); }

 Q_SIGNALS:
  void changed();
  void ran(const QString& id);
  void refused(const QString& text, const QString& why);

 private:
  std::vector<std::unique_ptr<Command>> commands_;
};

}  // namespace foresight
