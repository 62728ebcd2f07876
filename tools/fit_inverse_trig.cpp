// Finds the polynomials of kernels/math/inverse_trig.glsl: Chebyshev interpolation in 113-bit arithmetic, turned into
// monomials and rounded to 17 digits.
//
//   fit_inverse_trig                 prints the four functions as they stand in the kernel file
//   fit_inverse_trig --check FILE    exit 0 when FILE holds exactly these functions, 1 when it does not
//
// Chebyshev interpolation is within a small factor of the minimax polynomial; both functions are analytic up to a
// distance where one more term gains a factor of 5.8 (Bernstein ellipse through the singularity), so there is
// nothing to win by an exchange algorithm.
#include <quadmath.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Quad = __float128;

// Coefficients, constant first, of the polynomial through f at the Chebyshev nodes of [0, 1].
std::vector<Quad> fit(const std::function<Quad(Quad)>& f, int degree) {
  const int n = degree + 1;
  std::vector<Quad> node(n), divided(n);
  for (int i = 0; i < n; ++i) {
    node[i] = (1 + cosq((2 * i + 1) * M_PIq / (2 * n))) / 2;
    divided[i] = f(node[i]);
  }
  for (int order = 1; order < n; ++order)
    for (int i = n - 1; i >= order; --i) divided[i] = (divided[i] - divided[i - 1]) / (node[i] - node[i - order]);
  // Converts the Newton form to monomials.
  std::vector<Quad> c(n, 0);
  for (int i = n - 1; i >= 0; --i) {
    for (int k = n - 1; k > 0; --k) c[k] = c[k - 1] - node[i] * c[k];
    c[0] = divided[i] - node[i] * c[0];
  }
  return c;
}

Quad worst_relative_error(const std::function<Quad(Quad)>& f, const std::vector<Quad>& c) {
  Quad worst = 0;
  for (int i = 0; i <= 4000; ++i) {
    const Quad x = Quad(i) / 4000;
    Quad p = 0;
    for (auto k = c.rbegin(); k != c.rend(); ++k) p = p * x + *k;
    worst = fmaxq(worst, fabsq(p / f(x) - 1));
  }
  return worst;
}

std::string number(Quad x) {
  char text[64];
  std::snprintf(text, sizeof text, "%.17g", static_cast<double>(x));
  std::string s = text;
  if (s.find('e') != std::string::npos) {  // the dialect only has plain decimals
    std::snprintf(text, sizeof text, "%.25f", static_cast<double>(x));
    s = text;
  }
  if (s.find('.') == std::string::npos) s += ".0";
  return s;
}

enum class Returns { value, value_and_slope };

std::string function(const char* name, const char* variable, const std::function<Quad(Quad)>& f, int degree, Returns returns) {
  const std::vector<Quad> c = fit(f, degree);
  const bool with_slope = returns == Returns::value_and_slope;
  std::ostringstream out;
  char error[64];
  std::snprintf(error, sizeof error, "%.1e", static_cast<double>(worst_relative_error(f, c)));
  out << "// Degree " << degree << ", largest relative error " << error << " before rounding"
      << (with_slope ? "; and its derivative, by the same steps.\n" : ".\n");
  out << (with_slope ? "vec2 " : "real ") << name << "(real " << variable << ") {\n";
  out << "    real p = " << number(c.back()) << ";\n";
  if (with_slope) out << "    real d = p;\n";
  for (int k = degree - 1; k >= 0; --k) {
    if (with_slope && k < degree - 1) out << "    d = d * " << variable << " + p;\n";
    const std::string text = number(c[k]);
    if (text[0] == '-')
      out << "    p = p * " << variable << " - " << text.substr(1) << ";\n";
    else
      out << "    p = p * " << variable << " + " << text << ";\n";
  }
  out << (with_slope ? "    return vec2(p, d);\n}\n" : "    return p;\n}\n");
  return out.str();
}

// acos(1 - t) / sqrt(1 - (1 - t)^2), by its series near 0/0.
Quad angle_over_sine(Quad t) {
  if (t < 1e-12Q) return 1 + t / 3 + 2 * t * t / 15;
  return acosq(1 - t) / sqrtq(t * (2 - t));
}

// atan(sqrt(q)) / sqrt(q)
Quad atan_over_argument(Quad q) {
  if (q < 1e-12Q) return 1 - q / 3 + q * q / 5;
  const Quad t = sqrtq(q);
  return atanq(t) / t;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> functions = {
      function("trig_angle_over_sine_24_bits", "t", angle_over_sine, 9, Returns::value_and_slope),
      function("trig_angle_over_sine_53_bits", "t", angle_over_sine, 22, Returns::value_and_slope),
      function("trig_atan_over_argument_24_bits", "q", atan_over_argument, 8, Returns::value),
      function("trig_atan_over_argument_53_bits", "q", atan_over_argument, 22, Returns::value),
  };
  if (argc == 3 && std::strcmp(argv[1], "--check") == 0) {
    std::ifstream file(argv[2]);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    for (const std::string& f : functions)
      if (text.find(f) == std::string::npos) {
        std::fprintf(stderr, "%s does not hold:\n%s", argv[2], f.c_str());
        return 1;
      }
    std::printf("%s holds the %zu polynomials found here\n", argv[2], functions.size());
    return 0;
  }
  for (const std::string& f : functions) std::printf("%s\n", f.c_str());
}
