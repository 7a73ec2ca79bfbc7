// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "social_costmap/layer.h"
#include "social_costmap/social_layers.h"

namespace social_costmap {

/// People as one layer of an ordinary costmap, where they are now: for planners that know no time (the
/// baseline to compare with, and costmap_2d). The same costs as time layer 0.
class SocialLayer : public Layer {
 public:
  explicit SocialLayer(SocialParams params, std::string name = "social");

  /// People as predicted [master's frame]; shown from the next update on.
  void setPrediction(sarn::PeoplePrediction prediction);

  void matchSize(const sarn::GridGeometry& geometry) override;
  void reset() override;
  void updateBounds(const UpdateContext& context, CellRect& bounds) override;
  void updateCosts(CostGrid& master, const CellRect& bounds) override;

 private:
  [[nodiscard]] CellRect painted() const;

  SocialLayers layers_;
  sarn::PeoplePrediction prediction_;
};

}  // namespace social_costmap
