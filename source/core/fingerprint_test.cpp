#include "core/fingerprint.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace steradian::fingerprint_test {
namespace {

TEST(Fingerprint, TellsEveryBitAndEveryLength) {
  for (const std::size_t length : {1, 7, 8, 31, 32, 33, 100}) {
    std::vector<unsigned char> bytes(length);
    std::set<Fingerprint> seen = {fingerprint(bytes.data(), length)};
    for (std::size_t bit = 0; bit < 8 * length; ++bit) {
      bytes[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
      EXPECT_TRUE(seen.insert(fingerprint(bytes.data(), length)).second) << length << " bytes, bit " << bit;
      bytes[bit / 8] = 0;
    }
    EXPECT_EQ(fingerprint(bytes.data(), length), fingerprint(std::vector<unsigned char>(length).data(), length));
  }
  std::set<Fingerprint> lengths;
  const std::vector<unsigned char> zeros(200);
  for (std::size_t length = 0; length <= zeros.size(); ++length) EXPECT_TRUE(lengths.insert(fingerprint(zeros.data(), length)).second);
}

// Swapped numbers, and pairs of changed bits at all positions.
TEST(Fingerprint, TellsTwoChangesThatMightCancel) {
  constexpr std::size_t kWords = 16;
  std::vector<std::uint64_t> words(kWords);
  std::set<Fingerprint> seen;
  for (std::size_t a = 0; a < 64 * kWords; a += 3)
    for (std::size_t b = a + 1; b < 64 * kWords; b += 5) {
      words[a / 64] ^= std::uint64_t{1} << a % 64;
      words[b / 64] ^= std::uint64_t{1} << b % 64;
      EXPECT_TRUE(seen.insert(fingerprint(std::span<const std::uint64_t>(words))).second) << "bits " << a << ", " << b;
      words[a / 64] = words[b / 64] = 0;
    }
  for (std::size_t i = 0; i < kWords; ++i) words[i] = i;
  seen = {fingerprint(std::span<const std::uint64_t>(words))};
  for (std::size_t a = 0; a < kWords; ++a)
    for (std::size_t b = a + 1; b < kWords; ++b) {
      std::swap(words[a], words[b]);
      EXPECT_TRUE(seen.insert(fingerprint(std::span<const std::uint64_t>(words))).second) << "words " << a << ", " << b;
      std::swap(words[a], words[b]);
    }
}

}  // namespace
}  // namespace steradian::fingerprint_test
