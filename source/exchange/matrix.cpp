#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "exchange/pairs/far_pairs.h"
#include "exchange/pairs/gauss_rules.h"
#include "exchange/obstacles/obstructed.h"
#include "exchange/obstacles/scene_elements.h"
#include "steradian/error.h"
#include "steradian/view_factors.h"

namespace steradian {
namespace {

using namespace exchange;

// Blocks of rows of equal numbers of pairs, the unit of threads and parts. Their number is fixed, so that no result depends on either.
constexpr std::size_t kBlocks = 256;

std::size_t first_row_of(std::size_t block, std::size_t rows) {
  // Row r has r pairs: the first r rows have about r^2 / 2.
  const double fraction = std::sqrt(static_cast<double>(block) / kBlocks);
  return std::min(rows, static_cast<std::size_t>(fraction * static_cast<double>(rows) + 0.5));
}

float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

// One row against all columns below it.
class RowOfPairs {
 public:
  RowOfPairs(const std::vector<PlaneElement>& elements, const ElementArrays& arrays, const Obstacles& obstacles, double eps)
      : elements_(elements), arrays_(arrays), obstacles_(obstacles), packs_(far_pairs_for(active_simd())), eps_(eps) {
    method_.resize(arrays.stride);
    value_.resize(arrays.stride);
    error_.resize(arrays.stride);
  }

  void add_to(ExchangeBlock& block, std::size_t row) {
    packs_.classify(arrays_.numbers.data(), arrays_.stride, row, row, eps_, method_.data(), error_.data());
    for (auto& of_kind : lists_)
      for (std::vector<std::uint32_t>& list : of_kind) list.clear();
    for (std::uint32_t j = 0; j < row; ++j) {
      const std::uint8_t m = method_[j];
      if (m == kNoExchange) {
        value_[j] = 0;
      } else if (m == kOneByOne) {
        const ExchangeArea h = exchange_area(elements_[row], elements_[j], eps_);
        value_[j] = h.value;
        error_[j] = h.error;
      } else {
        lists_[arrays_.kinds[j] == ElementKind::triangle][m].push_back(j);
      }
    }
    for (std::size_t triangles = 0; triangles < 2; ++triangles)
      for (std::size_t m = 1; m <= kLargestProduct; ++m) integrate(row, triangles == 1, m);
    for (std::uint32_t j = 0; j < row; ++j) {
      if (method_[j] == kNoExchange) continue;
      ExchangeArea h{std::clamp(value_[j], 0.0, std::min(elements_[row].area, elements_[j].area)), error_[j], 0};
      // The method was chosen by the middles; where it is not enough, the pair is done again.
      if (method_[j] != kOneByOne && !(h.error <= eps_ * h.value)) h = exchange_area(elements_[row], elements_[j], eps_);
      if (!obstacles_.is_empty()) h = visible_exchange(elements_[row], elements_[j], obstacles_, eps_, h).visible;
      if (!(h.value > 0) && !(h.error > 0)) continue;
      block.columns.push_back(j);
      block.values.push_back(h.value);
      block.errors.push_back(rounded_up(h.error));
    }
    block.row_start.push_back(block.columns.size());
  }

 private:
  void integrate(std::size_t row, bool triangles, std::size_t m) {
    const std::vector<std::uint32_t>& list = lists_[triangles][m];
    if (list.empty()) return;
    const GaussRule& rule = gauss_rule(static_cast<int>(m));
    listed_.resize(list.size());
    packs_.integrate(arrays_.numbers.data(), arrays_.stride, row, arrays_.kinds[row] == ElementKind::triangle, list.data(), list.size(),
                     triangles, m, rule.node.data(), rule.weight.data(), listed_.data());
    for (std::size_t i = 0; i < list.size(); ++i) value_[list[i]] = listed_[i];
  }

