#include "scene/emitters/solid_meshes.h"

#include <gtest/gtest.h>

#include <cmath>

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
    EXPECT_GE(solids[0].faces.size(), 192u);
    EXPECT_EQ(solids[0].lights.size(), solids[0].faces.size());
    EXPECT_LT(length(solids[0].radiance - Vec3d{2, 3, 4}), 1e-9);
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

TEST(SolidMeshes, ShineToTheirFaces) {
  Mesh inwards = ring();
  turn(inwards);
  for (const Mesh& mesh : {ring(), inwards}) {
    const SolidMesh solid = solid_meshes(shining(mesh, true)).at(0);
    for (const MergedPolygon& face : solid.faces) {
      // The middle of the tube nearest to the face lies behind it. It is on the ring's circle, 0.5 from its centre.
      const PreparedPolygon p = prepare_polygon({face.outline, face.holes});
      const Vec3d axis{0, -std::sin(0.4), std::cos(0.4)}, d = p.centroid - Vec3d{1, 2, 3}, flat = d - axis * dot(d, axis);
      EXPECT_GT(dot(p.normal, d - normalized(flat) * 0.5), 0);
    }
  }
}

TEST(SolidMeshes, HavePlainLightsOnly) {
  Scene scene = shining(ring(), false);
  scene.area_lights[7].two_sided = true;
  EXPECT_EQ(solid_meshes(scene).size(), 0u);
  scene = shining(ring(), false);
  scene.meshes[0].triangle_lights.assign(scene.meshes[0].triangle_lights.size(), -1);  // dropped
  EXPECT_EQ(solid_meshes(scene).size(), 0u);
}

// The lights that are kept have the power of all, and so does the solid mesh.
TEST(SolidMeshes, KeepTheirFacesWhereLightsAreMerged) {
  Scene scene = shining(ring(), false);
  const std::size_t all = scene.area_lights.size();
  Budget budget;
  keep_strongest(scene, 10, budget, "a test");
  ASSERT_EQ(scene.area_lights.size(), 10u);
  const SolidMesh solid = solid_meshes(scene).at(0);
  EXPECT_EQ(solid.faces.size(), all);
  EXPECT_EQ(solid.lights.size(), 10u);
  EXPECT_LT(length(solid.radiance - Vec3d{2, 3, 4}), 1e-6);
}

}  // namespace
}  // namespace steradian::scene::solid_meshes_test
