#include <fmt/format.h>

#include <iterator>

#include "eval/answer.h"

namespace steradian::eval {
namespace {

void append_number(std::string& out, double x, Precision precision) {
  if (x == 0.0) {  // also for -0
    out += '0';
  } else if (precision == Precision::float_) {
    fmt::format_to(std::back_inserter(out), "{}", static_cast<float>(x));
  } else {
    fmt::format_to(std::back_inserter(out), "{}", x);
  }
}

void append_vector(std::string& out, const Vec3d& v, Precision precision) {
  out += '[';
  append_number(out, v.x, precision);
  out += ',';
  append_number(out, v.y, precision);
  out += ',';
  append_number(out, v.z, precision);
  out += ']';
}

// [channel], [channel][x, y, z] or [channel][vertex][x, y, z]
void append_derivative(std::string& out, const Derivative& d, Precision precision) {
  out += ",\"";
  out += d.key;
  out += "\":[";
  for (std::size_t channel = 0; channel < 3; ++channel) {
    if (channel > 0) out += ',';
    if (d.form == Derivative::Form::number) append_number(out, d.values.front()[channel].x, precision);
    if (d.form == Derivative::Form::vector) append_vector(out, d.values.front()[channel], precision);
    if (d.form != Derivative::Form::vectors) continue;
    out += '[';
    for (std::size_t i = 0; i < d.values.size(); ++i) {
      if (i > 0) out += ',';
      append_vector(out, d.values[i][channel], precision);
    }
    out += ']';
  }
  out += ']';
}

// The opening brace, and the id if there is one.
void begin(std::string& out, std::string_view id) {
  out += '{';
  if (id.empty()) return;
  out += "\"id\":";
  out += id;
  out += ',';
}

}  // namespace

void write_answer(std::string& out, const Answer& answer, std::string_view id) {
  begin(out, id);
  out += "\"radiance\":";
  append_vector(out, answer.radiance, answer.precision);
  out += ",\"method\":\"";
  out += answer.method;  // names of this program: nothing to escape
  out += '"';
  if (answer.bound) {
    out += ",\"bound\":";
    append_number(out, *answer.bound, Precision::double_);
  }
  if (answer.standard_error) {
    out += ",\"standard_error\":";
    append_number(out, *answer.standard_error, Precision::double_);
  }
  for (const Derivative& d : answer.derivatives) append_derivative(out, d, answer.precision);
  out += "}\n";
}

void write_error(std::string& out, std::string_view message, std::string_view id) {
  begin(out, id);
  out += "\"error\":\"";
  for (const char c : message) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  out += "\"}\n";
}

}  // namespace steradian::eval
