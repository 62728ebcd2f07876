// Cells about surface points of a tile, and how they are divided.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "render/cpu/tile.h"
#include "render/lights/cell.h"

namespace steradian::lights {

using Slots = std::span<std::uint32_t>;

// The tightest cell along the given axes about the points in those slots, at least one.
Cell cell_about(const SurfaceTile& tile, Slots slots, const std::array<Vec3f, 3>& axes, Vec3f eye);

// A cell along the mean normal and the directions in which the points spread.
Cell cell_about(const SurfaceTile& tile, Slots slots, Vec3f eye);

// Whether the points are of more than one surface, or of one that turns too far for one cone: by what they are to be divided first.
enum class Disorder { none, normals, places };
Disorder disorder_of(const SurfaceTile& tile, Slots slots, const Cell& cell);

// The slots in two parts, moved to the front and to the back: by the normals' most various coordinate, or across the cell's longest
// axis. Neither part is empty where the points differ in what they are divided by.
std::pair<Slots, Slots> divided_by_normals(const SurfaceTile& tile, Slots slots);
std::pair<Slots, Slots> divided_by_place(const SurfaceTile& tile, Slots slots, const Cell& cell);

// The nodes that a cell wants for lights of about that distance, so that they err by no more than `error`, as far as 64 go.
NodeGrid grid_for(Vec3f half, float distance, float error);

}  // namespace steradian::lights
