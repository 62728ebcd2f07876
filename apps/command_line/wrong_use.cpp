#include "wrong_use.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace steradian::app {
namespace {

// Edit distances between a word and each prefix of the other, from the empty one to the whole word. Counts insertions, deletions,
// replacements and swaps of neighbours (optimal string alignment).
std::vector<std::size_t> edit_distances(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  std::iota(d[0].begin(), d[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()];
}

// "--size=10x10" without its dashes and its value.
std::string bare(const std::string& option) {
  const std::string named = option.substr(0, option.find('='));
  return named.substr(std::min(named.find_first_not_of('-'), named.size()));
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > 64) return {};
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distances(word, candidate).back();
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

std::vector<std::string> nearest_beginnings(const std::string& word, std::vector<std::string> candidates, std::size_t most) {
  const std::string start = word.substr(0, 64);
  std::vector<std::pair<std::size_t, std::size_t>> order;  // distance, index
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::vector<std::size_t> distances = edit_distances(start, candidates[i]);
    order.emplace_back(*std::min_element(distances.begin(), distances.end()), i);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(most, order.size()));
  std::vector<std::string> nearest;
  for (const auto& [distance, place] : order) nearest.push_back(std::move(candidates[place]));
  return nearest;
}

std::string nearest_option(const std::string& given, const std::vector<std::string>& options) {
  const std::string word = bare(given);
  if (word.size() < 2) return {};
  std::vector<std::string> words;
  for (const std::string& option : options) words.push_back(bare(option));
  const std::string nearest = nearest_word(word, words);
  std::string found;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const bool meant = nearest.empty() ? words[i].starts_with(word) : words[i] == nearest;
    if (meant && (found.empty() || options[i].size() < found.size())) found = options[i];
  }
  return found;
}

std::string unknown_option(const std::string& given, const std::vector<std::string>& options) {
  const std::string nearest = nearest_option(given, options);
  const std::string named = given.substr(0, given.find('=')).substr(0, 64);
  return "unknown option " + named + (nearest.empty() ? std::string() : "; did you mean " + nearest + "?");
}

std::string unknown_verb(const std::string& word, const std::vector<std::string>& verbs) {
  std::string list;
  for (const std::string& verb : verbs) {
    if (verb == word) return {};
    list += (list.empty() ? "" : ", ") + verb;
  }
  const std::string nearest = nearest_word(word, verbs);
  return "'" + word.substr(0, 64) + "' is not a verb" + (nearest.empty() ? "; verbs: " + list : "; did you mean '" + nearest + "'?");
}

}  // namespace steradian::app
