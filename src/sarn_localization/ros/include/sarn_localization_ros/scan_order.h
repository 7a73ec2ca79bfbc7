// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <string>

namespace sarn_localization {

/// What a stamp says about a scan.
enum class ScanOrder { kNext, kOutOfOrder, kFuture, kClockJumpedBack };

/// Watches the stamps of a stream of scans.
class ScanOrderGuard {
 public:
  /// A stamp counts as from the future when it is more than `patience` [s] after now.
  explicit ScanOrderGuard(double patience) : patience_(patience) {}

  /// kNext takes the stamp as the newest; after kClockJumpedBack the stream begins anew.
  ScanOrder check(const ros::Time& stamp, const ros::Time& now) {
    if (now + ros::Duration(patience_) < last_now_) {
      last_now_ = now;
      newest_ = ros::Time();
      return ScanOrder::kClockJumpedBack;
    }
    last_now_ = now;
    if (stamp > now + ros::Duration(patience_)) return ScanOrder::kFuture;
    if (stamp <= newest_) return ScanOrder::kOutOfOrder;
    newest_ = stamp;
    return ScanOrder::kNext;
  }

 private:
  double patience_;  // [s]
  ros::Time newest_, last_now_;
};

}  // namespace sarn_localization
