#include "ui/viewmodels/command_table.h"

#include <algorithm>
#include <cstring>

#include "core/base/contract.h"

namespace foresight {

void CommandTable::Add(Command command) {
  FORESIGHT_EXPECTS(command.run != nullptr, "a command does something");
  FORESIGHT_EXPECTS(
      std::none_of(commands_.begin(), commands_.end(),
                   [&](const auto& other) { return std::strcmp(other->id, command.id) == 0; }),
      "every command has an id of its own");
  commands_.push_back(std::make_unique<Command>(std::move(command)));
}

const Command& CommandTable::Get(const char* id) const {
  for (const auto& command : commands_)
    if (std::strcmp(command->id, id) == 0) return *command;
  throw ContractViolation("commands_", std::string("no such command: ") + id, __FILE__, __LINE__);
}

bool CommandTable::Has(const char* id) const {
  for (const auto& command : commands_)
    if (std::strcmp(command->id, id) == 0) return true;
  return false;
}

bool CommandTable::Run(const char* id) {
  const Command& command = Get(id);
  if (const QString why = command.WhyNot(); !why.isEmpty()) {
    Q_EMIT refused(command.text, why);
    return false;
  }
  command.run();
  Q_EMIT ran(QString::fromLatin1(id));
  return true;
}

}  // namespace foresight
