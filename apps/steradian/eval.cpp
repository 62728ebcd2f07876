// steradian eval: evaluates single integrals, JSON lines in, JSON lines out, in constant memory.
#include "eval/answer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>

#include "core/files.h"
#include "core/progress.h"
#include "eval_plane.h"
#include "render/picture_options.h"
#include "steradian/error.h"
#include "verbs.h"

namespace steradian::app {
namespace {

constexpr std::size_t kReadSize = 1 << 18;
constexpr std::size_t kWriteSize = 1 << 16;
constexpr std::size_t kLongestLine = 64 << 20;

// Reads the lines of a descriptor in the memory of the longest line.
class LineReader {
 public:
  LineReader(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {
    buffer_.resize(kReadSize + eval::kQueryPadding);
  }

  enum class Got { line, too_long, end };

  // before_read runs before each call that may have to wait for input.
  template <class BeforeRead>
  Got next(std::string_view& line, BeforeRead before_read) {
    bool too_long = false;
    std::size_t searched = begin_;
    for (;;) {
      const void* newline = std::memchr(buffer_.data() + searched, '\n', end_ - searched);
      if (newline != nullptr) {
        const auto at = static_cast<std::size_t>(static_cast<const char*>(newline) - buffer_.data());
        line = {buffer_.data() + begin_, at - begin_};
        begin_ = at + 1;
        return too_long ? Got::too_long : Got::line;
      }
      if (at_end_) {
        if (begin_ == end_ && !too_long) return Got::end;
        line = {buffer_.data() + begin_, end_ - begin_};
        begin_ = end_;
        return too_long ? Got::too_long : Got::line;
      }
      if (end_ - begin_ > kLongestLine) {
        too_long = true;
        begin_ = end_;
      }
      make_room();
      searched = end_;
      before_read();
      fill();
    }
  }

 private:
  // Moves the unfinished line to the front and provides space behind it.
  void make_room() {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    if (buffer_.size() - eval::kQueryPadding - end_ < kReadSize / 2) buffer_.resize(2 * buffer_.size());
  }
  void fill() {
    ssize_t n = 0;
    do n = read(descriptor_, buffer_.data() + end_, buffer_.size() - eval::kQueryPadding - end_);
    while (n < 0 && errno == EINTR);
    if (n < 0) throw Error(name_, std::string("cannot read: ") + std::strerror(errno));
    end_ += static_cast<std::size_t>(n);
    at_end_ = n == 0;
  }

  int descriptor_;
  std::string name_;
  std::string buffer_;
  std::size_t begin_ = 0, end_ = 0;  // range of bytes read but not yet returned
  bool at_end_ = false;
};

// Standard output, or a file that appears when it is complete.
class Output {
 public:
  explicit Output(const std::string& path) {
    if (!path.empty() && path != "-") file_.emplace(path);
    text.reserve(2 * kWriteSize);
  }
  void flush() {
    if (file_)
      file_->write(text);
    else
      write_all(STDOUT_FILENO, text, "standard output");
    text.clear();
  }
  void finish() {
    flush();
    if (file_) file_->commit();
  }
  std::string text;

 private:
  std::optional<AtomicFile> file_;
};

struct Input {
  explicit Input(const std::string& path)
      : name(path.empty() || path == "-" ? "standard input" : path),
        descriptor(name != path ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor < 0) throw Error(path, std::string("cannot open: ") + std::strerror(errno), "check the name");
  }
  ~Input() {
    if (descriptor != STDIN_FILENO) close(descriptor);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  std::string name;
  int descriptor;
};

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\r") == std::string_view::npos; }

// True if every line was answered. `answer` appends to the output.
template <class Answer>
bool answer_stream(const std::string& in, const std::string& out, Answer answer) {
  const Input input(in);
  Output output(out);
  LineReader lines(input.descriptor, input.name);
  Progress progress("eval", 0);
  bool all_answered = true;
  std::string_view line;
  for (;;) {
    // The output is flushed before waiting, so that a client that writes one query and waits gets its answer.
    const auto got = lines.next(line, [&] { output.flush(); });
    if (got == LineReader::Got::end) break;
    if (got == LineReader::Got::too_long) {
      eval::write_error(output.text, "the line is longer than 64 MiB (split it)");
      all_answered = false;
    } else if (!is_blank(line)) {
      all_answered &= answer(line, output.text);
    }
    progress.add();
    if (output.text.size() >= kWriteSize) output.flush();
  }
  output.finish();
  return all_answered;
}

struct EvalArguments {
  std::string input, output, method = "auto";
  int spp = 256;
  std::uint64_t seed = 1;
  bool plane = false;
  Limits limits;
};

}  // namespace

void add_eval(CommandLine& line) {
  Verb verb = line.verb("eval", "Answer single integrals: JSON lines in, JSON lines out");
  verb.group("Light");
  verb.footer(
      "A query: {\"light\": {\"type\": \"rect\", \"center\": [0,2,0], \"x\": [1,0,0], \"y\": [0,0,1], \"radiance\": 1},\n"
      "          \"position\": [0,0,0], \"normal\": [0,1,0], \"material\": {\"brdf\": \"lambert\", \"albedo\": 1}}\n"
      "Blank lines are skipped. A wrong line is answered by {\"error\": ...}, and the exit status is then 1.\n"
      "With --plane a query is {\"scene\": \"file.svg\", \"position\": [x, y]}.\n"
      "`steradian methods` lists the methods.");
  auto options = std::make_shared<EvalArguments>();
  verb.add("INPUT", options->input, "file of queries, one a line; default: standard input").default_text("");
  verb.add("-o,--output", options->output, "file of answers; default: standard output")
      .writes(Writes::file)
      .group("Input and output")
      .default_text("");
  verb.add_flag("--plane", options->plane, "light at points of plane scenes (.svg)").group("Input and output");
  verb.add("--method", options->method, "method of queries that name none").group("Defaults of a query").check([](const std::string& name) {
    return unknown_method(name, true);
  });
  verb.add("--spp", options->spp, "of sampled: sample pairs").group("Defaults of a query").range(1, std::numeric_limits<int>::max());
  verb.add("--seed", options->seed, "of sampled: seed of the random numbers").group("Defaults of a query");
  verb.add_limits(options->limits);
  verb.callback([options, &exit = line.exit()] {
    if (options->plane) {
      PlaneQueryDefaults plane;
      if (options->method != "auto") plane.method = plane_method_from_name(options->method);
      plane.sampling = {options->spp, options->seed};
      plane.limits = options->limits;
      PlaneAnswers answers(plane);
      const auto point = [&](std::string_view query, std::string& out) { return answers.answer_line(query, out); };
      if (!answer_stream(options->input, options->output, point)) exit.code = 1;
      return;
    }
    if (!method_of(options->method)) throw WrongOption("--method", options->method + " needs --plane");
    const eval::QueryDefaults defaults = {*method_of(options->method), options->spp, options->seed};
    eval::QueryReader reader(defaults);
    const auto answer = [&](std::string_view query, std::string& out) { return eval::answer_line(reader, query, out); };
    if (!answer_stream(options->input, options->output, answer)) exit.code = 1;
  });
}

}  // namespace steradian::app
