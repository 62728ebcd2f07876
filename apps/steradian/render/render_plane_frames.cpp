#include "render/render_plane_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <vector>

#include "command_line.h"
#include "render/left_out.h"
#include "steradian/error.h"
#include "steradian/plane_animation.h"
#include "steradian/plane_device.h"
#include "steradian/plane_stage.h"
#include "steradian/version.h"

namespace steradian::app {
namespace {

using nlohmann::ordered_json;

// A change to the bodies with an id, applied before each frame of a range.
struct Edit {
  int first = 0, last = 0;
  std::string id;
  std::optional<Vec2d> move;
  std::optional<Vec3d> radiance;
  bool remove = false;
};

[[noreturn]] void refuse(const std::string& file, std::size_t edit, const std::string& problem) {
  throw Error(file, fmt::format("edit {}: {}", edit, problem),
              R"(write [{"frames": [0, 20], "id": "lamp", "move": [2, 0]}, ...]; also "frame": 7, "radiance": [1, 1, 1], "remove": true)");
}

std::vector<double> numbers(const ordered_json& list, std::size_t count) {
  std::vector<double> result;
  if (!list.is_array() || list.size() != count) return {};
  for (const auto& n : list) {
    if (!n.is_number()) return {};
    result.push_back(n.get<double>());
  }
  return result;
}

Edit edit_of(const ordered_json& json, const std::string& file, std::size_t at) {
  if (!json.is_object()) refuse(file, at, "not an object");
  Edit edit;
  bool when = false;
  for (const auto& [key, value] : json.items()) {
    if (key == "frame" && value.is_number_unsigned()) {
      edit.first = edit.last = value.get<int>();
      when = true;
    } else if (const auto f = numbers(value, 2); key == "frames" && f.size() == 2) {
      edit.first = static_cast<int>(f[0]);
      edit.last = static_cast<int>(f[1]);
      when = true;
    } else if (key == "move" && f.size() == 2) {
      edit.move = Vec2d{f[0], f[1]};
    } else if (const auto c = numbers(value, 3); key == "radiance" && c.size() == 3) {
      edit.radiance = Vec3d{c[0], c[1], c[2]};
    } else if (key == "id" && value.is_string()) {
      edit.id = value.get<std::string>();
    } else if (key == "remove" && value.is_boolean()) {
      edit.remove = value.get<bool>();
    } else {
      refuse(file, at, "cannot read \"" + key + "\"");
    }
  }
  if (!when || edit.id.empty()) refuse(file, at, "lacks its frames or its id");
  return edit;
}

std::vector<Edit> edits_of(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw Error(file, "cannot be read", "give a JSON file with --edits");
  std::vector<Edit> edits;
  try {
    const ordered_json json = ordered_json::parse(in);
    if (!json.is_array()) refuse(file, 0, "the file is not a list");
    for (const auto& edit : json) edits.push_back(edit_of(edit, file, edits.size()));
  } catch (const nlohmann::json::exception& e) {
    throw Error(file, std::string("not JSON: ") + e.what(), "write a list of edits");
  }
  return edits;
}

void apply(const Edit& edit, const std::string& file, PlaneStage& stage) {
  bool found = false;
  for (std::size_t i = stage.scene().bodies.size(); i-- > 0;) {
    if (stage.scene().bodies[i].name != edit.id) continue;
    found = true;
    if (edit.move) stage.move(i, *edit.move);
    if (edit.radiance) stage.recolour(i, *edit.radiance);
    if (edit.remove) stage.remove(i);
  }
  if (!found) throw Error(file, "the scene has no shape with the id " + edit.id, "give it one, or edit another");
}

void write(const Picture& drawn, const PlaneRender& job, int frame) {
  Picture picture = drawn;
  picture.metadata = {{"steradian.version", version()}, {"steradian.scene", job.scene}, {"steradian.frame", std::to_string(frame)}};
  write_picture(picture, numbered(job.output, frame), job.exposure, job.tone);
}

// True if a stage draws the frames, which keeps what does not change. All others are rendered from scratch.
bool is_staged(const PlaneFrameOptions& options, const PlaneDevice* device) {
  return device == nullptr && options.aa <= 1 && options.occluders == PlaneOccluders::black && !options.moments;
}

Picture from_scratch(const PlaneWorld& world, const PlaneFrameOptions& options, PlaneDevice* device) {
  return device != nullptr ? device->render(world, options) : render_plane(world, options);
}

void render_animation(const PlaneRender& job, const std::vector<int>& wanted, const PlaneFrameOptions& options,
                      const PlaneAnimation& animation, PlaneDevice* device) {
  const bool staged = is_staged(options, device);
  std::optional<PlaneStage> stage;
  std::set<std::string> named;
  for (const int frame : wanted) {
    PlaneSvg now = animation.at(frame / job.fps);
    if (frame == wanted.front()) say_backdrops(now, job.scene);
    for (const std::string& name : now.ignored)
      if (named.insert(name).second) fmt::print(stderr, "steradian: {}: not supported and left out: {}\n", job.scene, name);
    // A stage keeps the suns and the fog that it began with.
    if (!staged || !now.scene.suns.empty() || now.scene.fog_density > 0) {
      stage.reset();
      write(from_scratch(PlaneWorld(std::move(now.scene), job.limits), options, device), job, frame);
      continue;
    }
    if (stage)
      stage->follow(now.scene);
    else
      stage.emplace(std::move(now.scene), options);
    write(stage->draw(), job, frame);
  }
}

}  // namespace

void render_plane_frames(const PlaneRender& job, const PlaneFrames& frames, const PlaneFrameOptions& options, PlaneScene scene) {
  const std::vector<int> wanted = frames_to_make(frames.range, job.output, job.force, job.part);
  if (wanted.empty()) return;
  const PlaneAnimation animation(job.scene, job.limits);
  std::optional<PlaneDevice> device;
  if (job.vulkan) device.emplace(job.device);
  if (animation.moves()) {
    if (!frames.edits.empty()) throw UsageError("--edits", "the drawing moves by itself", "take its animations out, or leave --edits out");
    return render_animation(job, wanted, options, animation, device ? &*device : nullptr);
  }
  const std::vector<Edit> edits = frames.edits.empty() ? std::vector<Edit>{} : edits_of(frames.edits);
  PlaneDevice* const on = device ? &*device : nullptr;
  const bool staged = is_staged(options, on);
  PlaneFrameOptions of_stage = options;  // if it does not draw, it only keeps the scene that the edits change
  if (!staged) of_stage.aa = 1, of_stage.occluders = PlaneOccluders::black, of_stage.moments = false;
  PlaneStage stage(std::move(scene), of_stage);
  for (int frame = 0; frame <= wanted.back(); ++frame) {
    for (const Edit& edit : edits)
      if (edit.first <= frame && frame <= edit.last) apply(edit, frames.edits, stage);
    if (std::binary_search(wanted.begin(), wanted.end(), frame))
      write(staged ? stage.draw() : from_scratch(PlaneWorld(stage.scene(), job.limits), options, on), job, frame);
  }
}

}  // namespace steradian::app
