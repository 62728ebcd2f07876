// ManyLights: the diffuse light of any number of area lights on surface points, with an error bound.
//
// Receivers are gathered in cells: boxes about points of one surface. A light far from a cell is an element at the cell's nodes. One
// polynomial through the nodes represents all such lights, at every point and for every normal there. Nearer lights go to the two halves
// of the cell. The remaining lights become elements at every point or, next to the light and across horizons, outlines. See
// docs/manylights.md.
#pragma once

#include <memory>
#include <vector>

#include "render/direct/lobe_packs.h"
#include "render/lights/light_list.h"
#include "render/many/cell.h"

namespace steradian::lights {

// Work done, over all points.
struct Counts {
  std::uint64_t points = 0;    // points lit by many lights
  std::uint64_t elements = 0;  // pairs of a point and a light evaluated as elements at the point
  std::uint64_t outlines = 0;  // pairs evaluated as outlines

  void operator+=(const Counts& more) {
    points += more.points;
    elements += more.elements;
    outlines += more.outlines;
  }
};

class ManyLights {
 public:
  // error: allowed per light, as a fraction of the most that it can send; see RenderOptions::light_error. The reference is stored.
  ManyLights(const std::vector<PackLight>& lights, Vec3f eye, float error);

  bool serves(const PackLight& light) const { return far_.number_of[light.index] >= 0; }

  const FarLights& lights() const { return far_; }
  float error() const { return error_; }

  struct Work;  // memory of one thread
  struct DeleteWork {
    void operator()(Work* work) const;
  };
  using WorkPointer = std::unique_ptr<Work, DeleteWork>;
  static WorkPointer make_work();

  // Writes the radiance of the diffuse lobe under all lights that it serves to `set`, with an error bound per channel.
  void add_diffuse(ReceiverSet& set, Work& work) const { add_diffuse(set, {nullptr, far_.count}, work); }
  // The same for a tile and some of the lights: added to tile.radiance and to `bound`.
  void add_diffuse(SurfaceTile& tile, const std::vector<const PackLight*>& lights, TileVector& bound, Work& work) const;

  static const Counts& counts(const Work& work);

 private:
  // Lights by number; null: all.
  struct Numbers {
    const std::uint32_t* numbers;
    std::size_t count;
    std::uint32_t operator[](std::size_t i) const { return numbers != nullptr ? numbers[i] : static_cast<std::uint32_t>(i); }
  };
  struct Bound;
  struct Outer;
  void add_diffuse(ReceiverSet& set, Numbers numbers, Work& work) const;
  void add_in_order(ReceiverSpan points, Numbers numbers, Work& work) const;
  void add_to_cell(ReceiverSpan points, const ReceiverCell& cell, Numbers numbers, const Outer& outer, std::size_t depth, Work& work) const;
  void add_to_points(ReceiverSpan points, const ReceiverCell& cell, Numbers numbers, const Outer& outer, std::size_t depth,
                     Work& work) const;
  void add_to_some(ReceiverSpan points, const ReceiverCell& cell, Numbers exact, const FarElements& elements, const Outer& outer,
                   Work& work) const;
  void add_outline(std::uint32_t number, const ReceiverCell& cell, CellReceivers& receivers) const;
  float distance_of_lights(const ReceiverCell& cell, Numbers numbers) const;
  void add_element(std::uint32_t number, bool four, float side, FarElements& elements) const;

  const FarLights far_;
  const Vec3f eye_;
  const float error_;
  const CellTable& packs_;
  const LobePacks::Function irradiance_;
};

}  // namespace steradian::lights
