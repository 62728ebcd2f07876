// Cases 5.6 to 5.14 of CIE 171:2006, by the factors and integrals of this program, against closed forms and quadrature.
#pragma once

#include <string>
#include <vector>

namespace steradian::cie171 {

struct Comparison {
  std::string number;    // of the case
  std::string geometry;  // of this row
  std::string way;       // of the library that answers
  double exact = 0;      // by another way, to rounding or 1e-12
  double ours = 0;
  double bound = 0;          // of the relative difference, derived
  std::string unit = {};     // empty: a factor
  bool is_estimate = false;  // the bound is the renderer's own estimate

  double difference() const;  // relative
};

std::vector<Comparison> compare_with_cie171();

// The page docs/measured/cie171.md.
std::string cie171_page(const std::vector<Comparison>& comparisons);

}  // namespace steradian::cie171
