// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sarn_navigation/scan_brake.h"

namespace sarn_navigation {

/// Where cmd_vel_mux finds its list of inputs at the start; exactly one is needed, the text wins.
struct MuxNodeParams {
  std::string yaml_cfg_file;  // path, format of config/mux.yaml
  std::string yaml_cfg_data;  // the same as text
  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("yaml_cfg_file", p.yaml_cfg_file);
    v("yaml_cfg_data", p.yaml_cfg_data);
  }
};

struct ScanBrakeNodeParams {
  ScanBrakeParams brake;
  std::string odom_frame = "odom";
  std::string base_frame = "base_footprint";
  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    ScanBrakeParams::visit(p.brake, v);
    v("odom_frame", p.odom_frame);
    v("base_frame", p.base_frame);
  }
};

}  // namespace sarn_navigation
