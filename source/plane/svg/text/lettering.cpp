#include "plane/svg/text/lettering.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "plane/svg/text/text.h"

namespace steradian::plane::svg {
namespace {

// The next character of UTF-8; a broken byte is U+FFFD.
char32_t take_character(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC0 ? 1 : 0;
  if (lead < 0x80 || more == 0 || text.size() <= more) {
    text.remove_prefix(1);
    return lead < 0x80 ? lead : 0xFFFD;
  }
  char32_t c = lead & (0x3Fu >> more);
  for (std::size_t i = 1; i <= more; ++i) c = c << 6 | (static_cast<unsigned char>(text[i]) & 0x3Fu);
  text.remove_prefix(more + 1);
  return c;
}

bool is_text_space(char32_t c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

class TextLayout {
 public:
  TextLayout(SvgDocument& document, Styles& styles, Fonts& fonts, Vec2d whole, const std::function<void()>& spend)
      : document_(document), styles_(styles), fonts_(fonts), whole_(whole), spend_(spend) {}

  void walk(pugi::xml_node n, const Style& style, int depth) {
    if (style.role == Role::ignore || depth > 64) return;
    const auto x = lengths(n, "x", whole_.x), y = lengths(n, "y", whole_.y), dx = lengths(n, "dx", whole_.x),
               dy = lengths(n, "dy", whole_.y);
    std::size_t letter = 0;
    const auto step = [&] {
      if (letter < x.size() || letter < y.size()) end_line();
      if (letter < x.size()) at_.x = x[letter];
      if (letter < y.size()) at_.y = y[letter];
      if (letter < dx.size()) at_.x += dx[letter];
      if (letter < dy.size()) at_.y += dy[letter];
      ++letter;
    };
    if (!x.empty() || !y.empty()) end_line();
    // A position applies from here on, also if the first letter is in a nested element.
    step();
    letter = 0;
    bool first = true;
    for (pugi::xml_node child : n.children()) {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
        begin_run(n, style);
        for (std::string_view text = child.value(); !text.empty();) {
          char32_t c = take_character(text);
          if (is_text_space(c)) {
            if (after_space_) continue;
            c = ' ';
          }
          after_space_ = c == ' ';
          if (first)
            letter = 1, first = false;
          else
            step();
          put(c, style);
        }
      } else if (child.type() == pugi::node_element) {
        const std::string_view name = child.name();
        if (name == "tspan" || name == "a")
          walk(child, styles_.inherit(child, style), depth + 1);
        else if (name != "title" && name != "desc")
          document_.ignored.insert("<" + std::string(name) + "> in <text>");
      }
    }
  }

  std::vector<TextRun> finish() {
    end_line();
    return std::move(runs_);
  }

 private:
  std::vector<double> lengths(pugi::xml_node n, const char* key, double whole) const {
    std::vector<double> result;
    std::string list = n.attribute(key).value();
    std::replace(list.begin(), list.end(), ',', ' ');
    for (const std::string& word : words(list)) {
      const auto length = SvgDocument::length_of(word, whole);
      if (!length) document_.fail(n, std::string(key) + "=\"" + list + "\" is not a list of lengths", "write numbers");
      result.push_back(*length);
    }
    return result;
  }

  void begin_run(pugi::xml_node n, const Style& style) {
    if (runs_.empty() || runs_.back().node != n) runs_.push_back({n, style, {}});
  }

  void put(char32_t c, const Style& style) {
    spend_();
    const Face* face = face_of(style);
    if (face == nullptr) return;
    const unsigned glyph = face->glyph_of(c);
    if (line_.empty()) anchor_ = style.anchor == "middle" ? 0.5 : style.anchor == "end" ? 1.0 : 0.0, line_start_ = line_end_ = at_.x;
    if (face == last_face_ && !line_.empty()) at_.x += style.font_size * face->kerning(last_glyph_, glyph);
    line_.push_back({runs_.size() - 1, runs_.back().letters.size()});
    runs_.back().letters.push_back({face, glyph, at_});
    at_.x += style.font_size * face->advance(glyph);
    if (c != ' ') line_end_ = at_.x;
    last_face_ = face;
    last_glyph_ = glyph;
  }

  const Face* face_of(const Style& style) {
    const Face* face = fonts_.face(style.family, style.weight, style.slant);
    if (face == nullptr) {
      document_.ignored.insert("<text> (no font was found: install one, such as fonts-dejavu-core)");
      return face;
    }
    const std::vector<std::string> asked = family_names(style.family);
    static constexpr const char* kGeneric[] = {"sans-serif", "serif", "monospace", "cursive", "fantasy", "system-ui", "sans", "mono"};
    const bool is_it = std::any_of(asked.begin(), asked.end(), [&](const std::string& name) {
      return lower(name) == lower(face->family()) || std::find(std::begin(kGeneric), std::end(kGeneric), lower(name)) != std::end(kGeneric);
    });
    if (!is_it && !asked.empty()) document_.ignored.insert("the font '" + asked.front() + "' (" + face->family() + " instead)");
    return face;
  }

  void end_line() {
    const double move = -anchor_ * (line_end_ - line_start_);
    for (const auto& [run, letter] : line_) runs_[run].letters[letter].at.x += move;
    line_.clear();
    after_space_ = true;
  }

  SvgDocument& document_;
  Styles& styles_;
  Fonts& fonts_;
  Vec2d whole_, at_;
  const std::function<void()>& spend_;
  std::vector<TextRun> runs_;
  std::vector<std::pair<std::size_t, std::size_t>> line_;  // in the line so far: run, letter
  double line_start_ = 0, line_end_ = 0, anchor_ = 0;      // without spaces at the end
  bool after_space_ = true;
  const Face* last_face_ = nullptr;
  unsigned last_glyph_ = 0;
};

}  // namespace

std::vector<TextRun> lay_out_text(SvgDocument& document, Styles& styles, Fonts& fonts, pugi::xml_node text, const Style& style, Vec2d whole,
                                  const std::function<void()>& spend) {
  TextLayout layout(document, styles, fonts, whole, spend);
  layout.walk(text, style, 0);
  return layout.finish();
}

}  // namespace steradian::plane::svg
