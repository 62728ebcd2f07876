#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <string_view>

#include "core/files.h"
#include "exchange/files/mesh_files.h"
#include "steradian/error.h"

namespace steradian::exchange {

namespace {

// The messages of Assimp hold parts of the file, of any length and with any characters.
std::string first_words(std::string text) {
  constexpr std::size_t kMost = 160;
  if (text.size() > kMost) text = text.substr(0, kMost) + "...";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) >= 0x7f) c = '?';
  return text;
}

}  // namespace

std::vector<PolygonMesh> read_mesh_file(const std::string& path, Budget& budget) {
  // The file is read here: its size is judged, and Assimp opens no other file that it may name.
  const Bytes bytes = read_file(path, path, budget);
  if (bytes.empty()) throw Error(path, "the file is empty", "export it again");
  budget.take_memory(path, "the meshes of a file", 16 * static_cast<std::uint64_t>(bytes.size()));
  std::string ending = std::filesystem::path(path).extension().string();
  ending.erase(0, 1);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  // Assimp 5.2 reads a PLY header without an end for ever.
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (ending == "ply" && text.find("end_header\n") == text.npos && text.find("end_header\r") == text.npos)
    throw Error(path, "its header has no end_header", "export it again");
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, ending.c_str());
  if (scene == nullptr) throw Error(path, "cannot be read: " + first_words(importer.GetErrorString()), "export it again, or as glTF");
  std::vector<PolygonMesh> meshes;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    PolygonMesh& result = meshes.emplace_back();
    result.name = mesh.mName.C_Str();
    if (mesh.mMaterialIndex < scene->mNumMaterials) result.material = scene->mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) continue;
      std::vector<Vec3d>& polygon = result.polygons.emplace_back();
      for (unsigned c = 0; c < face.mNumIndices; ++c) {
        if (face.mIndices[c] >= mesh.mNumVertices) throw Error(path, "a face names a vertex that is not there", "export it again");
        const aiVector3D& v = mesh.mVertices[face.mIndices[c]];
        polygon.push_back({static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
      }
    }
  }
  return meshes;
}

}  // namespace steradian::exchange
