// KeptMeshes: a cache of placed meshes from one reading of a file to the next.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "scene/affine.h"
#include "scene/gltf/gltf_document.h"
#include "steradian/load_scene.h"

namespace steradian {

struct KeptMeshes {
  // The inputs of a placed mesh, besides its primitive's accessors and their bytes.
  struct Source {
    scene::Affine world;
    std::vector<double> weights;
    int mesh = 0, material = 0;
    int tangent_set = -1;  // texture set, see SurfaceMaterial
    std::string name;
    bool operator==(const Source&) const = default;
  };

  // The cached mesh of a node's primitive, or null if one of its inputs has changed. Skinned meshes are not cached: other nodes move them.
  const Mesh* find(int node, int primitive, const Source& source) const;
  void keep(int node, int primitive, Source source, const Mesh& mesh);

  // Called before the meshes are read. Drops the meshes of primitives whose JSON, accessors, views or buffers have changed.
  void begin(const scene::GltfDocument& document);
  std::size_t found = 0;  // hits since begin

 private:
  struct Kept {
    Source source;
    Mesh mesh;
  };
  bool unchanged(const nlohmann::json& now, int mesh, int primitive) const;
  std::map<std::pair<int, int>, Kept> kept_;
  nlohmann::json before_;  // the last document's arrays that define meshes
};

}  // namespace steradian
