#include <cstring>
#include <string>

#include "eval/answer.h"
#include "targets.h"

namespace steradian::fuzz {

// Every line gets an answer or an error; nothing is thrown.
void eval(Input input) {
  steradian::eval::QueryReader reader({.spp = 4});
  std::string text(reinterpret_cast<const char*>(input.data()), input.size()), out;
  const std::size_t end = text.size();
  text.append(steradian::eval::kQueryPadding, ' ');
  for (std::size_t begin = 0; begin < end;) {
    const std::size_t stop = std::min(text.find('\n', begin), end);
    steradian::eval::answer_line(reader, std::string_view(text).substr(begin, stop - begin), out);
    out.clear();
    begin = stop + 1;
  }
}

}  // namespace steradian::fuzz
