// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace lattice_planner {

/// The robot's outline in its base frame [m]. Without corners the robot is round: whoever inflates the
/// costmap knows its radius.
struct Footprint {
  std::vector<Eigen::Vector2d> corners;  // in order, either way round; base_link's origin lies inside
  double inscribed_radius = 0.0;         // [m] largest disc around the origin that it holds
  double circumscribed_radius = 0.0;     // [m] smallest disc around the origin that holds it

  [[nodiscard]] bool round() const { return corners.empty(); }
};

/// Throws std::invalid_argument that says what is wrong: fewer than three corners, a value that is not
/// finite, the origin outside. No corners at all: round.
[[nodiscard]] Footprint makeFootprint(std::vector<Eigen::Vector2d> corners);

/// From a list of [x, y] as costmap_2d's parameter `footprint` has it, "[[0.2, 0.1], [-0.2, 0.1], ...]";
/// empty text or "[]": round. Throws as makeFootprint().
[[nodiscard]] Footprint parseFootprint(const std::string& text);

/// The inverse of parseFootprint().
[[nodiscard]] std::string toString(const Footprint& footprint);

/// The convex hull of the footprint without all that lies within its inscribed radius of the hull's outside:
/// where the centre of an inscribed disc that slides inside the robot can be. The robot comes within r of a
/// point exactly if this comes within r + inscribed radius of it (for a convex robot), so that what is drawn
/// as a disc around a person for the *centre* of a robot of that radius holds for any shape.
[[nodiscard]] std::vector<Eigen::Vector2d> coreOf(const Footprint& footprint);

}  // namespace lattice_planner
