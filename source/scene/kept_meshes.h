// KeptMeshes: placed meshes from one reading of a file to the next.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "scene/affine.h"
#include "scene/gltf_document.h"
#include "steradian/load_scene.h"

namespace steradian {

struct KeptMeshes {
  // What a placed mesh was made of, beside its primitive's accessors and their bytes.
  struct Source {
    scene::Affine world;
    std::vector<double> weights;
    int mesh = 0, material = 0;
    int tangent_set = -1;  // SurfaceMaterial's
    std::string name;
    bool operator==(const Source&) const = default;
  };

  // The mesh of a node's primitive as it stood, or null where something it was made of has changed. A skin moves its mesh from outside.
  const Mesh* find(int node, int primitive, const Source& source) const;
  void keep(int node, int primitive, Source source, const Mesh& mesh);

  // Before the meshes are read: drops those of primitives whose JSON, accessors, views or buffers have changed.
  void begin(const scene::GltfDocument& document);
  std::size_t found = 0;  // since begin

 private:
  struct Kept {
    Source source;
    Mesh mesh;
  };
  bool unchanged(const nlohmann::json& now, int mesh, int primitive) const;
  std::map<std::pair<int, int>, Kept> kept_;
  nlohmann::json before_;  // the arrays of the last document that meshes are made of
};

}  // namespace steradian
