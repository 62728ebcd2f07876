#include "view_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::view {
namespace {

constexpr const char* kCameraName = "steradian view";

scene::Affine pose_of(const Camera& camera) { return {camera.x, camera.y, camera.z, camera.position}; }

}  // namespace

void ViewCamera::turn(double yaw, double pitch) {
  // The pitch is limited to straight up and down.
  const double now = std::asin(std::clamp(camera_.z.y, -1.0, 1.0)), most = std::numbers::pi / 2 - 1e-3;
  pitch = std::clamp(now + pitch, std::min(-most, now), std::max(most, now)) - now;
  for (Vec3d* axis : {&camera_.x, &camera_.y, &camera_.z}) *axis = rotated(*axis, {0, 1, 0}, yaw);
  for (Vec3d* axis : {&camera_.y, &camera_.z}) *axis = rotated(*axis, camera_.x, -pitch);
  camera_.z = normalized(camera_.z);
  const Frame frame = Frame::from_normal_and_tangent(camera_.z, camera_.x);
  camera_.x = frame.x;
  camera_.y = frame.y;
}

void ViewCamera::orbit(double right, double down) {
  const Vec3d about = target();
  turn(-right * std::numbers::pi, down * std::numbers::pi);
  camera_.position = about + camera_.z * distance_;
}

void ViewCamera::look(double right, double down) { turn(right * camera_.yfov, -down * camera_.yfov); }

void ViewCamera::pan(double right, double down) {
  const double height = 2 * distance_ * std::tan(camera_.yfov / 2);
  camera_.position += camera_.x * (-right * height) + camera_.y * (down * height);
}

void ViewCamera::dolly(double steps) {
  const Vec3d about = target();
  distance_ = std::clamp(distance_ * std::pow(0.9, steps), 1e-9, 1e12);
  camera_.position = about + camera_.z * distance_;
}

void ViewCamera::fly(double right, double up, double forward) {
  camera_.position += (camera_.x * right + camera_.y * up - camera_.z * forward) * distance_;
}

void ViewCamera::look_at(Vec3d target) {
  const Vec3d away = camera_.position - target;
  if (!(length(away) > 0)) return;
  distance_ = length(away);
  camera_.z = away / distance_;
  const Frame frame = Frame::from_normal_and_tangent(camera_.z, cross({0, 1, 0}, camera_.z));
  camera_.x = frame.x;
  camera_.y = frame.y;
}

Ray ray_through(const Camera& camera, Vec2d pixel, double width, double height) {
  const double h = std::tan(camera.yfov / 2), w = h * width / height;
  const Vec3d d = -camera.z + camera.x * (w * (2 * pixel.x / width - 1)) + camera.y * (h * (1 - 2 * pixel.y / height));
  return {camera.position, normalized(d)};
}

std::optional<Vec2d> project(const Camera& camera, Vec3d point, double width, double height) {
  const Vec3d d = point - camera.position;
  const double depth = -dot(d, camera.z);
  if (!(depth > 1e-9 * length(d))) return {};
  const double h = std::tan(camera.yfov / 2), w = h * width / height;
  return Vec2d{(dot(d, camera.x) / (depth * w) + 1) / 2 * width, (1 - dot(d, camera.y) / (depth * h)) / 2 * height};
}

Camera as_read(const Camera& camera) { return scene::camera_at(pose_of(camera), camera.yfov, kCameraName); }

scene::GltfFile with_camera(scene::GltfFile file, const Camera& camera) {
  Json& json = file.json;
  const scene::Affine m = pose_of(camera);
  const Json matrix = Json::array({m.x.x, m.x.y, m.x.z, 0, m.y.x, m.y.y, m.y.z, 0, m.z.x, m.z.y, m.z.z, 0, m.t.x, m.t.y, m.t.z, 1});

  std::size_t node = 0;
  if (!json.contains("cameras")) json["cameras"] = Json::array();  // a new key moves the values, so it comes ahead of references
  Json& nodes = json["nodes"];
  if (!nodes.is_array()) nodes = Json::array();
  while (node < nodes.size() && !(nodes[node].value("name", "") == kCameraName && nodes[node].contains("camera"))) ++node;
  if (node == nodes.size()) {
    nodes.push_back({{"name", kCameraName}, {"camera", json["cameras"].size()}});
    json["cameras"].push_back({{"name", kCameraName}, {"type", "perspective"}, {"perspective", {{"yfov", camera.yfov}}}});
  }
  for (const char* key : {"translation", "rotation", "scale"}) nodes[node].erase(key);
  nodes[node]["matrix"] = matrix;
  json["cameras"].at(nodes[node]["camera"].get<std::size_t>())["perspective"]["yfov"] = camera.yfov;

  // The camera is first among the scene's roots, and so the first camera.
  if (!json.contains("scenes") || json["scenes"].empty()) {
    std::vector<bool> is_child(nodes.size(), false);
    for (const Json& n : nodes)
      if (n.contains("children"))
        for (const Json& child : n["children"]) is_child.at(child.get<std::size_t>()) = true;
    Json roots = Json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!is_child[i]) roots.push_back(i);
    json["scenes"] = Json::array({{{"nodes", roots}}});
    json["scene"] = 0;
  }
  Json& scene = json["scenes"].at(json.value("scene", std::size_t{0}));
  Json roots = Json::array({node});
  if (scene.contains("nodes"))
    for (const Json& root : scene["nodes"])
      if (root != Json(node)) roots.push_back(root);
  scene["nodes"] = roots;
  return file;
}

}  // namespace steradian::view
