// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <geometry_msgs/Point.h>

#include <algorithm>
#include <boost/thread/recursive_mutex.hpp>
#include <cmath>
#include <vector>

namespace costmap_2d {

/// A grid of costs with a place in the world.
class Costmap2D {
 public:
  using mutex_t = boost::recursive_mutex;

  Costmap2D() = default;
  virtual ~Costmap2D() = default;
  Costmap2D(const Costmap2D&) = delete;
  Costmap2D& operator=(const Costmap2D&) = delete;

  void resizeMap(unsigned int size_x, unsigned int size_y, double resolution, double origin_x,
                 double origin_y) {
    size_x_ = size_x;
    size_y_ = size_y;
    resolution_ = resolution;
    origin_x_ = origin_x;
    origin_y_ = origin_y;
    cells_.assign(std::size_t{size_x} * size_y, default_value_);
  }
  void resetMap(unsigned int x0, unsigned int y0, unsigned int xn, unsigned int yn) {
    for (unsigned int y = y0; y < yn; ++y) {
      for (unsigned int x = x0; x < xn; ++x) setCost(x, y, default_value_);
    }
  }
  /// Moves the window by whole cells; what comes into it is empty.
  virtual void updateOrigin(double new_origin_x, double new_origin_y) {
    const int dx = static_cast<int>((new_origin_x - origin_x_) / resolution_);
    const int dy = static_cast<int>((new_origin_y - origin_y_) / resolution_);
    std::vector<unsigned char> old = cells_;
    resizeMap(size_x_, size_y_, resolution_, origin_x_ + dx * resolution_, origin_y_ + dy * resolution_);
    for (int y = 0; y < static_cast<int>(size_y_); ++y) {
      for (int x = 0; x < static_cast<int>(size_x_); ++x) {
        const bool was_inside = x + dx >= 0 && y + dy >= 0 && x + dx < static_cast<int>(size_x_) &&
                                y + dy < static_cast<int>(size_y_);
        if (was_inside) {
          setCost(static_cast<unsigned int>(x), static_cast<unsigned int>(y),
                  old[getIndex(static_cast<unsigned int>(x + dx), static_cast<unsigned int>(y + dy))]);
        }
      }
    }
  }

  unsigned char getCost(unsigned int mx, unsigned int my) const { return cells_[getIndex(mx, my)]; }
  void setCost(unsigned int mx, unsigned int my, unsigned char cost) { cells_[getIndex(mx, my)] = cost; }
  void mapToWorld(unsigned int mx, unsigned int my, double& wx, double& wy) const {
    wx = origin_x_ + (mx + 0.5) * resolution_;
    wy = origin_y_ + (my + 0.5) * resolution_;
  }
  bool worldToMap(double wx, double wy, unsigned int& mx, unsigned int& my) const {
    if (wx < origin_x_ || wy < origin_y_) return false;
    mx = static_cast<unsigned int>((wx - origin_x_) / resolution_);
    my = static_cast<unsigned int>((wy - origin_y_) / resolution_);
    return mx < size_x_ && my < size_y_;
  }
  void worldToMapEnforceBounds(double wx, double wy, int& mx, int& my) const {
    mx = clampedCell(wx, origin_x_, size_x_);
    my = clampedCell(wy, origin_y_, size_y_);
  }
  unsigned int getIndex(unsigned int mx, unsigned int my) const { return my * size_x_ + mx; }
  unsigned char* getCharMap() const { return const_cast<unsigned char*>(cells_.data()); }
  unsigned int getSizeInCellsX() const { return size_x_; }
  unsigned int getSizeInCellsY() const { return size_y_; }
  double getOriginX() const { return origin_x_; }
  double getOriginY() const { return origin_y_; }
  double getResolution() const { return resolution_; }
  void setDefaultValue(unsigned char value) { default_value_ = value; }
  mutex_t* getMutex() { return &mutex_; }

 private:
  int clampedCell(double w, double origin, unsigned int size) const {
    const double cell = std::floor((w - origin) / resolution_);
    return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(size - 1)));
  }

  mutex_t mutex_;
  unsigned int size_x_ = 0;
  unsigned int size_y_ = 0;
  double resolution_ = 1.0;
  double origin_x_ = 0.0;
  double origin_y_ = 0.0;
  unsigned char default_value_ = 0;
  std::vector<unsigned char> cells_;
};

}  // namespace costmap_2d
