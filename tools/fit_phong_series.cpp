// Finds the coefficients of kernels/integral/moment_series.glsl: the cosine series of E(u), the factor between the Phong
// lobe's boundary integrand and the ellipsoid that matches its peak and its tail (docs/theory/moments.md).
//
//   fit_phong_series                 prints the two functions as they stand in the kernel file, and their errors
//   fit_phong_series --check FILE    exit 0 when FILE holds exactly these functions, 1 when it does not
//
// E depends on two numbers: kap2 = 1 - c^m in (0, 1) and g = 1/m in (0, 1/2]. At every node of a grid over both, its harmonics come from
// the trapezoidal rule, which is exact to rounding for a smooth periodic function. The amplitudes b_k of the few harmonics that stay come
// from least squares on the integral of E from the foot, which is what an edge needs. So b_0 partly compensates the dropped harmonics. Then
// each b_k / (1 - kap2) is fitted by a polynomial in kap2 and g. The weight of a node is about kap, the factor of E in the integral. It is
// larger for large exponents, which are rare in g. The powers in fit() gave the smallest errors on lights among a dozen tried.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Long = long double;

constexpr Long kPi = 3.14159265358979323846264338327950288L;
constexpr int kSamples = 256;  // over the quarter turn; E's harmonics fall below 1e-12 long before
constexpr int kPowersOfG = 3;

struct Node {
  Long kap2, g, s2, w2;
};

// The edge's s and w that belong to kap2 and g.
Node node_at(Long kap2, Long g) {
  const Long s2 = -std::expm1(2 * g * std::log1p(-kap2));
  return {kap2, g, s2, s2 / kap2};
}

// E = w^2 (1 - q) / Q with Q = s^2 cos^2 u + w^2 sin^2 u and q = (1 + Q / (c^2 cos^2 u))^(-m/2).
Long factor(const Node& p, Long u) {
  const Long cos2 = std::cos(u) * std::cos(u), sin2 = std::sin(u) * std::sin(u);
  const Long Q = p.s2 * cos2 + p.w2 * sin2;
  const Long ratio = Q / ((1 - p.s2) * cos2 + 1e-4000L);
  return p.w2 * -std::expm1(-std::log1p(ratio) / (2 * p.g)) / Q;
}

// E - 1 = b_0 + sum_k b_k cos 2ku.
std::vector<Long> harmonics(const Node& p, int highest) {
  static const std::vector<Long> cosine = [] {  // cosines of pi j / kSamples, over two turns
    std::vector<Long> table;
    for (int j = 0; j < 2 * kSamples; ++j) table.push_back(std::cos(kPi * j / kSamples));
    return table;
  }();
  std::vector<Long> b(static_cast<std::size_t>(highest) + 1, 0);
  for (int i = 0; i <= kSamples; ++i) {
    const Long u = kPi / 2 * i / kSamples;
    const Long weight = (i == 0 || i == kSamples ? 0.5L : 1.0L) / kSamples;
    const Long e = factor(p, u) - 1;
    for (int k = 0; k <= highest; ++k)
      b[static_cast<std::size_t>(k)] += (k == 0 ? 1 : 2) * weight * e * cosine[static_cast<std::size_t>(k * i % (2 * kSamples))];
  }
  return b;
}

std::vector<Node> grid() {
  std::vector<Node> nodes;
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 24; ++j) {
      const Long a = (i + 0.5L) / 64, b = (j + 0.5L) / 24;  // Chebyshev nodes of (0, 1) and of (0, 1/2)
      nodes.push_back(node_at((1 - std::cos(kPi * a)) / 2, (1 - std::cos(kPi * b)) / 4));
    }
  return nodes;
}

// Least squares by Householder reflections; rows are [a_1 ... a_n | y].
std::vector<Long> solve(std::vector<std::vector<Long>> rows) {
  const std::size_t n = rows[0].size() - 1, count = rows.size();
  for (std::size_t j = 0; j < n; ++j) {
    Long norm = 0;
    for (std::size_t i = j; i < count; ++i) norm += rows[i][j] * rows[i][j];
    const Long alpha = rows[j][j] > 0 ? -std::sqrt(norm) : std::sqrt(norm);
    std::vector<Long> v(count, 0);
    for (std::size_t i = j; i < count; ++i) v[i] = rows[i][j];
    v[j] -= alpha;
    Long vv = 0;
    for (std::size_t i = j; i < count; ++i) vv += v[i] * v[i];
    for (std::size_t k = j; k <= n; ++k) {
      Long dot = 0;
      for (std::size_t i = j; i < count; ++i) dot += v[i] * rows[i][k];
      for (std::size_t i = j; i < count; ++i) rows[i][k] -= 2 * dot / vv * v[i];
    }
  }
  std::vector<Long> x(n, 0);
  for (std::size_t j = n; j-- > 0;) {
    Long sum = rows[j][n];
    for (std::size_t k = j + 1; k < n; ++k) sum -= rows[j][k] * x[k];
    x[j] = sum / rows[j][j];
  }
  return x;
}

// The amplitudes b_0..b_highest that approximate the integral of E from the foot to u best, over all u.
std::vector<Long> amplitudes(const Node& p, int highest) {
  const std::vector<Long> all = harmonics(p, 40);
  std::vector<std::vector<Long>> rows;
  for (int i = 0; i < 128; ++i) {
    const Long u = kPi / 2 * (i + 0.5L) / 128;
    std::vector<Long> row = {u};
    Long integral = all[0] * u;
    for (std::size_t k = 1; k < all.size(); ++k) {
      const Long term = std::sin(2 * Long(k) * u) / (2 * Long(k));
      if (k <= static_cast<std::size_t>(highest)) row.push_back(term);
      integral += all[k] * term;
    }
    row.push_back(integral);
    rows.push_back(row);
  }
  return solve(rows);
}

