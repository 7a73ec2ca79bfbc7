// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sarn {

/// Everything this process publishes leaves at once (TCP_NODELAY), whatever its subscribers ask for.
///
/// Small messages otherwise wait for the subscriber's acknowledgement, up to 40 ms. Subscribers can ask for
/// it by their transport hints, but roscpp's own subscription to /clock and rosbag do not. Call it after the
/// first NodeHandle and before the first subscriber connects.
void sendAtOnce();

}  // namespace sarn
