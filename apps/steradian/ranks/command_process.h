// CommandProcess: this program as a process of its own, with another command. Its messages are kept, and its end is polled.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace steradian::app {

struct CommandResult {
  int status = 0;       // exit status; 1 if a signal ended the process
  std::string message;  // standard error
};

class CommandProcess {
 public:
  // Standard output is shared, or dropped. The process shows no progress, and ends when this one ends.
  enum class Prints { yes, no };
  CommandProcess(const std::vector<std::string>& command, Prints prints);
  ~CommandProcess();  // ends a process that still runs
  CommandProcess(const CommandProcess&) = delete;
  CommandProcess& operator=(const CommandProcess&) = delete;

  // None while it runs.
  std::optional<CommandResult> finished();

 private:
  pid_t process_ = -1;
  int messages_ = -1;
};

// Called first in main: a process of CommandProcess asks to be ended with its parent. True in such a process.
bool follow_parent();

}  // namespace steradian::app