  const std::vector<PlaneElement>& elements_;
  const ElementArrays& arrays_;
  const Obstacles& obstacles_;
  const FarPairs& packs_;
  double eps_;
  std::vector<std::uint8_t> method_;
  std::vector<double> value_, error_, listed_;
  std::vector<std::uint32_t> lists_[2][kLargestProduct + 1];
};

void check_options(const ViewFactorOptions& options) {
  if (!(options.eps > 0 && options.eps < 1)) throw UsageError("eps", "must lie between 0 and 1");
  if (options.parts < 1 || options.part < 1 || options.part > options.parts)
    throw UsageError("part", "is " + std::to_string(options.part) + "/" + std::to_string(options.parts), "give k/n with k from 1 to n");
}

const ExchangeBlock* block_with(const std::vector<ExchangeBlock>& blocks, std::size_t row) {
  const auto after =
      std::upper_bound(blocks.begin(), blocks.end(), row, [](std::size_t r, const ExchangeBlock& b) { return r < b.first_row; });
  if (after == blocks.begin()) return nullptr;
  const ExchangeBlock& block = *(after - 1);
  return row < block.first_row + block.rows() ? &block : nullptr;
}

// The place of an entry in its block; none if nothing is exchanged.
struct EntryPlace {
  const ExchangeBlock* block = nullptr;
  std::size_t place = 0;
};
EntryPlace place_of(const std::vector<ExchangeBlock>& blocks, std::size_t i, std::size_t j) {
  if (i < j) std::swap(i, j);
  const ExchangeBlock* block = block_with(blocks, i);
  if (block == nullptr) return {};
  const auto begin = block->columns.begin() + static_cast<std::ptrdiff_t>(block->row_start[i - block->first_row]);
  const auto end = block->columns.begin() + static_cast<std::ptrdiff_t>(block->row_start[i - block->first_row + 1]);
  const auto at = std::lower_bound(begin, end, static_cast<std::uint32_t>(j));
  if (at == end || *at != j) return {};
  return {block, static_cast<std::size_t>(at - block->columns.begin())};
}

}  // namespace

std::uint64_t ViewFactors::entries() const {
  std::uint64_t sum = 0;
  for (const ExchangeBlock& b : blocks) sum += b.columns.size();
  return sum;
}

double ViewFactors::between(std::size_t i, std::size_t j) const {
  if (i == j) return own.empty() ? 0.0 : own[i];
  const EntryPlace entry = place_of(blocks, i, j);
  return entry.block == nullptr ? 0.0 : entry.block->values[entry.place];
}

double ViewFactors::error_between(std::size_t i, std::size_t j) const {
  if (i == j) return 0.0;
  const EntryPlace entry = place_of(blocks, i, j);
  return entry.block == nullptr ? 0.0 : static_cast<double>(entry.block->errors[entry.place]);
}

void ViewFactors::sum_rows() {
  row_sums.assign(size(), 0.0);
  row_errors.assign(size(), 0.0);
  for (const ExchangeBlock& b : blocks)
    for (std::size_t r = 0; r < b.rows(); ++r) {
      double sum = 0, error = 0;
      for (std::size_t k = b.row_start[r]; k < b.row_start[r + 1]; ++k) {
        const auto e = static_cast<double>(b.errors[k]);
        sum += b.values[k];
        error += e;
        row_sums[b.columns[k]] += b.values[k];
        row_errors[b.columns[k]] += e;
      }
      row_sums[b.first_row + r] += sum;
      row_errors[b.first_row + r] += error;
    }
  for (std::size_t i = 0; i < size(); ++i) {
    if (!own.empty()) row_sums[i] += own[i];
    row_sums[i] /= areas[i];
    row_errors[i] /= areas[i];
  }
}

std::vector<std::pair<std::size_t, std::size_t>> rows_of_part(std::size_t rows, int part, int parts) {
  // The blocks of a part are spread over the matrix: neighbours cost about the same.
  std::vector<std::pair<std::size_t, std::size_t>> result;
  std::size_t number = 0;
  for (std::size_t b = 0; b < kBlocks; ++b) {
    const std::size_t first = first_row_of(b, rows), end = first_row_of(b + 1, rows);
    if (first < end && number++ % static_cast<std::size_t>(parts) + 1 == static_cast<std::size_t>(part)) result.push_back({first, end});
  }
  return result;
}

ViewFactors view_factors(const std::vector<ViewFactorFace>& faces, const ViewFactorOptions& options) {
  check_options(options);
  const SceneElements scene = scene_elements(faces, options.obstacles, options.obstruction);
  const std::vector<PlaneElement>& elements = scene.elements;
  const Obstacles& obstacles = scene.obstacles;
  const ElementArrays arrays(elements);
  ViewFactors result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    result.names.push_back(faces[i].name);
    result.areas.push_back(elements[i].area);
  }
  const auto mine = rows_of_part(faces.size(), options.part, options.parts);
  result.blocks.resize(mine.size());
  tbb::parallel_for(std::size_t{0}, mine.size(), [&](std::size_t at) {
    // The last blocks have the longest rows; they come first.
    const std::size_t k = mine.size() - 1 - at;
    const auto [first, end] = mine[k];
    ExchangeBlock& block = result.blocks[k];
    block.first_row = first;
    if (options.known && options.known(block)) {
      if (options.advanced) options.advanced((end * (end - 1) - first * (first - std::min<std::size_t>(first, 1))) / 2);
      return;
    }
    block.row_start.push_back(0);
    RowOfPairs pairs(elements, arrays, obstacles, options.eps);
    for (std::size_t row = first; row < end; ++row) {
      pairs.add_to(block, row);
      if (options.advanced) options.advanced(row);
    }
    if (options.finished) options.finished(block);
  });
  result.sum_rows();
  return result;
}

