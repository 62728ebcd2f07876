// Files in the user's cache folder that a program may lose at any time: what is in them makes the next start faster.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace steradian {

// The path of a cache file; empty: there is none. The environment variable names the folder; if it is empty, nothing is stored. Without the
// variable the folder is steradian in $XDG_CACHE_HOME, or in ~/.cache.
std::string cache_file(const char* variable, const std::string& name);

// The bytes that write_cache_file stored with this key. Empty if the file is absent, damaged, or of something else.
std::vector<char> read_cache_file(const std::string& path, const std::string& key);

// Makes the folder, too. A cache that cannot be written costs time in the next run, and nothing else.
void write_cache_file(const std::string& path, const std::string& key, std::span<const char> bytes) noexcept;

}  // namespace steradian
