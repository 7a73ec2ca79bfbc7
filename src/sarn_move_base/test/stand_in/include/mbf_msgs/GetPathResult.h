// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

namespace mbf_msgs {

/// The outcomes of Noetic's release (0.4).
struct GetPathResult {
  enum : unsigned {
    SUCCESS = 0,
    CANCELED = 51,
    INVALID_START = 52,
    INVALID_GOAL = 53,
    NO_PATH_FOUND = 54,
    TF_ERROR = 57,
    NOT_INITIALIZED = 58,
    INTERNAL_ERROR = 60,
    OUT_OF_MAP = 61,
  };
};

}  // namespace mbf_msgs
