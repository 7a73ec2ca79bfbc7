// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common_ros/send_at_once.h"

#include <ros/connection_manager.h>
#include <ros/transport/transport_tcp.h>

namespace sarn {

void sendAtOnce() {
  // Accepted sockets inherit the option of the socket that listens.
  if (const auto& server = ros::ConnectionManager::instance()->getTCPServerTransport())
    server->setNoDelay(true);
}

}  // namespace sarn