struct Series {
  int highest, powers;               // harmonics 0..highest, powers of kap2 0..powers-1
  std::vector<std::vector<Long>> c;  // c[k][3 i + j], of kap2^i g^j
};

Series fit(int highest, int powers) {
  Series series{highest, powers, {}};
  const std::vector<Node> nodes = grid();
  std::vector<std::vector<Long>> b;
  for (const Node& p : nodes) b.push_back(amplitudes(p, highest));
  for (std::size_t k = 0; k <= static_cast<std::size_t>(highest); ++k) {
    std::vector<std::vector<Long>> rows;
    for (std::size_t r = 0; r < nodes.size(); ++r) {
      const Node& p = nodes[r];
      const Long weight = std::pow(p.kap2, 0.6L) * std::pow(1 - p.kap2, -0.1L) / (p.g + 0.1L);
      std::vector<Long> row;
      for (int i = 0; i < powers; ++i)
        for (int j = 0; j < kPowersOfG; ++j) row.push_back(weight * (1 - p.kap2) * std::pow(p.kap2, Long(i)) * std::pow(p.g, Long(j)));
      row.push_back(weight * b[r][k]);
      rows.push_back(row);
    }
    series.c.push_back(solve(rows));
    for (Long& c : series.c.back()) c = std::round(c * 100000) / 100000;
  }
  return series;
}

// Largest error of the integral from the foot to any u, relative to the full lobe's 2 pi.
Long worst_half_edge(const Series& series) {
  Long worst = 0;
  for (int a = 1; a < 60; ++a)
    for (int b = 0; b < 30; ++b) {
      const Node p = node_at(Long(a) / 60, 0.5L * (b + 0.1L) / 30 + 1e-5L);
      std::vector<Long> model;
      for (const auto& c : series.c) {
        Long sum = 0;
        for (int i = 0; i < series.powers; ++i)
          for (int j = 0; j < kPowersOfG; ++j)
            sum += c[static_cast<std::size_t>(3 * i + j)] * std::pow(p.kap2, Long(i)) * std::pow(p.g, Long(j));
        model.push_back((1 - p.kap2) * sum);
      }
      Long integral = 0;
      for (int i = 0; i < 128; ++i) {
        const Long u = kPi / 2 * (i + 0.5L) / 128;
        Long e = 1;
        for (std::size_t k = 0; k < model.size(); ++k) e += model[k] * std::cos(2 * Long(k) * u);
        integral += (factor(p, u) - e) * kPi / 2 / 128;
        worst = std::fmax(worst, std::sqrt(p.kap2) * std::fabs(integral) / (2 * kPi));
      }
    }
  return worst;
}

std::string number(Long x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5f", static_cast<double>(x));
  return text;
}

std::string in_g(const std::vector<Long>& c, int i) {
  const auto at = [&](int j) { return c[static_cast<std::size_t>(3 * i + j)]; };
  const auto term = [&](Long x) { return (x < 0 ? " - g * " : " + g * ") + number(std::fabs(x)); };
  return number(at(0)) + " + g * (" + number(at(1)) + term(at(2)) + ")";
}

// One function of the kernel file: the coefficients with the powers of g folded in.
std::string function(const char* name, const char* type, const Series& series) {
  std::ostringstream out;
  char error[64];
  std::snprintf(error, sizeof error, "%.1e", static_cast<double>(worst_half_edge(series)));
  out << "// Largest error " << error << " of the full lobe for a piece of an edge that begins at the foot.\n";
  out << type << " " << name << "(real n) {\n";
  out << "    real g = 1.0 / (n + 1.0);\n    " << type << " series;\n    series.m = n + 1.0;\n";
  for (int k = 0; k <= series.highest; ++k) {
    const auto& c = series.c[static_cast<std::size_t>(k)];
    if (series.powers == 4) {
      out << "    series.b" << k << " = vec4(\n";
      for (int i = 0; i < 4; ++i) out << "        " << in_g(c, i) << (i < 3 ? ",\n" : ");\n");
    } else {
      for (int half = 0; half < 2; ++half) {
        out << "    series." << (half ? "high" : "low") << k << " = vec3(\n";
        for (int i = 0; i < 3; ++i) out << "        " << in_g(c, 3 * half + i) << (i < 2 ? ",\n" : ");\n");
      }
    }
  }
  out << "    return series;\n}\n";
  return out.str();
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> functions = {
      function("moment_series_prepare", "MomentSeries", fit(3, 4)),
      function("moment_series_high_prepare", "MomentSeriesHigh", fit(5, 6)),
  };
  if (argc == 3 && std::strcmp(argv[1], "--check") == 0) {
    std::ifstream file(argv[2]);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    for (const std::string& f : functions)
      if (text.find(f) == std::string::npos) {
        std::fprintf(stderr, "%s does not hold:\n%s", argv[2], f.c_str());
        return 1;
      }
    std::printf("%s holds the %zu series found here\n", argv[2], functions.size());
    return 0;
  }
  for (const std::string& f : functions) std::printf("%s\n", f.c_str());
}
