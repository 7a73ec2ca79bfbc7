// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

namespace mbf_msgs {

/// The outcomes of Noetic's release (0.4).
struct ExePathResult {
  enum : unsigned {
    SUCCESS = 0,
    CANCELED = 101,
    MISSED_PATH = 108,
    BLOCKED_PATH = 109,
    INVALID_PATH = 110,
    TF_ERROR = 111,
    NOT_INITIALIZED = 112,
    INTERNAL_ERROR = 114,
  };
};

}  // namespace mbf_msgs
