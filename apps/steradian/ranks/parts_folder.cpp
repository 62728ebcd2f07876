#include "ranks/parts_folder.h"

#include <filesystem>

#include "core/files.h"
#include "core/fingerprint.h"
#include "core/simd.h"
#include "steradian/error.h"
#include "steradian/version.h"

namespace steradian::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFacts = "/run";  // the file that tells the command

std::string text_in(const std::string& path) {
  Budget budget;
  const Bytes bytes = read_file(path, path, budget);
  return {bytes.begin(), bytes.end()};
}

// The command, and the contents of all files that it names.
std::string identity_of(const SharedRun& run) {
  std::string text = std::string("steradian ") + version() + " " + name_of(active_simd()) + "\n" + run.verb + "\n";
  for (const std::string& argument : run.arguments) {
    text += argument + "\n";
    std::error_code unknown;
    if (!fs::is_regular_file(argument, unknown)) continue;
    const std::string contents = text_in(argument);
    text += std::to_string(fingerprint(contents.data(), contents.size())) + "\n";
  }
  return text;
}

}  // namespace

PartsFolder::PartsFolder(const SharedRun& run, int parts) : run_(run), path_(run.output + ".parts"), parts_(parts) {
  const std::string facts = path_ + kFacts, identity = identity_of(run);
  if (fs::exists(path_) && !fs::exists(facts))
    throw Error(path_, "is there, and is no folder of parts", "remove it, or choose another output");
  if (run.resume && fs::exists(facts)) {
    const std::string found = text_in(facts);
    const std::size_t end = found.find('\n');
    const int count = std::atoi(found.c_str());
    if (end == std::string::npos || found.substr(end + 1) != identity || count < 1 || count > run.most_parts)
      throw Error(path_, "was begun with another scene, other options or another program",
                  "give the same ones, or leave out --resume to begin anew");
    parts_ = count;
    return;
  }
  std::error_code failed;
  fs::remove_all(path_, failed);
  if (!failed) fs::create_directory(path_, failed);
  if (failed) throw Error(path_, "cannot make this folder: " + failed.message(), "choose another output");
  write_file(facts, std::to_string(parts_) + "\n" + identity);
}

std::vector<int> PartsFolder::missing() const {
  std::vector<int> numbers;
  for (int k = 1; k <= parts_; ++k)
    if (!fs::exists(run_.part_file(k, path_))) numbers.push_back(k);
  return numbers;
}

void PartsFolder::remove() const { fs::remove_all(path_); }

}  // namespace steradian::app
