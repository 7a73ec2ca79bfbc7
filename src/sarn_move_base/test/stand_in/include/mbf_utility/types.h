// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <tf2_ros/buffer.h>

using TF = tf2_ros::Buffer;
