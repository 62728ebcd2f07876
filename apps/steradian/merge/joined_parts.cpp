#include "merge/joined_parts.h"

#include <fmt/format.h>

#include <cstdio>
#include <set>

#include "image/codecs.h"
#include "steradian/error.h"

namespace steradian::app {
namespace {

constexpr const char* kPart = "steradian.part";

Part part_in(Picture& picture, const std::string& path, const std::string& kind) {
  const std::string hint = "merge the files of " + kind + " --part";
  const auto found = picture.metadata.find(kPart);
  if (found == picture.metadata.end()) throw Error(path, "is no part of a run of " + kind, hint);
  Part part;
  if (std::sscanf(found->second.c_str(), "%d/%d", &part.number, &part.count) != 2 || part.number < 1 || part.number > part.count)
    throw Error(path, "has a part that is not k/n", hint);
  picture.metadata.erase(found);
  return part;
}

// The first fact in which two parts differ.
std::string difference(const Picture& a, const Picture& b) {
  for (const auto& [key, value] : a.metadata) {
    const auto other = b.metadata.find(key);
    if (other == b.metadata.end() || other->second != value) return key.substr(key.find('.') + 1);
  }
  for (const auto& [key, value] : b.metadata)
    if (a.metadata.count(key) == 0) return key.substr(key.find('.') + 1);
  for (const auto& [name, layer] : a.layers)
    if (b.layers.count(name) == 0) return "layer " + name;
  return a.width != b.width || a.height != b.height || a.layers.size() != b.layers.size() ? "size" : "";
}

}  // namespace

Picture join_parts(const std::vector<std::string>& paths, const std::string& kind, const Limits& limits,
                   const std::function<void(Picture& all, const Picture& part, Part which)>& take) {
  Picture all;
  int count = 0;
  std::set<int> numbers;
  for (const std::string& path : paths) {
    Picture part = read_picture(path, limits);
    const Part which = part_in(part, path, kind);
    if (!numbers.insert(which.number).second) throw Error(path, fmt::format("is part {} once more", which.number), "name each part once");
    if (count == 0) {
      count = which.count;
      all = std::move(part);
      continue;
    }
    const std::string differs = which.count != count ? "number of parts" : difference(all, part);
    if (!differs.empty()) throw Error(path, "has other settings than " + paths[0] + " (" + differs + ")", "merge the parts of one run");
    take(all, part, which);
  }
  if (static_cast<int>(numbers.size()) != count) {
    int lacks = 1;
    while (numbers.count(lacks) != 0) ++lacks;
    throw Error(paths[0], fmt::format("is one of {} parts, and {} are here; part {} is missing", count, numbers.size(), lacks),
                "merge all parts");
  }
  return all;
}

}  // namespace steradian::app