ViewFactors merge_view_factors(std::vector<ViewFactors> parts) {
  if (parts.empty()) throw Error("", "there are no parts to merge");
  ViewFactors result;
  result.names = parts[0].names;
  result.areas = parts[0].areas;
  for (ViewFactors& part : parts) {
    if (part.areas != result.areas || part.names != result.names)
      throw Error("", "the parts are of different scenes", "merge the parts of one run");
    for (ExchangeBlock& b : part.blocks) result.blocks.push_back(std::move(b));
  }
  std::sort(result.blocks.begin(), result.blocks.end(),
            [](const ExchangeBlock& a, const ExchangeBlock& b) { return a.first_row < b.first_row; });
  std::size_t next = 0;
  for (const ExchangeBlock& b : result.blocks) {
    if (b.first_row != next)
      throw Error(
          "",
          b.first_row < next ? "row " + std::to_string(b.first_row) + " is in two parts" : "row " + std::to_string(next) + " is missing",
          "give every part of the run once");
    next += b.rows();
  }
  if (next != result.size()) throw Error("", "row " + std::to_string(next) + " is missing", "give every part of the run once");
  result.sum_rows();
  return result;
}

ViewFactors grouped_view_factors(const ViewFactors& factors, const std::vector<std::size_t>& groups,
                                 const std::vector<std::string>& names) {
  const std::size_t n = names.size();
  ViewFactors result;
  result.names = names;
  result.areas.assign(n, 0.0);
  result.own.assign(n, 0.0);
  for (std::size_t i = 0; i < factors.size(); ++i) result.areas[groups[i]] += factors.areas[i];
  std::vector<double> values(n * n, 0.0), errors(n * n, 0.0);
  for (const ExchangeBlock& b : factors.blocks)
    for (std::size_t r = 0; r < b.rows(); ++r)
      for (std::size_t k = b.row_start[r]; k < b.row_start[r + 1]; ++k) {
        const std::size_t i = groups[b.first_row + r], j = groups[b.columns[k]];
        const std::size_t place = std::max(i, j) * n + std::min(i, j);
        // Within a group, both directions count.
        values[place] += (i == j ? 2 : 1) * b.values[k];
        errors[place] += (i == j ? 2 : 1) * static_cast<double>(b.errors[k]);
      }
  ExchangeBlock block;
  block.row_start.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!(values[i * n + j] > 0)) continue;
      block.columns.push_back(static_cast<std::uint32_t>(j));
      block.values.push_back(values[i * n + j]);
      block.errors.push_back(rounded_up(errors[i * n + j]));
    }
    block.row_start.push_back(block.columns.size());
    result.own[i] = values[i * n + i];
  }
  result.blocks.push_back(std::move(block));
  result.sum_rows();
  for (std::size_t i = 0; i < n; ++i) result.row_errors[i] += errors[i * n + i] / result.areas[i];
  return result;
}

}  // namespace steradian
