// Warnings: messages that the reader collects, grouped by kind. A broken file causes the same warning for thousands of its parts.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace steradian::scene {

class Warnings {
 public:
  // Adds a whole sentence; repeated sentences appear once.
  void say(const std::string& sentence) { kind(sentence); }

  // Counts a warning about one part of the file. The sentence ends with the number of such parts and the place of the first.
  void count(const std::string& what, const std::string& place) {
    Kind& k = kind(what);
    if (k.count++ == 0) k.first_place = place;
  }

  // Adds an unsupported feature that is skipped. The last sentence names all of them together.
  void not_supported(const std::string& feature) {
    if (!features_.insert(feature).second || features_.size() > kMostNamed) return;
    features_in_order_.push_back(feature);
    feature_list_ += (feature_list_.empty() ? "" : ", ") + feature;
  }

  const std::vector<std::string>& features() const { return features_in_order_; }

  // The sentences in the order in which their kinds first appeared.
  std::vector<std::string> sentences() const {
    std::vector<std::string> result;
    for (const Kind& k : kinds_)
      result.push_back(k.count == 0   ? k.what
                       : k.count == 1 ? k.what + ": " + k.first_place
                                      : k.what + ": " + std::to_string(k.count) + " times, the first is " + k.first_place);
    if (features_.empty()) return result;
    std::string last = "the file uses what is not supported and left out: " + feature_list_;
    if (features_.size() > kMostNamed) last += " and " + std::to_string(features_.size() - kMostNamed) + " more";
    result.push_back(last);
    return result;
  }

 private:
  static constexpr std::size_t kMostNamed = 16;
  struct Kind {
    std::string what, first_place;
    std::size_t count = 0;
  };

  Kind& kind(const std::string& what) {
    const auto [it, fresh] = index_.emplace(what, kinds_.size());
    if (fresh) kinds_.push_back({what, {}, 0});
    return kinds_[it->second];
  }

  std::vector<Kind> kinds_;
  std::unordered_map<std::string, std::size_t> index_;  // into kinds_, by what
  std::unordered_set<std::string> features_;
  std::vector<std::string> features_in_order_;
  std::string feature_list_;
};

}  // namespace steradian::scene
