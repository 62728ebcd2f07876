// Measured profiles in files: their text, the two formats, and the circle of their planes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "steradian/light_profile.h"

namespace steradian::scene {

// Readers for the text of photometric files: lines with their numbers, and numbers with the line that they stand on.

class PhotometryText {
 public:
  PhotometryText(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  bool at_end() const { return at_ >= text_.size(); }
  std::string_view line();  // the next line, without its end
  std::size_t line_number() const { return number_; }

  // The next number, on this line or a later one, between blanks and commas. what: "a vertical angle", for messages.
  double number(const std::string& what, double low, double high);
  std::size_t count(const std::string& what, std::size_t low, std::size_t high);
  std::vector<double> rising_numbers(const std::string& what, std::size_t size, double low, double high);
  void check_range(const std::string& what, double value, double low, double high) const;
  // True if only blanks and the end mark of old systems follow.
  bool nothing_follows();

  std::size_t size() const { return text_.size(); }
  // Throws Error that names the file and the line.
  [[noreturn]] void fail(const std::string& problem, const std::string& hint = {}) const;

 private:
  void skip_blanks();

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0, number_ = 1;
  std::size_t last_line_ = 1;  // line of the last token read
};

// Shortens and cleans a text from a file for a message.
std::string quoted(std::string_view text);

// Reads a text that is one number with optional blanks around it. Returns false for any other text.
bool read_whole_number(std::string_view text, double& value);

// The two file formats of luminaires: https://www.ies.org, ANSI/IES LM-63-19, and EULUMDAT (Stockmar 1990).

LightProfile read_ies(PhotometryText text);
LightProfile read_eulumdat(PhotometryText text);

// True if rising angles of planes of type c cover a circle: one alone, 0 to 90, 0 to 180, 0 to more, or 90 to 270 with 180.
bool goes_round(const std::vector<double>& planes);

// Expands the symmetry of type c to the whole circle. profile.horizontal: the planes that profile.candela holds; goes_round must be true
// for them.
void complete_circle(LightProfile& profile);

}  // namespace steradian::scene
