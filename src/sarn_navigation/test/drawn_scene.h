// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sarn_common/timed_costmap_view.h"

namespace sarn_navigation {

/// A costmap drawn by hand: rows from the largest y down, '#' lethal, 'i' inscribed, '?' unknown, '.' free;
/// cells of 0.25 m with the lower left corner at the origin. Layers are added as drawings, too ('#' 254,
/// digits cost * 25).
class DrawnScene {
 public:
  explicit DrawnScene(const std::vector<std::string>& rows, double resolution = 0.25) {
    view_.geometry = {static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), resolution, 0.0,
                      0.0};
    static_ = costs(rows);
    view_.static_costs = static_.data();
  }
  void addLayer(const std::vector<std::string>& rows) {
    layers_.push_back(std::make_unique<std::vector<std::uint8_t>>(costs(rows)));
    view_.layers.push_back(layers_.back()->data());
  }
  void addEmptyLayer() {
    layers_.push_back(std::make_unique<std::vector<std::uint8_t>>(static_.size(), std::uint8_t{0}));
    view_.layers.push_back(layers_.back()->data());
  }
  /// Forbids a disc [m] in one layer.
  void forbid(std::size_t layer, const Eigen::Vector2d& center, double radius) {
    for (int y = 0; y < view_.geometry.height; ++y) {
      for (int x = 0; x < view_.geometry.width; ++x) {
        if ((view_.geometry.center({x, y}) - center).norm() < radius) {
          (*layers_[layer])[view_.geometry.index({x, y})] = sarn::kLethalObstacle;
        }
      }
    }
  }
  [[nodiscard]] sarn::TimedCostmapView& view() { return view_; }
  [[nodiscard]] std::shared_ptr<const sarn::TimedCostmapView> shared() const {
    return {std::shared_ptr<void>(), &view_};
  }

 private:
  [[nodiscard]] static std::vector<std::uint8_t> costs(const std::vector<std::string>& rows) {
    std::vector<std::uint8_t> result;
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
      for (const char c : *row) {
        result.push_back(c == '#'               ? sarn::kLethalObstacle
                         : c == 'i'             ? sarn::kInscribedObstacle
                         : c == '?'             ? sarn::kNoInformation
                         : c >= '0' && c <= '9' ? static_cast<std::uint8_t>((c - '0') * 25)
                                                : sarn::kFreeSpace);
      }
    }
    return result;
  }

  std::vector<std::uint8_t> static_;
  std::vector<std::unique_ptr<std::vector<std::uint8_t>>> layers_;
  sarn::TimedCostmapView view_;
};

}  // namespace sarn_navigation
