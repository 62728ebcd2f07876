// Messages for unknown words: the nearest word, or the nearest names of a list.
#pragma once

#include <string>
#include <vector>

namespace steradian::app {

// The candidate nearest to a misspelt word by edit distance, at most a third of the word away (and at least one letter); empty if there is
// none.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

// At most `most` of the candidates, those whose beginnings are most similar to the word first.
std::vector<std::string> nearest_beginnings(const std::string& word, std::vector<std::string> candidates, std::size_t most);

// The option that a misspelt one means: the nearest by nearest_word, else the shortest that begins with it. A single letter means none.
// Dashes and what follows an equals sign do not count.
std::string nearest_option(const std::string& given, const std::vector<std::string>& options);

// The message for an option that the verb does not have.
std::string unknown_option(const std::string& given, const std::vector<std::string>& options);

// The message for a first argument that is no verb of the program; empty if it is a verb.
std::string unknown_verb(const std::string& word, const std::vector<std::string>& verbs);

}  // namespace steradian::app
