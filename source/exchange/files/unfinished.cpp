#include "exchange/files/unfinished.h"

#include <cstring>
#include <string_view>

#include "exchange/files/npz.h"

namespace steradian::exchange {
namespace {

// Everything on which an entry depends.
std::string identity_of_factors(const StoredRun& run) {
  std::string all = "view factors " + run.run.version + "|" + std::to_string(run.run.obstruction) + "|" + std::to_string(run.run.part) +
                    "/" + std::to_string(run.run.parts);
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
  return all;
}

struct BlockSizes {
  std::uint64_t rows, entries;
};

template <class T>
void take_list(std::string_view& from, std::uint64_t count, std::vector<T>& to) {
  to.resize(count);
  if (count > 0) std::memcpy(to.data(), from.data(), count * sizeof(T));
  from.remove_prefix(count * sizeof(T));
}

}  // namespace

UnfinishedFactors::UnfinishedFactors(const std::string& path, const StoredRun& run) : file_(path, identity_of_factors(run)) {}

bool UnfinishedFactors::find(ExchangeBlock& block) const {
  const auto found = file_.find(block.first_row);
  BlockSizes sizes{};
  if (!found || found->size() < sizeof sizes) return false;
  std::string_view rest = *found;
  std::memcpy(&sizes, rest.data(), sizeof sizes);
  rest.remove_prefix(sizeof sizes);
  if (sizes.rows > rest.size() || sizes.entries > rest.size() || rest.size() != 8 * (sizes.rows + 1) + 16 * sizes.entries) return false;
  take_list(rest, sizes.rows + 1, block.row_start);
  take_list(rest, sizes.entries, block.columns);
  take_list(rest, sizes.entries, block.values);
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
  file_.add(block.first_row, all);
}

}  // namespace steradian::exchange
