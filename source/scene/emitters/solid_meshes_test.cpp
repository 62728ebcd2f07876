#include "scene/emitters/solid_meshes.h"

#include <gtest/gtest.h>

#include "scene/emitters/emitters.h"
#include "scene/emitters/keep_strongest.h"
#include "support/meshes.h"
#include "support/rings.h"

namespace steradian::scene::solid_meshes_test {
namespace {

Scene shining(const Mesh& mesh, bool double_sided) {
  Scene scene;
  SurfaceMaterial m;
  m.emissive = {2, 3, 4};
  m.double_sided = double_sided;
  scene.materials = {m};
  scene.meshes = {mesh};
  Budget budget;
  add_emitters(scene, budget, "a test");
  return scene;
}

Mesh ring() { return ring_mesh({1, 2, 3}, 0.5, 0.1, 0.4, 0, 24, 8); }

void turn(Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

TEST(SolidMeshes, AreClosedAndShineOutwards) {
  for (const bool double_sided : {false, true}) {
    const std::vector<SolidMesh> solids = solid_meshes(shining(ring(), double_sided));
    ASSERT_EQ(solids.size(), 1u);
    EXPECT_EQ(solids[0].triangles.size(), 384u);
    EXPECT_GE(solids[0].lights, 192u);
    EXPECT_LE(solids[0].lights, 384u);
  }
  Mesh inwards = ring();
  turn(inwards);
  EXPECT_EQ(solid_meshes(shining(inwards, false)).size(), 0u);  // it shines into its own inside
  EXPECT_EQ(solid_meshes(shining(inwards, true)).size(), 1u);   // closed meshes shine outwards
  Mesh open = ring();
  open.indices.resize(open.indices.size() - 3);
  EXPECT_EQ(solid_meshes(shining(open, false)).size(), 0u);
  EXPECT_EQ(solid_meshes(shining(ring_mesh({}, 0.5, 0.1, 0, 0, 3, 3), false)).size(), 0u);      // 18 faces
  EXPECT_EQ(solid_meshes(shining(ring_mesh({}, 0.5, 0.1, 0.4, 0, 80, 60), false)).size(), 0u);  // more than 4,800 faces
}

TEST(SolidMeshes, AreEvenEverywhere) {
  Scene scene = shining(ring(), false);
  scene.area_lights[7].radiance.x += 1e-3;
  EXPECT_EQ(solid_meshes(scene).size(), 0u);
  scene = shining(ring(), false);
  scene.area_lights[7].two_sided = true;
  EXPECT_EQ(solid_meshes(scene).size(), 0u);
  scene = shining(ring(), false);
  scene.meshes[0].triangle_lights[5] = -1;
  EXPECT_EQ(solid_meshes(scene).size(), 0u);
}

// A solid mesh needs one place. Where the places do not suffice, its faces are merged as those of other meshes.
TEST(SolidMeshes, NeedOnePlace) {
  Scene scene = shining(ring_mesh({}, 0.5, 0.1, 0.3, 0, 40, 12), false);
  const std::size_t all = scene.area_lights.size();
  ASSERT_GT(all, 256u);
  Budget budget;
  const KeptLights kept = keep_strongest(scene, {}, budget, "a test");
  EXPECT_EQ(kept.most, 256u);
  EXPECT_EQ(kept.merged, 0u);
  EXPECT_EQ(scene.area_lights.size(), all);
  scene.area_lights.push_back(scene.area_lights.front());
  EXPECT_EQ(keep_strongest(scene, 1, budget, "a test").most, 1u);
  EXPECT_EQ(scene.area_lights.size(), 1u);
}

}  // namespace
}  // namespace steradian::scene::solid_meshes_test
