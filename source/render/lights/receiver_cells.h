// Cells about surface points, and how they are divided.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "render/lights/cell.h"
#include "render/lights/receiver_set.h"

namespace steradian::lights {

// The tightest cell along the given axes about points, at least one.
Cell cell_about(ReceiverSpan points, const std::array<Vec3f, 3>& axes, Vec3f eye);

// A cell along the mean normal and the directions in which the points spread.
Cell cell_about(ReceiverSpan points, Vec3f eye);

// Whether the points are of more than one surface, or of one that turns too far for one cone: by what they are to be divided first.
enum class Disorder { none, normals, places };
Disorder disorder_of(ReceiverSpan points, const Cell& cell);

// The points in two parts, moved to the front and to the back: by the normals' most various coordinate, or across the cell's longest
// axis. Neither part is empty where the points differ in what they are divided by.
std::pair<ReceiverSpan, ReceiverSpan> divided_by_normals(ReceiverSpan points);
std::pair<ReceiverSpan, ReceiverSpan> divided_by_place(ReceiverSpan points, const Cell& cell);

// The nodes that a cell wants for lights of about that distance, so that they err by no more than `error`, as far as 64 go.
NodeGrid grid_for(Vec3f half, float distance, float error);

}  // namespace steradian::lights
