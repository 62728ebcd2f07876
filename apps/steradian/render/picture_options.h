// Options that several verbs share: adds them, or parses their texts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "steradian/load_scene.h"

namespace steradian::app {

class Verb;

struct PictureSize {
  int width = 0, height = 0;
};

// Parses "1280x720". Throws WrongOption. The limit prevents a typing error from asking for terabytes.
PictureSize picture_size(const std::string& text);

// Parses stops, -30 to 30; none for "auto". Throws WrongOption.
std::optional<float> exposure_stops(const std::string& text);

// Parses a number of bounces, or "all" (kAllBounces), that unknown_bounces accepts.
int bounces_of(const std::string& text);
std::string unknown_bounces(const std::string& text);  // message for anything else; empty for these

// Adds --environment and --environment-rotation.
void add_environment(Verb& verb, LoadOptions& load);

// The names of methods that completions offer.
std::vector<std::string> method_names();

// Message for an unknown name of a method; empty for a known one. plane: methods of plane scenes are known, too.
std::string unknown_method(const std::string& name, bool plane);

}  // namespace steradian::app
