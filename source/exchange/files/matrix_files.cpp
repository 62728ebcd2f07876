#include "exchange/files/matrix_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numeric>

#include "core/files.h"
#include "exchange/files/hdf5_file.h"
#include "exchange/files/npz.h"
#include "exchange/files/utf8.h"
#include "exchange/files/view3d_text.h"
#include "steradian/error.h"

namespace steradian::exchange {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string text_of(const RunFacts& run) {
  char text[256];
  std::snprintf(text, sizeof text,
                "{\"version\": \"%s\", \"eps\": %.17g, \"obstruction\": %s, \"part\": %d, \"parts\": %d, \"smallest\": %.17g}",
                run.version.c_str(), run.eps, run.obstruction ? "true" : "false", run.part, run.parts, run.smallest);
  return text;
}

// One value of the text above, which nothing else writes.
std::string value_in(const std::string& text, const std::string& key) {
  const std::size_t at = text.find("\"" + key + "\": ");
  if (at == std::string::npos) return {};
  const std::size_t from = at + key.size() + 4, to = text.find_first_of(",}", from);
  std::string value = text.substr(from, to - from);
  if (value.size() > 1 && value.front() == '"') value = value.substr(1, value.size() - 2);
  return value;
}

RunFacts run_of(const std::string& text, const std::string& path) {
  RunFacts run;
  run.version = value_in(text, "version");
  run.eps = std::atof(value_in(text, "eps").c_str());
  run.obstruction = value_in(text, "obstruction") == "true";
  run.part = std::atoi(value_in(text, "part").c_str());
  run.parts = std::atoi(value_in(text, "parts").c_str());
  run.smallest = std::atof(value_in(text, "smallest").c_str());
  if (!(run.eps > 0 && run.eps < 1) || !(run.smallest >= 0 && run.smallest < 1) || run.part < 1 || run.parts < run.part)
    throw Error(path, "its settings are damaged", "compute it again");
  return run;
}

}  // namespace

namespace {

// Texts as one of NumPy's arrays, all as long as the longest.
class TextArray {
 public:
  TextArray(const char* name, const std::vector<std::string>& texts) : name_(name), count_(texts.size()) {
    std::vector<std::vector<char32_t>> characters;
    for (const std::string& text : texts) {
      characters.push_back(characters_of(text));
      longest_ = std::max(longest_, characters.back().size());
    }
    all_.reserve(longest_ * count_);
    for (std::vector<char32_t>& text : characters) {
      text.resize(longest_);
      all_.insert(all_.end(), text.begin(), text.end());
    }
  }
  NpyArray array() const { return {name_, "<U" + std::to_string(longest_), {count_}, {bytes_of(all_)}}; }

