#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How long people take from the sensor to /people, seen from beside a run: one JSON line when interrupted."""

from __future__ import annotations

import json
import statistics
import time
from typing import Dict, List

import rospy
from people_msgs.msg import People
from sensor_msgs.msg import CameraInfo, LaserScan

MEMORY = 300  # stamps


class PeopleLatency:
    """Times [s] to /people from a sensor's message with the same stamp, and from the stamp itself."""

    def __init__(self) -> None:
        # The camera's calibration goes out with its image, and costs nothing to hear.
        sources = {"sensor": ("/camera/depth/camera_info", CameraInfo), "node": ("/scan", LaserScan)}
        self._arrivals: Dict[str, Dict[int, float]] = {name: {} for name in sources}
        self._latencies: Dict[str, List[float]] = {name: [] for name in [*sources, "stamp"]}
        for name, (topic, kind) in sources.items():
            rospy.Subscriber(topic, kind, self._on_source, callback_args=name, tcp_nodelay=True)
        rospy.Subscriber("/people", People, self._on_people, tcp_nodelay=True)

    def _on_source(self, message, name: str) -> None:
        arrivals = self._arrivals[name]
        arrivals[message.header.stamp.to_nsec()] = time.monotonic()
        if len(arrivals) > MEMORY:
            del arrivals[min(arrivals)]

    def _on_people(self, message: People) -> None:
        now = time.monotonic()
        stamp = message.header.stamp
        came = {name: arrivals.get(stamp.to_nsec()) for name, arrivals in self._arrivals.items()}
        if None in came.values():  # only predicted, or from before this began to listen
            return
        for name, then in came.items():
            self._latencies[name].append(now - then)
        self._latencies["stamp"].append((rospy.Time.now() - stamp).to_sec())

    def figures(self) -> Dict[str, float]:
        """Median and 95th percentile [ms] of each; empty without people messages."""
        result: Dict[str, float] = {}
        for name, seconds in self._latencies.items():
            if len(seconds) < 20:
                continue
            result[f"{name}.median"] = 1000.0 * statistics.median(seconds)
            result[f"{name}.p95"] = 1000.0 * statistics.quantiles(seconds, n=20)[-1]
        return result


if __name__ == "__main__":
    rospy.init_node("people_latency", anonymous=True)
    latency = PeopleLatency()
    rospy.spin()
    print(json.dumps(latency.figures()), flush=True)
