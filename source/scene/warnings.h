// Warnings: what the reader collects while it reads, each sentence once.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace steradian {

struct Warnings {
  std::vector<std::string> sentences;
  std::vector<std::string> unsupported;  // features, named together in one sentence at the end

  void say(const std::string& sentence) { add(sentences, sentence); }
  void not_supported(const std::string& feature) { add(unsupported, feature); }

private:
  static void add(std::vector<std::string>& list, const std::string& text) {
    if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
  }
};

}  // namespace steradian