 private:
  std::string name_;
  std::size_t count_, longest_ = 1;
  std::vector<char32_t> all_;
};

std::vector<std::string> texts_of(const ReadArray& array) {
  const std::size_t count = array.count(), longest = count == 0 ? 0 : array.bytes.size() / 4 / count;
  std::vector<std::string> texts(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < longest; ++k) {
      char32_t c = 0;
      std::memcpy(&c, array.bytes.data() + 4 * (i * longest + k), 4);
      if (c != 0) append_utf8(texts[i], c);
    }
  return texts;
}

// All arrays of a run, given to a writer of files.
void write_arrays(const std::string& path, const StoredRun& stored, void (*write)(const std::string&, const std::vector<NpyArray>&)) {
  const ViewFactors& f = stored.factors;
  const std::uint64_t entries = f.entries(), n = f.size(), own = f.own.empty() ? 0 : n;
  if (n > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max())) throw Error(path, "more faces than a 32-bit index holds");
  // SciPy wants both lists of indices in one type.
  const bool wide = entries + own > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
  std::vector<std::int64_t> starts(n + 1, 0);
  for (const ExchangeBlock& b : f.blocks)
    for (std::size_t r = 0; r < b.rows(); ++r) starts[b.first_row + r + 1] = static_cast<std::int64_t>(b.row_start[r + 1] - b.row_start[r]);
  for (std::size_t i = 0; i < own; ++i) ++starts[i + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::int32_t> narrow_starts;
  if (!wide) narrow_starts.assign(starts.begin(), starts.end());

  std::vector<std::vector<std::int64_t>> wide_columns;
  std::vector<std::vector<std::uint32_t>> columns_own;
  std::vector<std::vector<double>> values_own;
  std::vector<std::vector<float>> errors_own;
  NpyArray data{"data", "<f8", {entries + own}, {}}, errors{"errors", "<f4", {entries + own}, {}},
      indices{"indices", wide ? "<i8" : "<i4", {entries + own}, {}};
  for (const ExchangeBlock& b : f.blocks) {
    const std::vector<std::uint32_t>* columns = &b.columns;
    const std::vector<double>* values = &b.values;
    const std::vector<float>* their_errors = &b.errors;
    if (own > 0) {  // the diagonal of groups, behind each row
      auto& c = columns_own.emplace_back();
      auto& v = values_own.emplace_back();
      auto& e = errors_own.emplace_back();
      for (std::size_t r = 0; r < b.rows(); ++r) {
        for (std::size_t k = b.row_start[r]; k < b.row_start[r + 1]; ++k) {
          c.push_back(b.columns[k]);
          v.push_back(b.values[k]);
          e.push_back(b.errors[k]);
        }
        c.push_back(static_cast<std::uint32_t>(b.first_row + r));
        v.push_back(f.own[b.first_row + r]);
        e.push_back(0);
      }
      columns = &c;
      values = &v;
      their_errors = &e;
    }
    if (wide) {
      wide_columns.emplace_back(columns->begin(), columns->end());
      indices.pieces.push_back(bytes_of(wide_columns.back()));
    } else {
      indices.pieces.push_back(bytes_of(*columns));
    }
    data.pieces.push_back(bytes_of(*values));
    errors.pieces.push_back(bytes_of(*their_errors));
  }

  const std::vector<std::int64_t> shape = {static_cast<std::int64_t>(n), static_cast<std::int64_t>(n)};
  const TextArray names("names", f.names), grouped_names("grouping_names", stored.grouping.names);
  std::vector<double> corners;
  std::vector<std::int64_t> loops = {0}, face_loops = {0};
  std::vector<std::int64_t> groups(stored.run.groups.begin(), stored.run.groups.end());
  for (const ViewFactorFace& face : stored.faces) {
    const auto add = [&](const std::vector<Vec3d>& loop) {
      for (const Vec3d& v : loop) corners.insert(corners.end(), {v.x, v.y, v.z});
      loops.push_back(static_cast<std::int64_t>(corners.size() / 3));
    };
    add(face.outline);
    for (const auto& hole : face.holes) add(hole);
    face_loops.push_back(static_cast<std::int64_t>(loops.size() - 1));
  }
  const std::vector<std::int64_t> grouping(stored.grouping.groups.begin(), stored.grouping.groups.end());
  std::vector<double> masks;
  for (const FaceMask& m : stored.grouping.masks)
    masks.insert(masks.end(), {static_cast<double>(m.row), static_cast<double>(m.base), m.area});
  const std::string run = text_of(stored.run), format = "csr";
  const auto numbers = [](const char* name, const auto& values, const char* type) {
    return NpyArray{name, type, {values.size()}, {bytes_of(values)}};
  };
  std::vector<NpyArray> arrays = {indices,
                                  wide ? numbers("indptr", starts, "<i8") : numbers("indptr", narrow_starts, "<i4"),
                                  {"format", "|S3", {}, {format}},
                                  numbers("shape", shape, "<i8"),
                                  data,
                                  errors,
                                  numbers("areas", f.areas, "<f8"),
                                  numbers("row_sums", f.row_sums, "<f8"),
                                  numbers("row_errors", f.row_errors, "<f8"),
                                  names.array(),
                                  {"run", "|S" + std::to_string(run.size()), {}, {run}},
                                  {"corners", "<f8", {corners.size() / 3, 3}, {bytes_of(corners)}},
                                  numbers("loops", loops, "<i8"),
                                  numbers("face_loops", face_loops, "<i8"),
                                  {"obstacles", "<f8", {stored.obstacles.size(), 3, 3}, {bytes_of(stored.obstacles)}},
                                  numbers("groups", groups, "<i8")};
  if (!grouping.empty()) {
    arrays.push_back(numbers("grouping", grouping, "<i8"));
    arrays.push_back(grouped_names.array());
    arrays.push_back({"grouping_masks", "<f8", {masks.size() / 3, 3}, {bytes_of(masks)}});
  }
  write(path, arrays);
}

}  // namespace

