#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include "core/progress.h"
#include "ranks/command_process.h"
#include "ranks/parts_folder.h"
#include "ranks/ranks.h"
#include "ranks/shared_run.h"
#include "steradian/error.h"
#include "verb.h"

namespace steradian::app {
namespace {

constexpr int kCommand = 1, kReport = 2, kEnd = 3;  // tags: from rank 0; to rank 0; the last message of a rank
// A rank that is late delays the end by one of its parts, and each part loads the scene.
constexpr int kPartsARank = 8;

// MPI's own waiting takes a whole processor, which the parts need.
void rest() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

struct Message {
  int from = 0, tag = 0;
  std::string text;
};

void send(int to, int tag, const std::string& text) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, tag, MPI_COMM_WORLD);
}

std::optional<Message> received() {
  int is_there = 0, size = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status);
  if (is_there == 0) return std::nullopt;
  MPI_Get_count(&status, MPI_CHAR, &size);
  Message message{status.MPI_SOURCE, status.MPI_TAG, std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Recv(message.text.data(), size, MPI_CHAR, message.from, message.tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return message;
}

Message wait_for_message() {
  for (;;) {
    if (auto message = received()) return *message;
    rest();
  }
}

// Commands and results as one text.
std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + '\0';
  return text;
}
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size(); at = text.find('\0', at) + 1) words.emplace_back(text.c_str() + at);
  return words;
}
std::string text_of(const CommandResult& result) { return std::to_string(result.status) + "\n" + result.message; }
CommandResult result_of(const std::string& text) { return {std::atoi(text.c_str()), text.substr(text.find('\n') + 1)}; }

CommandResult failure(const std::exception& e) { return {1, std::string("steradian: ") + e.what() + "\n"}; }

// Runs commands of rank 0 until it sends an empty one.
void serve() {
  send(0, kReport, "");
  std::string command = wait_for_message().text;
  while (!command.empty()) {
    CommandResult result;
    std::string next;
    bool has_next = false;
    try {
      CommandProcess process(words_of(command), CommandProcess::Prints::no);
      for (auto end = process.finished();; end = process.finished()) {
        if (end) {
          result = *end;
          break;
        }
        // A command before the end of this one is the empty one: the run is over, and the process is ended.
        if (auto message = received()) {
          next = message->text;
          has_next = true;
          break;
        }
        rest();
      }
    } catch (const std::exception& e) {
      result = failure(e);
    }
    if (!has_next) {
      send(0, kReport, text_of(result));
      next = wait_for_message().text;
    }
    command = next;
  }
  send(0, kEnd, "");
}

// mpirun ends all ranks with SIGTERM when one of them has died.
std::string last_words;
void say_last_words(int number) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, last_words.data(), last_words.size());
  std::signal(number, SIG_DFL);
  std::raise(number);
}

// Rank 0: hands out the parts, and joins them.
class HandOut {
 public:
  HandOut(const SharedRun& run, int ranks) : run_(run) {
    count_ = std::min(run.most_parts, kPartsARank * ranks);
    left_.resize(static_cast<std::size_t>(count_));
    std::iota(left_.begin(), left_.end(), 1);
    if (run.joins()) {
      folder_ = std::make_unique<PartsFolder>(run, count_);
      count_ = folder_->parts();
      left_ = folder_->missing();
      last_words = "steradian: the run ended early; " + hint() + "\n";
    } else {
      last_words = "steradian: the run ended early; finished files stay, and the same command goes on\n";
    }
    std::signal(SIGTERM, say_last_words);
    progress_ = std::make_unique<Progress>(run.verb + " on " + std::to_string(ranks) + " ranks", static_cast<std::uint64_t>(count_));
    progress_->add(static_cast<std::uint64_t>(count_) - left_.size());
  }

  int run() {
    while (status_ == 0 && (!left_.empty() || in_flight_ > 0)) {
      if (auto message = received()) {
        if (!message->text.empty()) take(result_of(message->text));
        idle_.push_back(message->from);
      }
      if (own_) {
        if (const auto end = own_->finished()) {
          own_.reset();
          take(*end);
        }
      }
      hand_out();
      rest();
    }
    own_.reset();
    progress_.reset();
    if (status_ == 0 && run_.joins()) join();
    std::signal(SIGTERM, SIG_DFL);
    if (!folder_) return status_;
    if (status_ == 0 || static_cast<int>(folder_->missing().size()) == count_)
      folder_->remove();
    else
      std::fprintf(stderr, "steradian: %s\n", hint().c_str());
    return status_;
  }

 private:
  std::string hint() const { return "finished parts stay in " + folder_->path() + ", and the same command with --resume goes on"; }

  std::vector<std::string> next_command() {
    const int number = left_.front();
    left_.erase(left_.begin());
    ++in_flight_;
    return run_.part(number, count_, folder_ ? folder_->path() : std::string());
  }

  void hand_out() {
    if (status_ != 0) return;
    while (!left_.empty() && !idle_.empty()) {
      send(idle_.back(), kCommand, joined(next_command()));
      idle_.pop_back();
    }
    if (left_.empty() || own_) return;
    try {
      own_ = std::make_unique<CommandProcess>(next_command(), CommandProcess::Prints::no);
    } catch (const std::exception& e) {
      take(failure(e));
    }
  }

  void take(const CommandResult& result) {
    --in_flight_;
    progress_->wipe();
    show(result.message);
    if (result.status != 0)
      status_ = result.status;
    else
      progress_->add();
  }

  // All parts warn of the same scene: each line is shown once.
  void show(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (said_.insert(line).second) std::fprintf(stderr, "%s\n", line.c_str());
  }

  void join() {
    CommandProcess process(run_.join(count_, folder_->path()), CommandProcess::Prints::yes);
    std::optional<CommandResult> end;
    while (!(end = process.finished())) rest();
    show(end->message);
    status_ = end->status;
  }

  const SharedRun& run_;
  int count_ = 1, in_flight_ = 0, status_ = 0;
  std::unique_ptr<PartsFolder> folder_;
  std::vector<int> left_, idle_;
  std::unique_ptr<CommandProcess> own_;
  std::unique_ptr<Progress> progress_;
  std::set<std::string> said_;
};

int lead(const std::vector<std::string>& command, int ranks) {
  try {
    const SharedRun run = shared_run(command);
    return HandOut(run, ranks).run();
  } catch (const UsageError& e) {
    std::fprintf(stderr, "steradian: %s\n", e.what());
    return 2;
  } catch (const WrongOption& e) {
    std::fprintf(stderr, "steradian: %s: %s\n", e.option().c_str(), e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "steradian: %s\n", e.what());
    return 1;
  }
}

}  // namespace

bool is_rank() {
  const char* count = std::getenv("OMPI_COMM_WORLD_SIZE");
  return count != nullptr ? std::atoi(count) > 1 : std::getenv("PMIX_RANK") != nullptr;
}

int run_with_ranks(int& argc, char**& argv, const std::vector<std::string>& command) {
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 1, status = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (rank == 0) {
    status = lead(command, ranks);
    // Every rank answers the empty command, behind reports that nobody needs any more.
    for (int to = 1; to < ranks; ++to) send(to, kCommand, "");
    for (int ended = 1; ended < ranks; ended += wait_for_message().tag == kEnd) {
    }
  } else {
    serve();
  }
  MPI_Finalize();
  return status;
}

}  // namespace steradian::app
