#include "exchange/files/hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <cstring>

#include "core/files.h"
#include "exchange/files/utf8.h"
#include "steradian/error.h"

namespace steradian::exchange {
namespace {

// A handle of HDF5 and the function that closes it. A negative handle is an error.
class H5Handle {
 public:
  H5Handle(hid_t id, herr_t (*close)(hid_t), const std::string& path) : id_(id), close_(close) {
    if (id < 0) throw Error(path, "HDF5 cannot compose the file", "free some memory, or write .npz");
  }
  ~H5Handle() { close_(id_); }
  H5Handle(const H5Handle&) = delete;
  H5Handle& operator=(const H5Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check_call(herr_t status, const std::string& path) {
  H5Handle(
      status < 0 ? -1 : 0, [](hid_t) -> herr_t { return 0; }, path);
}

// NumPy's type in HDF5's words; the size of a text is its own.
hid_t hdf5_type(const std::string& numpy) {
  if (numpy == "<f8") return H5Tcopy(H5T_IEEE_F64LE);
  if (numpy == "<f4") return H5Tcopy(H5T_IEEE_F32LE);
  if (numpy == "<i4") return H5Tcopy(H5T_STD_I32LE);
  if (numpy == "<i8") return H5Tcopy(H5T_STD_I64LE);
  if (!numpy.starts_with("|S")) return -1;
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, std::max<std::size_t>(1, std::stoul(numpy.substr(2))));
  H5Tset_strpad(text, H5T_STR_NULLPAD);
  H5Tset_cset(text, H5T_CSET_UTF8);
  return text;
}

void write_array(hid_t file, const NpyArray& array, const std::string& path) {
  std::vector<hsize_t> sizes(array.shape.begin(), array.shape.end());
  const H5Handle type(hdf5_type(array.type), H5Tclose, path);
  const H5Handle space(sizes.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr),
                       H5Sclose, path);
  const H5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path);
  check_call(H5Pset_obj_track_times(properties, 0), path);  // no time in the bytes
  const H5Handle dataset(H5Dcreate2(file, array.name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, path);
  if (array.pieces.size() == 1) {
    if (!array.pieces[0].empty()) check_call(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.pieces[0].data()), path);
    return;
  }
  // Pieces are lists of one dimension, one behind the other.
  hsize_t at = 0;
  for (const std::string_view piece : array.pieces) {
    const hsize_t count = piece.size() / H5Tget_size(type);
    if (count == 0) continue;
    check_call(H5Sselect_hyperslab(space, H5S_SELECT_SET, &at, nullptr, &count, nullptr), path);
    const H5Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose, path);
    check_call(H5Dwrite(dataset, type, memory, space, H5P_DEFAULT, piece.data()), path);
    at += count;
  }
}

// NumPy's text of 4 bytes a character as UTF-8 of one size.
NpyArray as_utf8(const NpyArray& array, std::string& bytes) {
  const std::size_t longest = std::stoul(array.type.substr(2));
  std::vector<std::string> texts;
  std::size_t size = 1;
  for (const std::string_view piece : array.pieces)
    for (std::size_t at = 0; longest > 0 && at < piece.size(); at += 4 * longest) {
      std::string& text = texts.emplace_back();
      for (std::size_t k = 0; k < longest; ++k) {
        char32_t c = 0;
        std::memcpy(&c, piece.data() + at + 4 * k, 4);
        if (c != 0) append_utf8(text, c);
      }
      size = std::max(size, text.size());
    }
  for (std::string& text : texts) {
    text.resize(size);
    bytes += text;
  }
  return {array.name, "|S" + std::to_string(size), array.shape, {bytes}};
}

}  // namespace

void check_hdf5() {}

void write_hdf5(const std::string& path, const std::vector<NpyArray>& arrays) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are ours to tell
  std::vector<char> image;
  {
    const H5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path);
    check_call(H5Pset_fapl_core(access, std::size_t{1} << 24, 0), path);
    const H5Handle file(H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, path);
    for (const NpyArray& array : arrays) {
      std::string bytes;
      write_array(file, array.type.starts_with("<U") ? as_utf8(array, bytes) : array, path);
    }
    check_call(H5Fflush(file, H5F_SCOPE_GLOBAL), path);
    const ssize_t size = H5Fget_file_image(file, nullptr, 0);
    check_call(size < 0 ? -1 : 0, path);
    image.resize(static_cast<std::size_t>(size));
    check_call(H5Fget_file_image(file, image.data(), image.size()) < 0 ? -1 : 0, path);
  }
  write_file(path, {image.data(), image.size()});
}

}  // namespace steradian::exchange
