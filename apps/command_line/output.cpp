#include "output.h"

#include <filesystem>

#include "core/files.h"
#include "image/picture_name.h"
#include "steradian/error.h"

namespace steradian::app {
namespace {

namespace fs = std::filesystem;

// The folder itself, or the nearest one above it that is there.
fs::path nearest_there(const fs::path& folder) {
  std::error_code unknown;
  fs::path at = fs::absolute(folder);
  while (!fs::exists(at, unknown) && at.has_relative_path()) at = at.parent_path();
  return at;
}

// A missing folder is made at the end, in the nearest one that is there.
void check_folder(const std::string& path) {
  const fs::path there = nearest_there(path);
  const std::string hint = "choose another folder";
  if (!fs::is_directory(there)) throw Error(path, "cannot make this folder: " + there.string() + " is a file", hint);
  try {
    check_writable((there / "steradian").string());
  } catch (const Error& e) {
    throw Error(path, "cannot write in the folder " + there.string() + ": " + e.problem(), hint);
  }
}

}  // namespace

void check_output(const std::string& path, Writes kind) {
  if (path.empty() || path == "-") return;
  if (kind == Writes::folder) return check_folder(path);
  if (kind == Writes::picture) image::check_picture_name(path);
  if (fs::path(path).parent_path().string().find('#') == std::string::npos) check_writable(path);
}

}  // namespace steradian::app
