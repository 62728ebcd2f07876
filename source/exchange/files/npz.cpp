#include "exchange/files/npz.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

#include "core/files.h"
#include "steradian/error.h"

namespace steradian::exchange {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

// Signatures of the ZIP format (PKWARE's APPNOTE.TXT, 4.3).
constexpr std::uint32_t kLocalHeader = 0x04034b50, kCentralHeader = 0x02014b50, kEndRecord = 0x06054b50, kEndRecord64 = 0x06064b50,
                        kEndLocator64 = 0x07064b50;
constexpr std::uint16_t kVersion64 = 45, kExtra64 = 1, kDate1980 = 0x21;
constexpr std::uint32_t kIn64 = 0xffffffffu;  // the number stands in the extra field
constexpr std::size_t kLocalSize = 30, kCentralSize = 46, kEndSize = 22, kLocatorSize = 20, kEnd64Size = 56;

template <class T>
void append(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class T>
T number_at(std::string_view bytes, std::size_t place) {
  T value{};
  if (place <= bytes.size() && sizeof value <= bytes.size() - place) std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

std::string npy_header(const NpyArray& a) {
  std::string shape = "(";
  for (const std::uint64_t n : a.shape) shape += std::to_string(n) + ",";
  std::string text = "{'descr': '" + a.type + "', 'fortran_order': False, 'shape': " + shape + "), }";
  // The data begin at a multiple of 64 bytes.
  text.append((64 - (10 + text.size() + 1) % 64) % 64, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  append(header, static_cast<std::uint16_t>(text.size()));
  return header + text;
}

std::uint32_t checksum(std::uint32_t crc, std::string_view bytes) {
  if (bytes.empty()) return crc;  // zlib takes no address for a start
  return static_cast<std::uint32_t>(crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

struct ZipEntry {
  std::string name;
  std::uint32_t crc = 0;
  std::uint64_t size = 0, offset = 0;
};

// The fields that the local and the central header share.
void append_common(std::string& to, const ZipEntry& e, std::uint16_t extra_size) {
  append(to, kVersion64);
  append(to, std::uint16_t{0x0800});  // the name is UTF-8
  append(to, std::uint16_t{0});       // stored
  append(to, std::uint16_t{0});       // one time for all, so that the same arrays give the same bytes
  append(to, kDate1980);
  append(to, e.crc);
  append(to, kIn64);
  append(to, kIn64);
  append(to, static_cast<std::uint16_t>(e.name.size()));
  append(to, extra_size);
}

}  // namespace

void write_npz(const std::string& path, const std::vector<NpyArray>& arrays) {
  AtomicFile file(path);
  std::vector<ZipEntry> entries;
  std::uint64_t offset = 0;
  const auto write = [&](std::string_view bytes) {
    file.write(bytes);
    offset += bytes.size();
  };
  for (const NpyArray& a : arrays) {
    const std::string head = npy_header(a);
    ZipEntry e{a.name + ".npy", checksum(0, head), head.size(), offset};
    for (const std::string_view piece : a.pieces) {
      e.crc = checksum(e.crc, piece);
      e.size += piece.size();
    }
    std::string local;
    append(local, kLocalHeader);
    append_common(local, e, 20);
    local += e.name;
    append(local, kExtra64);
    append(local, std::uint16_t{16});
    append(local, e.size);
    append(local, e.size);
    write(local);
    write(head);
    for (const std::string_view piece : a.pieces) write(piece);
    entries.push_back(std::move(e));
  }
  const std::uint64_t start = offset;
  for (const ZipEntry& e : entries) {
    std::string central;
    append(central, kCentralHeader);
    append(central, kVersion64);
    append_common(central, e, 28);
    append(central, std::uint16_t{0});  // no comment
    append(central, std::uint16_t{0});  // disk
    append(central, std::uint16_t{0});
    append(central, std::uint32_t{0});
    append(central, kIn64);
    central += e.name;
    append(central, kExtra64);
    append(central, std::uint16_t{24});
    append(central, e.size);
    append(central, e.size);
    append(central, e.offset);
    write(central);
  }
  const std::uint64_t size = offset - start, end64 = offset, count = entries.size();
  std::string end;
  append(end, kEndRecord64);
  append(end, std::uint64_t{kEnd64Size - 12});
  append(end, kVersion64);
  append(end, kVersion64);
  append(end, std::uint32_t{0});
  append(end, std::uint32_t{0});
  append(end, count);
  append(end, count);
  append(end, size);
  append(end, start);
  append(end, kEndLocator64);
  append(end, std::uint32_t{0});
  append(end, end64);
  append(end, std::uint32_t{1});
  append(end, kEndRecord);
  append(end, std::uint16_t{0});
  append(end, std::uint16_t{0});
  append(end, static_cast<std::uint16_t>(count));
  append(end, static_cast<std::uint16_t>(count));
  append(end, kIn64);
  append(end, kIn64);
  append(end, std::uint16_t{0});
  write(end);
  file.commit();
}

std::uint64_t ReadArray::count() const {
  std::uint64_t n = 1;
  for (const std::uint64_t s : shape) n *= s;
  return n;
}

void NpzFile::copy_bytes(std::string_view bytes, void* to) {
  if (!bytes.empty()) std::memcpy(to, bytes.data(), bytes.size());
}

void NpzFile::fail(const std::string& problem) const { throw Error(path_, problem, "give a file that steradian viewfactor wrote"); }

const ReadArray& NpzFile::array(const std::string& name, const std::string& type) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end()) fail("it has no array " + name);
  // A type that ends in a letter stands for all lengths of it.
  const bool fits = found->second.type == type || (!type.empty() && std::isalpha(static_cast<unsigned char>(type.back())) &&
                                                   found->second.type.compare(0, type.size(), type) == 0);
  if (!fits) fail("the array " + name + " has the type " + found->second.type + " instead of " + type);
  return found->second;
}

NpzFile::NpzFile(const std::string& path, Budget& budget) : path_(path), file_(read_file(path, path, budget)) {
  const std::string_view all(reinterpret_cast<const char*>(file_.data()), file_.size());
  if (all.size() < kEndSize) fail("it is no ZIP file");
  std::size_t end = all.size() - kEndSize;
  while (end > 0 && number_at<std::uint32_t>(all, end) != kEndRecord && all.size() - end < 66000) --end;
  if (number_at<std::uint32_t>(all, end) != kEndRecord) fail("it is no ZIP file");
  std::uint64_t count = number_at<std::uint16_t>(all, end + 10), at = number_at<std::uint32_t>(all, end + 16);
  if (end >= kLocatorSize && number_at<std::uint32_t>(all, end - kLocatorSize) == kEndLocator64) {
    const auto end64 = number_at<std::uint64_t>(all, end - kLocatorSize + 8);
    if (end64 > all.size() || number_at<std::uint32_t>(all, end64) != kEndRecord64) fail("its end is damaged");
    count = number_at<std::uint64_t>(all, end64 + 32);
    at = number_at<std::uint64_t>(all, end64 + 48);
  }
  if (count > all.size() / kCentralSize) fail("its end is damaged");
  for (std::uint64_t i = 0; i < count; ++i) {
    if (at > all.size() || number_at<std::uint32_t>(all, at) != kCentralHeader) fail("its list of arrays is damaged");
    const auto method = number_at<std::uint16_t>(all, at + 10);
    const auto crc = number_at<std::uint32_t>(all, at + 16);
    std::uint64_t packed = number_at<std::uint32_t>(all, at + 20), size = number_at<std::uint32_t>(all, at + 24),
                  local = number_at<std::uint32_t>(all, at + 42);
    const std::size_t name_size = number_at<std::uint16_t>(all, at + 28), extra_size = number_at<std::uint16_t>(all, at + 30),
                      comment = number_at<std::uint16_t>(all, at + 32);
    if (name_size + extra_size + comment + kCentralSize > all.size() - at) fail("its list of arrays is damaged");
    std::string name(all.substr(at + kCentralSize, name_size));
    const std::string_view extra = all.substr(at + kCentralSize + name_size, extra_size);
    if (number_at<std::uint16_t>(extra, 0) == kExtra64) {
      std::size_t place = 4;
      for (std::uint64_t* field : {&size, &packed, &local})
        if (*field == kIn64) {
          *field = number_at<std::uint64_t>(extra, place);
          place += 8;
        }
    }
    if (method != 0 || packed != size) fail("the array " + name + " is compressed");
    if (local > all.size() || number_at<std::uint32_t>(all, local) != kLocalHeader) fail("the array " + name + " is damaged");
    const std::uint64_t data = local + kLocalSize + number_at<std::uint16_t>(all, local + 26) + number_at<std::uint16_t>(all, local + 28);
    if (data > all.size() || size > all.size() - data) fail("the array " + name + " is cut off");
    const std::string_view bytes = all.substr(data, size);
    if (checksum(0, bytes) != crc) fail("the array " + name + " is damaged: its checksum differs");
    if (name.size() > 4 && name.compare(name.size() - 4, 4, ".npy") == 0) read_array(name.substr(0, name.size() - 4), bytes);
    at += kCentralSize + name_size + extra_size + comment;
  }
}

void NpzFile::read_array(const std::string& name, std::string_view npy) {
  const auto damaged = [&] { fail("the array " + name + " has no header that is known"); };
  if (npy.size() < 10 || npy.substr(0, 7) != std::string_view("\x93NUMPY\x01", 7)) damaged();
  const std::size_t size = number_at<std::uint16_t>(npy, 8);
  if (size > npy.size() - 10) damaged();
  const std::string_view head = npy.substr(10, size);
  const auto after = [&](std::string_view key, char open, char close) {
    const std::size_t k = head.find(key), from = k == std::string_view::npos ? k : head.find(open, k + key.size());
    const std::size_t to = from == std::string_view::npos ? from : head.find(close, from + 1);
    if (to == std::string_view::npos) damaged();
    return head.substr(from + 1, to - from - 1);
  };
  ReadArray a;
  a.type = std::string(after("'descr':", '\'', '\''));
  if (head.find("'fortran_order': False") == std::string_view::npos) damaged();
  const std::string_view shape = after("'shape':", '(', ')');
  std::uint64_t total = 1;
  for (std::size_t i = 0; i < shape.size();) {
    if (shape[i] < '0' || shape[i] > '9') {
      ++i;
      continue;
    }
    std::uint64_t n = 0;
    const auto [end, error] = std::from_chars(shape.data() + i, shape.data() + shape.size(), n);
    if (error != std::errc() || (n != 0 && total > (std::uint64_t{1} << 48) / n)) damaged();
    total *= n;
    a.shape.push_back(n);
    i = static_cast<std::size_t>(end - shape.data());
  }
  std::uint64_t item = 0;
  if (a.type.size() < 3 || std::from_chars(a.type.data() + 2, a.type.data() + a.type.size(), item).ec != std::errc()) damaged();
  if (a.type[1] == 'U') item *= 4;
  a.bytes = npy.substr(10 + size);
  if (item == 0 || item > (1u << 20) || a.bytes.size() != total * item) damaged();
  arrays_[name] = std::move(a);
}

}  // namespace steradian::exchange
