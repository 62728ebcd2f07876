#include "ranks/command_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>

#include "steradian/error.h"

extern char** environ;

namespace steradian::app {
namespace {

constexpr const char* kParent = "STERADIAN_PARENT";  // the number of the process that started this one

std::string contents_of(int descriptor) {
  std::string text;
  char piece[4096];
  off_t at = 0;
  for (ssize_t size; (size = pread(descriptor, piece, sizeof piece, at)) > 0; at += size)
    text.append(piece, static_cast<std::size_t>(size));
  return text;
}

}  // namespace

bool follow_parent() {
  const char* parent = std::getenv(kParent);
  if (parent == nullptr) return false;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // The parent may have ended before the call.
  if (std::to_string(getppid()) != parent) _exit(1);
  return true;
}

CommandProcess::CommandProcess(const std::vector<std::string>& command, Prints prints) {
  messages_ = memfd_create("messages", MFD_CLOEXEC);
  if (messages_ < 0) throw Error(command[0], std::string("cannot keep its messages: ") + std::strerror(errno));
  std::vector<std::string> words = {"steradian"};
  words.insert(words.end(), command.begin(), command.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::string parent = std::string(kParent) + "=" + std::to_string(getpid()), quiet = "STERADIAN_PROGRESS=none";
  std::vector<char*> environment;
  for (char** variable = environ; *variable != nullptr; ++variable) environment.push_back(*variable);
  environment.insert(environment.end(), {parent.data(), quiet.data(), nullptr});

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (prints == Prints::no) posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, messages_, STDERR_FILENO);
  const int failed = posix_spawn(&process_, "/proc/self/exe", &files, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) {
    close(messages_);
    throw Error(command[0], std::string("cannot start its process: ") + std::strerror(failed));
  }
}

CommandProcess::~CommandProcess() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  close(messages_);
}

std::optional<CommandResult> CommandProcess::finished() {
  int status = 0;
  if (waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
  process_ = -1;
  CommandResult result{WIFEXITED(status) ? WEXITSTATUS(status) : 1, contents_of(messages_)};
  if (WIFSIGNALED(status)) result.message += std::string("steradian: a part was ended by a signal: ") + strsignal(WTERMSIG(status)) + "\n";
  return result;
}

}  // namespace steradian::app
