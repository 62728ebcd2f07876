// The file formats of pictures, as functions on a file's bytes: EXR, Radiance, JPEG and PNG, and the choice among them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "core/budget.h"
#include "steradian/limits.h"
#include "steradian/picture.h"
#include "steradian/texture.h"
#include "steradian/tone.h"

namespace steradian::image {

// EXR in memory: functions on the file's bytes, so that all disk access happens in one place.

std::string encode_exr(const Picture& picture);
// Number of threads that encode_exr takes from now on, in the whole process. The bytes are the same for any number.
void encode_exr_with(int threads);

// Throws Error(place, ...) for bytes that are not a whole picture. Memory is allocated after the header has been checked.
Picture decode_exr(std::span<const std::uint8_t> bytes, const std::string& place, Budget& budget);

// Radiance pictures (.hdr): RGBE, four bytes a pixel.

// Reads rows from the top and columns from the left, flat or in the run lengths of today's files. A file's EXPOSURE lines are divided out:
// the result is radiance. Throws Error(place, ...) for bytes that are not a whole picture. Memory is allocated after the header has been
// checked against the bytes that follow.
// Source: Ward, "Real pixels", Graphics Gems II, 1991; the Radiance file formats, "Picture file format".
Picture decode_hdr(std::span<const std::uint8_t> bytes, const std::string& place, Budget& budget);

// JPEG reader: libjpeg-turbo, restricted to the features of a picture.

// Throws Error(place, ...) for bytes that are not a whole picture, and for more than max_texels, before any memory is allocated.
Image decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels, Budget& budget);

// PNG reader and writer: libpng, restricted to what a picture needs.

// Encodes 8 bits a channel of tone_map(pixel); metadata becomes tEXt chunks.
std::string encode_png(const Picture& picture, float exposure_stops, ToneCurve curve = ToneCurve::neutral);

// Fills the bytes of row y, three a pixel. Must not throw.
using RowOfBytes = std::function<void(int y, std::uint8_t* row)>;
std::string encode_png_bytes(int width, int height, const RowOfBytes& fill);
std::string encode_png_rgba(int width, int height, const RowOfBytes& fill);   // four bytes a pixel
std::string encode_png_rgb16(int width, int height, const RowOfBytes& fill);  // six: each channel in 16 bits, the high byte first

// Reads every kind of PNG as RGBA, 8 bits a channel. The file's statements about colour spaces are ignored, as glTF asks. Throws
// Error(place, ...) for bytes that are not a whole picture, and for more than max_texels, before any memory is allocated.
Image decode_png(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels, Budget& budget);

}  // namespace steradian::image

// read_picture (steradian/picture.h) within limits that the caller sets.

namespace steradian {

// The bytes must be of the format that the name's ending says. Throws Error with the path for damaged files and for files that would exceed
// the limits.
Picture read_picture(const std::string& path, const Limits& limits);

}  // namespace steradian

// Detection of a picture's format by its first bytes, and the pixels of PNG and JPEG.

namespace steradian::image {

enum class ImageFormat { png, jpeg, known_but_not_read, unknown };
ImageFormat format_of(std::span<const std::uint8_t> bytes);

// Throws Error(place, ...) for bytes that are not a whole PNG or JPEG. Also throws for a picture of more than max_texels, before any memory
// is allocated for it.
Image decode_image(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels, Budget& budget);

// Returns width times height; throws Error for an empty picture and for one of more than max_texels.
std::size_t checked_texels(std::size_t width, std::size_t height, const std::string& place, std::size_t max_texels);

}  // namespace steradian::image
