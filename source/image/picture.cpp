// Which file format, by the name's ending.
#include "steradian/picture.h"

#include <algorithm>
#include <cctype>

#include "core/atomic_file.h"
#include "image/exr.h"
#include "image/png.h"
#include "steradian/error.h"

namespace steradian {
namespace {

std::string ending(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  std::string e = dot == std::string::npos ? "" : path.substr(dot);
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

void write(const std::string& path, const std::string& bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace

void write_picture(const Picture& picture, const std::string& path, float exposure_stops) {
  const std::string e = ending(path);
  if (e == ".exr")
    write(path, encode_exr(picture));
  else if (e == ".png")
    write(path, encode_png(picture, exposure_stops));
  else
    throw Error(path, "unknown picture format '" + e + "'", "use .exr (linear) or .png (tone mapped)");
}

Picture read_picture(const std::string& path) {
  const std::string e = ending(path);
  if (e == ".exr") return decode_exr(path);
  if (e == ".png" || e == ".jpg" || e == ".jpeg") return decode_ldr(path);
  throw Error(path, "unknown picture format '" + e + "'", "use .exr, .png or .jpg");
}

}  // namespace steradian
