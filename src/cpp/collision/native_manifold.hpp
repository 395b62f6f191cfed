#pragma once

#include <vector>

#include "collision/native_geometry.hpp"

namespace pydart2::native {

/// A contact point in the frame of the first of two shapes.
struct Point
{
  Vector at; ///< Midway between the surfaces.
  Vector normal; ///< From the second to the first.
  double depth;
  std::uint32_t feature;
};
using Points = std::vector<Point>;

/// The part of an edge or face within a polygon, seen along the polygon's normal, as it lies below the polygon's plane.
/// `radius` is put around the edge or face, and `other_radius` around the polygon. Adds points that are no farther above
/// than `margin`; they have the normal `sign` times the polygon's.
void add_clipped(
    const Feature& polygon, double polygon_radius, const Feature& other, double other_radius, double sign, double margin,
    Points& points);

/// The points of an edge or face, or one, below a plane.
void add_below(
    const Vector& normal, double offset, const Feature& other, double radius, double sign, double margin, Points& points);

/// Whether a polygon holds a point, seen along its normal.
bool holds(const Feature& polygon, const Vector& point, double slack);

/// Leaves of the points from `begin` on at most four: the deepest, and those that span the most area with it.
void keep_four(Points& points, std::size_t begin, double size);

} // namespace pydart2::native
