// `steradian completion` and `steradian man`: every option of every verb is in each text, and shells take the texts.
#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "program.h"

namespace steradian::completion_program_test {
namespace {

// The first words of the lines of a help that begin as `begins` says, without commas.
std::set<std::string> names_in(const std::string& help, const std::string& begins) {
  std::set<std::string> names;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  " + begins)) continue;
    std::string first = line.substr(2, line.find(' ', 2) - 2);
    first = first.substr(0, first.find('{'));  // --one-setting{false}
    std::replace(first.begin(), first.end(), ',', ' ');
    std::istringstream words(first);
    for (std::string word; words >> word;) names.insert(word);
  }
  return names;
}

class Completion : public Program {
 protected:
  // Verbs and their options, as the help tells them.
  std::map<std::string, std::set<std::string>> options() {
    std::map<std::string, std::set<std::string>> all;
    for (const std::string verb : {"render", "bake", "view", "compare", "diff", "eval", "methods", "solve", "fit", "viewfactor", "merge", "info",
                                   "bench", "completion", "man"})
      all[verb] = names_in(run({verb, "--help-all"}).out, "-");
    const std::string help = run({"--help"}).out;
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) {  // no verb is missing above
      if (!line.starts_with("  ") || line[2] == '-' || line[2] == ' ') continue;
      EXPECT_TRUE(all.contains(line.substr(2, line.find(' ', 2) - 2))) << line;
    }
    return all;
  }

  // A shell's answer to a script, without its last line end.
  std::string bash(const std::string& script) {
    std::ofstream(folder / "script") << script;
    const std::string command = "bash " + (folder / "script").string() + " > " + (folder / "answer").string() + " 2>&1";
    const int status = std::system(command.c_str());
    std::string answer = contents(folder / "answer");
    if (!answer.empty()) answer.pop_back();
    return status == 0 ? answer : "failed: " + answer;
  }
};

// The part of a text from one mark to the next.
std::string part(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  return begin == std::string::npos ? std::string() : text.substr(begin, text.find(to, begin + from.size()) - begin);
}

bool holds_word(const std::string& text, const std::string& word) {
  const auto inner = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-'; };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if ((at == 0 || !inner(text[at - 1])) && (at + word.size() == text.size() || !inner(text[at + word.size()]))) return true;
  return false;
}

TEST_F(Completion, AndTheManualHaveEveryOptionOfEveryVerb) {
  const std::string bash = run({"completion", "bash"}).out, zsh = run({"completion", "zsh"}).out, fish = run({"completion", "fish"}).out;
  std::string man = std::regex_replace(run({"man"}).out, std::regex(R"(\\f[BIR])"), "");
  man.erase(std::remove(man.begin(), man.end(), '\\'), man.end());
  std::size_t count = 0;
  for (const auto& [verb, names] : options()) {
    const std::string in_bash = part(bash, "    " + verb + ") options=\"", "\""), in_zsh = part(zsh, "    " + verb + ")\n", ";;");
    const std::string in_man = part(man, ".SS " + verb + "\n", ".S");
    std::string in_fish;
    std::istringstream lines(fish);
    for (std::string line; std::getline(lines, line);)
      if (line.find("__fish_seen_subcommand_from " + verb + "'") != std::string::npos) in_fish += line.substr(0, line.find(" -d ")) + "\n";
    for (const std::string& name : names) {
      ++count;
      EXPECT_TRUE(holds_word(in_bash.substr(in_bash.find("options=")), name)) << verb << " " << name << " in bash";
      EXPECT_TRUE(holds_word(in_zsh, name)) << verb << " " << name << " in zsh";
      EXPECT_TRUE(holds_word(in_man, name)) << verb << " " << name << " in man";
      const std::string of_fish = name.starts_with("--") ? "-l " + name.substr(2) : "-s " + name.substr(1);
      EXPECT_NE(in_fish.find(" " + of_fish + (in_fish.find(" " + of_fish + "\n") != std::string::npos ? "\n" : " ")), std::string::npos)
          << verb << " " << name << " in fish";
    }
  }
  EXPECT_GT(count, 100u);
}

TEST_F(Completion, OfBashAnswers) {
  const std::string text = folder / "completion";
  std::ofstream(text) << run({"completion", "bash"}).out;
  EXPECT_EQ(bash("bash -n " + text), "");
  const auto answer = [&](const std::string& words, int at) {
    return bash("source " + text + "\nCOMP_WORDS=(" + words + ")\nCOMP_CWORD=" + std::to_string(at) +
                "\n_steradian\necho \"${COMPREPLY[*]}\"\n");
  };
  EXPECT_EQ(answer("steradian ren", 1), "render");
  EXPECT_EQ(answer("steradian render --qua", 2), "--quality");
  EXPECT_EQ(answer("steradian render x.glb --quality ''", 4), "draft normal high");
  EXPECT_EQ(answer("steradian render --quality = hi", 4), "high");
  EXPECT_EQ(answer("steradian render --quality =", 3), "draft normal high");
  EXPECT_EQ(answer("steradian render --method ltc-c", 3), "ltc-compact ltc-clipless");
  EXPECT_EQ(answer("steradian render sce", 2), "");        // readline completes names of files
  EXPECT_EQ(answer("steradian render --table x", 3), "");  // here too
  EXPECT_EQ(answer("steradian completion z", 2), "zsh");
  EXPECT_EQ(answer("steradian bench --filt", 2), "--filter");
}

// A reader that is not installed is not asked.
TEST_F(Completion, AndTheManualAreTakenByTheirReaders) {
  const auto taken = [&](const std::string& reader, const std::vector<std::string>& verb, const std::string& arguments) {
    const std::string text = folder / "text";
    std::ofstream(text) << run(verb).out;
    const std::string answer = bash("if command -v " + reader + " > /dev/null; then " + reader + " " + arguments + " " + text + "; fi\n");
    EXPECT_EQ(answer, "") << reader;
  };
  taken("zsh", {"completion", "zsh"}, "-n");
  taken("fish", {"completion", "fish"}, "--no-execute");
  taken("groff", {"man"}, "-man -ww -z -Tutf8");
}

}  // namespace
}  // namespace steradian::completion_program_test