void write_factors_npz(const std::string& path, const StoredRun& stored) { write_arrays(path, stored, write_npz); }

StoredRun read_factors_npz(const std::string& path, Budget& budget) {
  const NpzFile file(path, budget);
  const auto damaged = [&](const char* what) { throw Error(path, std::string("its ") + what + " are damaged", "compute the file again"); };
  StoredRun stored;
  stored.run = run_of(std::string(file.array("run", "|S").bytes), path);
  for (const std::int64_t g : file.values<std::int64_t>("groups", "<i8")) stored.run.groups.push_back(static_cast<std::size_t>(g));

  ViewFactors& f = stored.factors;
  f.areas = file.values<double>("areas", "<f8");
  const std::size_t n = f.areas.size();
  const ReadArray& names = file.array("names", "<U");
  if (names.count() != n) damaged("names");
  f.names = texts_of(names);
  const bool wide = file.array("indptr", "<i").type == "<i8";
  std::vector<std::int64_t> starts;
  std::vector<std::uint32_t> columns;
  budget.take_memory(path, "the entries", 2 * file.array("data", "<f8").bytes.size());
  if (wide) {
    starts = file.values<std::int64_t>("indptr", "<i8");
    for (const std::int64_t c : file.values<std::int64_t>("indices", "<i8")) columns.push_back(static_cast<std::uint32_t>(c));
  } else {
    for (const std::int32_t s : file.values<std::int32_t>("indptr", "<i4")) starts.push_back(s);
    columns = file.values<std::uint32_t>("indices", "<i4");
  }
  const std::vector<double> values = file.values<double>("data", "<f8");
  const std::vector<float> errors = file.values<float>("errors", "<f4");
  if (starts.size() != n + 1 || starts.front() != 0 || static_cast<std::uint64_t>(starts.back()) != values.size() ||
      columns.size() != values.size() || errors.size() != values.size() || !std::is_sorted(starts.begin(), starts.end()))
    damaged("entries");
  for (const auto& [first, end] : rows_of_part(n, stored.run.part, stored.run.parts)) {
    ExchangeBlock& b = f.blocks.emplace_back();
    b.first_row = first;
    b.row_start.push_back(0);
    for (std::size_t i = first; i < end; ++i) {
      for (auto k = static_cast<std::size_t>(starts[i]); k < static_cast<std::size_t>(starts[i + 1]); ++k) {
        if (columns[k] > i || !std::isfinite(values[k])) damaged("entries");
        if (columns[k] == i) {
          if (f.own.empty()) f.own.assign(n, 0.0);
          f.own[i] = values[k];
          continue;
        }
        b.columns.push_back(columns[k]);
        b.values.push_back(values[k]);
        b.errors.push_back(errors[k]);
      }
      b.row_start.push_back(b.columns.size());
    }
  }

  const std::vector<double> corners = file.values<double>("corners", "<f8");
  const std::vector<std::int64_t> loops = file.values<std::int64_t>("loops", "<i8"),
                                  face_loops = file.values<std::int64_t>("face_loops", "<i8");
  const auto is_list = [](const std::vector<std::int64_t>& list, std::size_t end) {
    return !list.empty() && list.front() == 0 && std::is_sorted(list.begin(), list.end()) && static_cast<std::size_t>(list.back()) == end;
  };
  if (loops.empty() || !is_list(loops, corners.size() / 3) || !is_list(face_loops, loops.size() - 1)) damaged("faces");
  for (std::size_t i = 0; i + 1 < face_loops.size(); ++i) {
    ViewFactorFace face;
    for (auto l = static_cast<std::size_t>(face_loops[i]); l < static_cast<std::size_t>(face_loops[i + 1]); ++l) {
      std::vector<Vec3d> loop;
      for (auto c = static_cast<std::size_t>(loops[l]); c < static_cast<std::size_t>(loops[l + 1]); ++c)
        loop.push_back({corners[3 * c], corners[3 * c + 1], corners[3 * c + 2]});
      (face.outline.empty() ? face.outline : face.holes.emplace_back()) = std::move(loop);
    }
    stored.faces.push_back(std::move(face));
  }
  const std::vector<double> obstacles = file.values<double>("obstacles", "<f8");
  if (obstacles.size() % 9 != 0) damaged("obstacles");
  for (std::size_t i = 0; i < obstacles.size(); i += 9) {
    std::array<Vec3d, 3>& t = stored.obstacles.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) t[c] = {obstacles[i + 3 * c], obstacles[i + 3 * c + 1], obstacles[i + 3 * c + 2]};
  }
  if (!stored.run.groups.empty() &&
      (stored.run.groups.size() != stored.faces.size() ||
       std::any_of(stored.run.groups.begin(), stored.run.groups.end(), [n](std::size_t g) { return g >= n; })))
    damaged("groups");
  if (stored.run.groups.empty() && stored.faces.size() != n) damaged("faces");
  if (stored.run.groups.empty())
    for (std::size_t i = 0; i < n; ++i) stored.faces[i].name = f.names[i];
  if (file.has("grouping")) {
    Grouping& g = stored.grouping;
    for (const std::int64_t group : file.values<std::int64_t>("grouping", "<i8")) g.groups.push_back(static_cast<std::size_t>(group));
    const ReadArray& group_names = file.array("grouping_names", "<U");
    if (group_names.count() > group_names.bytes.size() / 4) damaged("groups");  // texts without characters
    g.names = texts_of(group_names);
    const std::vector<double> masks = file.values<double>("grouping_masks", "<f8");
    const auto is_row = [&](double x) { return x >= 0 && x < static_cast<double>(g.names.size()); };
    if (masks.size() % 3 != 0 || g.groups.size() != n ||
        std::any_of(g.groups.begin(), g.groups.end(), [&](std::size_t group) { return group >= g.names.size(); }))
      damaged("groups");
    for (std::size_t i = 0; i < masks.size(); i += 3) {
      if (!is_row(masks[i]) || !is_row(masks[i + 1]) || !(masks[i + 2] > 0) || masks[i] == masks[i + 1]) damaged("masks");
      g.masks.push_back({static_cast<std::size_t>(masks[i]), static_cast<std::size_t>(masks[i + 1]), masks[i + 2]});
    }
  }
  f.row_sums = file.values<double>("row_sums", "<f8");
  f.row_errors = file.values<double>("row_errors", "<f8");
  if (f.row_sums.size() != n || f.row_errors.size() != n) damaged("rows");
  return stored;
}

