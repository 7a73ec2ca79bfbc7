# SPDX-License-Identifier: BSD-3-Clause
"""Tells a simulation that runs as fast as its nodes keep up how far this node has come (ARCHITECTURE.md)."""

from __future__ import annotations

import threading
import time

import rospy
from std_msgs.msg import Time

IDLE = 0.2  # [s] wall: nothing for this long means that nothing is on its way


class LockstepAcknowledger:
    """The Python counterpart of sarn_common's.

    A node to which nothing comes has come as far as the clock; without that, a world that waits for the node
    and a node that waits for the world would stand still for ever.

    Args:
        topic: of this node.
        behind: [s] less than what has been processed is told. The world is never more than its lockstep_slack
            ahead of that; with slack - period it waits at each cycle until the command is out.
    """

    def __init__(self, topic: str, behind: float) -> None:
        self._behind = rospy.Duration.from_sec(max(0.0, behind))
        self._publisher = rospy.Publisher(topic, Time, queue_size=10, tcp_nodelay=True)
        self._last = time.monotonic()
        self._busy = False
        if rospy.get_param("/use_sim_time", False):
            threading.Thread(target=self._watch, daemon=True).start()

    def begin(self) -> None:
        """From now on the node is at work, however long it takes."""
        self._busy = True

    def acknowledge(self, processed: rospy.Time) -> None:
        """Everything up to this simulated time has been processed."""
        self._last = time.monotonic()
        self._busy = False
        if processed.to_sec() > self._behind.to_sec():
            self._publisher.publish(processed - self._behind)

    def _watch(self) -> None:
        while not rospy.is_shutdown():
            time.sleep(0.5 * IDLE)
            if self._busy or time.monotonic() - self._last <= IDLE:
                continue
            try:
                self.acknowledge(rospy.get_rostime())
            except rospy.ROSException:  # shut down meanwhile
                return
