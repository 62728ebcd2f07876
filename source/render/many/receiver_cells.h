// Cells about surface points, and their subdivision.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "render/many/cell.h"
#include "render/many/receiver_set.h"

namespace steradian::lights {

// The tightest cell with the given axes about points, at least one.
Cell cell_about(ReceiverSpan points, const std::array<Vec3f, 3>& axes, Vec3f eye);

// A cell along the mean normal and the directions in which the points spread.
Cell cell_about(ReceiverSpan points, Vec3f eye);

// Detects points of more than one surface, or of one that turns too far for one cone. The value says by what to divide them first.
enum class Disorder { none, normals, places };
Disorder disorder_of(ReceiverSpan points, const Cell& cell);

// Splits the points into a front and a back part: by the normals' most varied coordinate, or across the cell's longest axis. Neither part
// is empty if the points differ in that coordinate.
std::pair<ReceiverSpan, ReceiverSpan> divided_by_normals(ReceiverSpan points);
std::pair<ReceiverSpan, ReceiverSpan> divided_by_place(ReceiverSpan points, const Cell& cell);

// The nodes that a cell needs for lights at about that distance. The error is at most `error`, as far as 64 nodes allow.
NodeGrid grid_for(Vec3f half, float distance, float error);

}  // namespace steradian::lights