void write_factors_mtx(const std::string& path, const ViewFactors& f) {
  AtomicFile file(path);
  std::uint64_t diagonal = 0;
  for (const double own : f.own) diagonal += own > 0;
  char line[96];
  const auto write = [&](int size) { file.write(std::string_view(line, static_cast<std::size_t>(size))); };
  file.write("%%MatrixMarket matrix coordinate real symmetric\n% exchange areas A_i F_ij [m2] by steradian viewfactor\n");
  write(std::snprintf(line, sizeof line, "%zu %zu %llu\n", f.size(), f.size(), static_cast<unsigned long long>(f.entries() + diagonal)));
  std::string text;
  const auto add = [&](std::size_t i, std::size_t j, double value) {
    text.append(line, static_cast<std::size_t>(std::snprintf(line, sizeof line, "%zu %zu %.17g\n", i + 1, j + 1, value)));
    if (text.size() > (1 << 20)) {
      file.write(text);
      text.clear();
    }
  };
  for (const ExchangeBlock& b : f.blocks)
    for (std::size_t r = 0; r < b.rows(); ++r) {
      const std::size_t i = b.first_row + r;
      for (std::size_t k = b.row_start[r]; k < b.row_start[r + 1]; ++k) add(i, b.columns[k], b.values[k]);
      if (!f.own.empty() && f.own[i] > 0) add(i, i, f.own[i]);
    }
  file.write(text);
  file.commit();
}

void check_factors_name(const std::string& path) {
  if (ends_with(path, ".h5")) return check_hdf5();
  if (!ends_with(path, ".npz") && !ends_with(path, ".mtx") && !ends_with(path, ".vf"))
    throw UsageError(path, "view factors are written as .npz, .h5, .mtx or .vf", "choose one of these endings");
}

void write_factors(const std::string& path, const StoredRun& stored) {
  check_factors_name(path);
  if (ends_with(path, ".npz")) return write_factors_npz(path, stored);
  if (ends_with(path, ".h5")) return write_arrays(path, stored, write_hdf5);
  if (ends_with(path, ".vf")) return write_view3d_text(path, stored.factors, stored.run.version);
  write_factors_mtx(path, stored.factors);
}

}  // namespace steradian::exchange
