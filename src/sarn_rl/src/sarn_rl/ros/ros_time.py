# SPDX-License-Identifier: BSD-3-Clause
"""ROS time to the nanosecond, and sleeping until a time rather than for a duration."""

from __future__ import annotations

import rospy
from rospy.rostime import get_rostime_cond, is_wallclock, wallsleep

LONGEST = 0.3  # [s] wall: how soon a shutdown is noticed


def to_time(seconds: float) -> rospy.Time:
    """To the nearest nanosecond; from_sec cuts the rest off."""
    return rospy.Time(0, round(1e9 * seconds))


def sleep_until(due: rospy.Time, begin: rospy.Time) -> rospy.Time:
    """Returns the time: `due` or later; earlier when the clock jumped back before `begin`, or at shutdown.

    rospy.sleep counts from the moment it is called: a clock that has just moved on would make it sleep too
    long, and a world that waits for this node would wait with it.
    """
    while not rospy.is_shutdown():
        if is_wallclock():
            wallsleep(min(LONGEST, max(0.0, (due - rospy.get_rostime()).to_sec())))
        else:
            with get_rostime_cond():
                if begin <= rospy.get_rostime() < due:
                    get_rostime_cond().wait(LONGEST)
        now = rospy.get_rostime()
        if now >= due or now < begin:
            break
    return rospy.get_rostime()
