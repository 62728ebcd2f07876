// FitSpace: the functions whose sum a viewer of the baked light shows, as unknowns of a least squares fit.
#pragma once

#include <array>
#include <vector>

#include "bake/charts/chart.h"
#include "bake/charts/seams.h"
#include "bake/hat_fit.h"
#include "bake/samples.h"
#include "steradian/scene.h"

namespace steradian::bake {

// Weight of a gradient over that of light on the same area. A constant stays as it is, and edges of light blur by a thirtieth of a texel.
// Unknowns with little light of their own take that of their neighbours.
inline constexpr double kSmooth = 1e-3;

class FitSpace {
 public:
  virtual ~FitSpace() = default;
  virtual std::size_t count() const = 0;
  virtual bool has_seams() const = 0;  // as conditions, which make the fit stiff
  virtual std::array<Hat, 4> at(std::uint32_t chart, const Sample& sample) const = 0;
  // Adds the conditions beside the light: smoothness, and seams.
  virtual void add_conditions(HatFit& fit) const = 0;
  // Puts the values and their errors where they belong. Any number of threads may store different spaces.
  virtual void store(const std::vector<Vec3d>& values, const std::vector<Vec3d>& errors) const = 0;
};

// The pixels of a map. Texels of no chart are zero.
struct MapTexels {
  int width = 0, height = 0;
  std::vector<Vec3f> irradiance, error;
};

// The value that a graphics card shows at a place of a map [texels].
Vec3d shown_at(const std::vector<Vec3f>& texels, int width, Vec2d at);

// Bilinear functions of the texels of some charts, which a graphics card shows.
class TexelSpace : public FitSpace {
 public:
  // Charts and seams must outlive this object, and so must the map.
  //
  //   group   the charts, in their order
  //   seams   those between them
  //   texel   side of a texel [m]
  TexelSpace(const std::vector<Chart>& charts, std::vector<std::uint32_t> group, std::vector<const Seam*> seams, double texel,
             MapTexels& map);

  std::size_t count() const override { return count_; }
  bool has_seams() const override { return !seams_.empty(); }
  std::array<Hat, 4> at(std::uint32_t chart, const Sample& sample) const override { return at(chart, sample.at); }
  void add_conditions(HatFit& fit) const override;
  void store(const std::vector<Vec3d>& values, const std::vector<Vec3d>& errors) const override;

  // Number of places at which a seam's sides are compared.
  static int places_on(const Seam& seam);

 private:
  std::uint32_t of(std::uint32_t chart, int x, int y) const;
  std::array<Hat, 4> at(std::uint32_t chart, Vec2d p) const;
  std::array<Hat, 8> difference(const Seam& seam, double t) const;

  const std::vector<Chart>& charts_;
  const std::vector<std::uint32_t> group_;
  const std::vector<const Seam*> seams_;
  const double texel_;
  MapTexels& map_;
  std::vector<std::pair<std::uint32_t, std::size_t>> first_;  // sorted: the chart, and its first unknown
  std::size_t count_ = 0;
};

// The light of a mesh's corners, three a triangle. Those of no chart are zero.
struct CornerLight {
  std::vector<Vec3f> irradiance, error;
};

// Linear functions of the vertices of a mesh. Corners of one position and normal share an unknown, but for charts that contacts part.
class VertexSpace : public FitSpace {
 public:
  // The mesh and the charts must outlive this object, and so must the light.
  //
  //   group  the charts of the mesh, in their order
  VertexSpace(const Mesh& mesh, const std::vector<Chart>& charts, const std::vector<std::uint32_t>& group, CornerLight& light);

  std::size_t count() const override { return count_; }
  bool has_seams() const override { return false; }
  std::array<Hat, 4> at(std::uint32_t chart, const Sample& sample) const override;
  void add_conditions(HatFit& fit) const override;
  void store(const std::vector<Vec3d>& values, const std::vector<Vec3d>& errors) const override;

 private:
  const Mesh& mesh_;
  CornerLight& light_;
  std::vector<std::uint32_t> unknowns_;  // by corner; kNone for those of no chart
  std::size_t count_ = 0;
};

}  // namespace steradian::bake
