#include "image/codecs.h"

#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <jerror.h>
#include <jpeglib.h>

namespace steradian::image {
namespace {

// A progressive picture may hold any number of scans. Each costs a pass over all coefficients although it takes two bytes of the file.
// Encoders write about ten.
constexpr int kMostScans = 100;
// Padding of rows and columns to whole blocks of 64 x 64 (the largest sampling), for a side of at most 65535.
constexpr std::size_t kRoundedUp = 2 * 64 * 65536;
constexpr std::size_t kWorkingBytes = 32 << 20;  // the codec's rows and tables

// State that libjpeg refers to. libjpeg's errors jump out of its calls, so nothing here may need a destructor.
struct JpegReader {
  jpeg_decompress_struct codec;
  jpeg_error_mgr errors;
  jpeg_progress_mgr progress;
  std::jmp_buf failed;
  char message[JMSG_LENGTH_MAX];
};

JpegReader& reader_of(j_common_ptr codec) { return *static_cast<JpegReader*>(codec->client_data); }

[[noreturn]] void fail(j_common_ptr codec) {
  JpegReader& reader = reader_of(codec);
  reader.errors.format_message(codec, reader.message);
  std::longjmp(reader.failed, 1);
}

// libjpeg conceals damage and warns. Only messages that leave the picture whole pass.
void judge_message(j_common_ptr codec, int level) {
  if (level >= 0) return;  // a trace
  const int code = codec->err->msg_code;
  if (code != JWRN_EXTRANEOUS_DATA && code != JWRN_ADOBE_XFORM && code != JWRN_JFIF_MAJOR) fail(codec);
}

void count_scans(j_common_ptr codec) {
  if (reinterpret_cast<j_decompress_ptr>(codec)->input_scan_number <= kMostScans) return;
  JpegReader& reader = reader_of(codec);
  std::snprintf(reader.message, sizeof reader.message, "it has more than %d scans", kMostScans);
  std::longjmp(reader.failed, 1);
}

// Reads the header's size; returns false, with a message, if the header is broken.
bool read_header(JpegReader& reader, std::span<const std::uint8_t> bytes) {
  reader.codec.err = jpeg_std_error(&reader.errors);
  reader.errors.error_exit = fail;
  reader.errors.emit_message = judge_message;
  reader.codec.client_data = &reader;
  if (setjmp(reader.failed)) return false;
  jpeg_create_decompress(&reader.codec);
  reader.progress.progress_monitor = count_scans;
  reader.codec.progress = &reader.progress;
  jpeg_mem_src(&reader.codec, bytes.data(), static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&reader.codec, TRUE);
  reader.codec.out_color_space = JCS_EXT_RGBA;
  return true;
}

// rgba has four bytes for each of the header's pixels.
bool read_pixels(JpegReader& reader, std::uint8_t* rgba, std::size_t memory) {
  if (setjmp(reader.failed)) return false;
  reader.codec.mem->max_memory_to_use = static_cast<long>(memory);
  jpeg_start_decompress(&reader.codec);
  while (reader.codec.output_scanline < reader.codec.output_height) {
    JSAMPROW row = rgba + std::size_t{4} * reader.codec.output_width * reader.codec.output_scanline;
    jpeg_read_scanlines(&reader.codec, &row, 1);
  }
  jpeg_finish_decompress(&reader.codec);
  return true;
}

// Owns the codec's memory. It is constructed before the first jump, so that a jump passes over no destructor.
struct OpenJpeg {
  JpegReader reader{};
  ~OpenJpeg() { jpeg_destroy_decompress(&reader.codec); }
};

}  // namespace

Image decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels, Budget& budget) {
  OpenJpeg open;
  const auto refuse = [&] { throw Error(place, std::string("cannot read the JPEG picture: ") + open.reader.message, "save it again"); };
  if (!read_header(open.reader, bytes)) refuse();
  jpeg_decompress_struct& codec = open.reader.codec;
  const std::size_t texels = checked_texels(codec.image_width, codec.image_height, place, max_texels);
  // A picture of several scans stores its coefficients, 16 bits each, until the last scan; blocks are padded to whole ones.
  const auto components = static_cast<std::size_t>(codec.num_components);
  const std::size_t coefficients = jpeg_has_multiple_scans(&codec) ? 2 * components * (texels + kRoundedUp) : 0;
  budget.take_memory(place, "the picture's texels", 4 * texels + coefficients);
  Image image;
  image.width = static_cast<int>(codec.image_width);
  image.height = static_cast<int>(codec.image_height);
  image.rgba.resize(4 * texels);
  if (!read_pixels(open.reader, image.rgba.data(), coefficients + kWorkingBytes)) refuse();
  budget.give_back_memory(coefficients);
  return image;
}

}  // namespace steradian::image
