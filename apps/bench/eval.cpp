// eval/lambert: queries of `steradian eval`, from the text of a line to the text of its answer.
#include <fmt/format.h>

#include <memory>

#include "benches.h"
#include "eval/answer.h"
#include "steradian/error.h"

namespace steradian::bench {
namespace {

constexpr std::size_t kQueries = 1000;

struct Stream {
  std::vector<std::string> lines;  // each with padding behind its end
  std::string answers;
  eval::QueryReader reader;
};

Bench lambert(const std::string& name) {
  auto stream = std::make_shared<Stream>();
  for (std::size_t i = 0; i < kQueries; ++i) {
    const double t = static_cast<double>(i) / kQueries;
    std::string line =
        fmt::format(R"({{"light":{{"type":"polygon","vertices":[[-1,2,1],[1,2,1],[1,2,-1],[-1,{},-1]],"radiance":[1,0.9,0.8]}},)"
                    R"("position":[{},0,{}],"normal":[{},1,0],"material":{{"brdf":"lambert","albedo":0.5}},"method":"exact"}})",
                    2, 3 * t - 1.5, 1 - t, 0.2 * t);
    line.reserve(line.size() + eval::kQueryPadding);
    stream->lines.push_back(std::move(line));
  }
  return {name, kQueries, "", [stream] {
            stream->answers.clear();
            for (const std::string& line : stream->lines)
              if (!eval::answer_line(stream->reader, line, stream->answers)) throw Error("bench eval/lambert", stream->answers);
            keep(stream->answers.front());
          }};
}

}  // namespace

void add_eval(BenchList& list) {
  list.add("eval/lambert", [](const BenchOptions&) { return lambert("eval/lambert"); });
}

}  // namespace steradian::bench
