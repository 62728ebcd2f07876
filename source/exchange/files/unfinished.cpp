#include "exchange/files/unfinished.h"

#include <cstring>
#include <string_view>

#include "exchange/files/npz.h"

namespace steradian::exchange {
namespace {

// Everything on which an entry depends.
Fingerprint fingerprint_of(const StoredRun& run) {
  std::string all = run.run.version + "|" + std::to_string(run.run.obstruction) + "|" + std::to_string(run.run.part) + "/" +
                    std::to_string(run.run.parts);
  all.append(reinterpret_cast<const char*>(&run.run.eps), sizeof run.run.eps);
  for (const ViewFactorFace& face : run.faces) {
    all += face.name + "|" + std::to_string(face.outline.size());
    all.append(bytes_of(face.outline));
    for (const auto& hole : face.holes) {
      all += std::to_string(hole.size());
      all.append(bytes_of(hole));
    }
  }
  all.append(bytes_of(run.obstacles));
  return fingerprint(all.data(), all.size());
}

struct BlockSizes {
  std::uint64_t rows, entries;
};

template <class T>
std::string_view take_list(std::string_view from, std::uint64_t count, std::vector<T>& to) {
  to.resize(count);
  std::memcpy(to.data(), from.data(), count * sizeof(T));
  return from.substr(count * sizeof(T));
}

}  // namespace

UnfinishedFactors::UnfinishedFactors(const std::string& path, const StoredRun& run) : run_(path, fingerprint_of(run)) {}

bool UnfinishedFactors::find(ExchangeBlock& block) const {
  const std::string* bytes = run_.find(block.first_row);
  BlockSizes sizes{};
  if (bytes == nullptr || bytes->size() < sizeof sizes) return false;
  std::memcpy(&sizes, bytes->data(), sizeof sizes);
  std::string_view rest = std::string_view(*bytes).substr(sizeof sizes);
  const std::uint64_t entry = sizeof block.columns[0] + sizeof block.values[0] + sizeof block.errors[0];
  const std::uint64_t row = sizeof block.row_start[0];
  if (sizes.rows >= rest.size() || sizes.entries >= rest.size() || rest.size() != (sizes.rows + 1) * row + sizes.entries * entry)
    return false;
  rest = take_list(rest, sizes.rows + 1, block.row_start);
  rest = take_list(rest, sizes.entries, block.columns);
  rest = take_list(rest, sizes.entries, block.values);
  take_list(rest, sizes.entries, block.errors);
  return true;
}

void UnfinishedFactors::add(const ExchangeBlock& block) {
  const BlockSizes sizes{block.rows(), block.columns.size()};
  std::string all(reinterpret_cast<const char*>(&sizes), sizeof sizes);
  all += bytes_of(block.row_start);
  all += bytes_of(block.columns);
  all += bytes_of(block.values);
  all += bytes_of(block.errors);
  run_.add(block.first_row, all);
}

}  // namespace steradian::exchange
