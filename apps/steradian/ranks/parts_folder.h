// PartsFolder: the folder OUTPUT.parts, in which the ranks of a run write its parts, and from which --resume takes finished parts up.
#pragma once

#include <string>
#include <vector>

#include "ranks/shared_run.h"

namespace steradian::app {

class PartsFolder {
 public:
  // Makes the folder for a run in `parts` parts. With run.resume it takes up a folder that is there, with its number of parts. Throws Error
  // if that folder is of another command, of other files or of another version.
  PartsFolder(const SharedRun& run, int parts);

  const std::string& path() const { return path_; }
  int parts() const { return parts_; }
  // Numbers of the parts that have no file yet.
  std::vector<int> missing() const;
  // The run is done: removes the folder.
  void remove() const;

 private:
  const SharedRun& run_;
  std::string path_;
  int parts_;
};

}  // namespace steradian::app
