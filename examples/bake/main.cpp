// Bakes the light of a scene into a light map: bake SCENE.glb BAKED.glb
#include <steradian/bake.h>
#include <steradian/error.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: bake SCENE.glb BAKED.glb\n");
    return 2;
  }
  try {
    steradian::LightMapOptions options;
    options.texels = 8;  // a metre
    options.bounces = 2;
    const steradian::LightMapFacts facts = steradian::bake_light_map(argv[1], argv[2], options);
    for (const std::string& warning : facts.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    std::printf("%d x %d texels, mean irradiance %.3f\n", facts.width, facts.height, facts.mean);
  } catch (const steradian::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
