#include <fmt/format.h>

#include <iterator>

#include "eval/answer.h"
#include "steradian/polygon_derivatives.h"

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

void append_channels(std::string& out, const char* key, const std::array<Vec3d, 3>& value, Precision precision) {
  out += key;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    out += channel == 0 ? '[' : ',';
    append_vector(out, value[channel], precision);
  }
  out += ']';
}

// [channel][vertex][x, y, z]
void append_vertices(std::string& out, const char* key, const std::vector<std::array<Vec3d, 3>>& vertices, Precision precision) {
  out += key;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    out += channel == 0 ? "[[" : ",[";
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (i > 0) out += ',';
      append_vector(out, vertices[i][channel], precision);
    }
    out += ']';
  }
  out += ']';
}

void append_derivatives(std::string& out, const Answer& answer) {
  append_vertices(out, ",\"d_vertices\":", answer.derivatives->vertices, answer.precision);
  append_channels(out, ",\"d_position\":", answer.by_position, answer.precision);
  append_channels(out, ",\"d_normal\":", answer.derivatives->normal, answer.precision);
  if (!answer.by_occluders.empty()) append_vertices(out, ",\"d_occluders\":", answer.by_occluders, answer.precision);
}

void append_parameters(std::string& out, const ParameterDerivatives& d, Precision precision) {
  const auto append = [&](const char* key, const std::optional<Vec3d>& value) {
    if (!value) return;
    out += key;
    append_vector(out, *value, precision);
  };
  append(",\"d_radiance\":", d.radiance);
  append(",\"d_f0\":", d.f0);
  append(",\"d_roughness\":", d.roughness);
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
  if (answer.derivatives) append_derivatives(out, answer);
  append_parameters(out, answer.parameters, answer.precision);
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
