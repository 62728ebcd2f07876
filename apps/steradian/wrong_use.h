// What a command line says that means nothing: verbs that do not exist, options that would change nothing.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace steradian::app {

// The candidate nearest to a misspelt word by edit distance, at most a third of the word away (and at least one letter);
// empty where none is.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

// At most so many of the candidates, those first that begin most like the word.
std::vector<std::string> nearest_beginnings(const std::string& word, std::vector<std::string> candidates, std::size_t most);

// What to say of a first argument that is no verb of the program; empty where it is one, or an option.
std::string unknown_verb(const CLI::App& app, int argc, const char* const* argv);

// An option that has an effect only under a condition.
struct ConditionalOption {
  const char* name;  // "--spp"
  bool has_effect;
  const char* needs;  // what gives it an effect: "--method sampled"
};

// Throws CLI::ValidationError for the first option that the user gave and that has no effect.
void refuse_without_effect(const CLI::App& verb, std::initializer_list<ConditionalOption> options);

}  // namespace steradian::app
