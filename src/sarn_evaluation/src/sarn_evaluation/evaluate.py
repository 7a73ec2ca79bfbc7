# SPDX-License-Identifier: BSD-3-Clause
"""All metrics of one episode. None means "no data": the bag does not say."""

from __future__ import annotations

import dataclasses
from typing import Dict, List, Optional, Union

import numpy as np

from sarn_evaluation.episode import Episode, PersonTrack, RobotTrack
from sarn_evaluation.geodesic import path_length as polyline_length
from sarn_evaluation.geodesic import shortest_path
from sarn_evaluation.metrics import forecast, motion, outcome, safety, social
from sarn_evaluation.metrics.contacts import Cause, Contact, events, judge
from sarn_evaluation.occupancy import distances_to_obstacles

Value = Union[float, int, bool, None]


@dataclasses.dataclass(frozen=True)
class EvaluationParams:
    """What the metrics mean by near, far and in time."""

    goal_tolerance: float = 0.3  # [m]
    preferred_speed: float = 0.5  # [m/s] of the robot, for the time ratio
    progress_step: float = 0.3  # [m] failure to progress: no such step
    progress_time: float = 20.0  # [s] within this time
    smoothing_interval: float = 0.1  # [s] derivatives are taken between samples this far apart
    reaction_time: float = 0.2  # [s] stopping margin
    deceleration: float = 1.0  # [m/s^2] stopping margin
    near_miss: float = 0.1  # [m] hull distance
    compliance_distance: float = 0.5  # [m] space compliance, hull distance
    prediction_horizon: float = 5.0  # [s] predicted separation
    pet_limit: float = 1.5  # [s] crossing this shortly ahead of somebody is cutting in


@dataclasses.dataclass(frozen=True)
class JudgedContact:
    """A contact event and who caused it."""

    contact: Contact
    cause: Cause


@dataclasses.dataclass
class _Around:
    """The people at the robot's sample times, one row a person; NaN where unknown."""

    offset: np.ndarray  # (P, N, 2) person minus robot [m]
    velocity: np.ndarray  # (P, N, 2) relative [m/s]
    person_velocity: np.ndarray  # (P, N, 2) [m/s]
    radii: np.ndarray  # (P, 1) sum of both radii [m]
    hull: np.ndarray  # (P, N) hull distance, not below 0 [m]
    nearest: np.ndarray  # (N,) hull distance to the nearest person, inf when nobody is there [m]


def _absent_is_far(distance: np.ndarray) -> np.ndarray:
    """NaN (nobody there) as inf."""
    return np.where(np.isnan(distance), np.inf, distance)


def _around(track: RobotTrack, people: List[PersonTrack], robot_radius: float) -> Optional[_Around]:
    if not people or len(track.time) < 2:
        return None
    states = [person.at(track.time) for person in people]
    position = np.array([state[0] for state in states])
    velocity = np.array([state[1] for state in states])
    radii = np.array([[person.radius + robot_radius] for person in people])
    offset = position - track.position
    hull = np.maximum(np.hypot(offset[..., 0], offset[..., 1]) - radii, 0.0)
    nearest = _absent_is_far(hull).min(axis=0)
    if not np.isfinite(nearest).any():
        return None
    return _Around(offset, velocity - track.velocity, velocity, radii, hull, nearest)


def judged_contacts(episode: Episode) -> Optional[List[JudgedContact]]:
    """Contact events with their causes; None when the bag has no contacts topic and no ground truth."""
    if episode.contacts is None:
        return None
    judged = []
    for contact in events(episode.contacts):
        at = min(int(np.searchsorted(episode.robot.time, contact.time)), len(episode.robot.time) - 1)
        judged.append(JudgedContact(contact, judge(contact, episode.occupancy, episode.robot.position[at])))
    return judged


def _reference(episode: Episode, track: RobotTrack) -> Optional[List[np.ndarray]]:
    """Shortest paths from the start through the goals."""
    if episode.occupancy is None or not episode.goals or len(track.time) == 0:
        return None
    paths, here = [], track.position[0]
    for goal in episode.goals:
        there = np.array(goal.pose[:2])
        path = shortest_path(episode.occupancy, here, there, episode.robot_radius)
        if path is None:
            return None
        paths.append(path)
        here = there
    return paths


def goals_reached(episode: Episode, tolerance: float) -> int:
    """Goals the navigator reports as reached while the robot is within the tolerance [m] of them."""
    count = 0
    for goal in episode.goals:
        if goal.succeeded and goal.ended is not None:
            part = episode.robot.between(goal.sent, goal.ended)
            count += outcome.reached(part.position, np.array(goal.pose[:2]), tolerance)
    return count


def _goals_total(episode: Episode) -> int:
    """As many as the scenario has, not only as many as were sent."""
    sent = len(episode.goals)
    return max(sent, int(episode.result["goals_total"])) if episode.result else sent


def _outcome(episode: Episode, track: RobotTrack, p: EvaluationParams) -> Dict[str, Value]:
    judged = judged_contacts(episode)
    reached, total = goals_reached(episode, p.goal_tolerance), _goals_total(episode)
    all_goals = total > 0 and reached == total
    by_robot = None if judged is None else sum(j.cause.robot for j in judged)
    stuck: Optional[float] = None
    for goal in episode.goals:
        part = track.between(goal.sent, track.time[-1] if goal.ended is None else goal.ended)
        distance = np.hypot(*(part.position - np.array(goal.pose[:2])).T)
        longest = outcome.longest_time_without_progress(part.time, distance, p.progress_step)
        if longest is not None:
            stuck = longest if stuck is None else max(stuck, longest)
    return {
        "success": all_goals and not by_robot,
        "all_goals_reached": all_goals,
        "goals_reached": reached,
        "goals_total": total,
        "timeout": None if episode.result is None else episode.result["outcome"] == "timeout",
        "collision": None if by_robot is None else by_robot > 0,
        "longest_time_without_progress_s": stuck,
        "failure_to_progress": None if stuck is None else stuck > p.progress_time,
    }


def _efficiency(episode: Episode, track: RobotTrack, success: bool, p: EvaluationParams) -> Dict[str, Value]:
    length = motion.path_length(track.position)
    thin = track.thinned(p.smoothing_interval)
    reference = _reference(episode, track)
    shortest = None if reference is None else sum(polyline_length(path) for path in reference)
    duration = float(track.time[-1] - track.time[0])
    irregularity = None
    if reference is not None and length is not None:
        turning = sum(motion.polyline_turning(path) for path in reference)
        irregularity = motion.path_irregularity(track.yaw, length, turning)
    known = shortest is not None and shortest > 0.0 and length is not None
    return {
        "duration_s": duration,
        "path_length_m": length,
        "shortest_path_m": shortest,
        "path_length_ratio": length / shortest if known else None,  # type: ignore[operator]
        "time_ratio": duration / (shortest / p.preferred_speed) if known else None,  # type: ignore[operator]
        "spl": outcome.spl(success, shortest, length),
        "stalled_time_s": motion.stalled_time(track.time, track.twist[:, 0], track.twist[:, 1]),
        "mean_speed_mps": None if not length or duration <= 0.0 else length / duration,
        "heading_change_rad": motion.heading_change(track.yaw),
        "path_irregularity_rad_per_m": irregularity,
        "mean_curvature_per_m": motion.mean_curvature(thin.position, thin.yaw),
    }


def _smoothness(episode: Episode, track: RobotTrack, p: EvaluationParams) -> Dict[str, Value]:
    thin = track.thinned(p.smoothing_interval)
    v, omega = thin.twist[:, 0], thin.twist[:, 1]
    acceleration = motion.rms_and_max(thin.time, v, 1)
    jerk = motion.rms_and_max(thin.time, v, 2)
    angular = motion.rms_and_max(thin.time, omega, 1)
    values: Dict[str, Value] = {
        "acceleration_rms_mps2": acceleration[0],
        "acceleration_max_mps2": acceleration[1],
        "jerk_rms_mps3": jerk[0],
        "jerk_max_mps3": jerk[1],
        "angular_acceleration_rms_radps2": angular[0],
        "angular_acceleration_max_radps2": angular[1],
        "log_dimensionless_jerk": motion.log_dimensionless_jerk(thin.time, v),
    }
    c = episode.commands
    known = c is not None and len(c) > 1
    values["turn_reversals_per_s"] = (
        motion.sign_reversals_per_second(c[:, 0], c[:, 2], 0.05) if known else None  # type: ignore[index]
    )
    for column, name in ((1, "speed_tracking_error_rms_mps"), (2, "turn_tracking_error_rms_radps")):
        values[name] = (
            motion.tracking_error(track.time, track.twist[:, column - 1], c[:, 0], c[:, column])  # type: ignore[index]
            if known
            else None
        )
    return values


def _contacts(episode: Episode) -> Dict[str, Value]:
    judged = judged_contacts(episode)
    if judged is None:
        return dict.fromkeys(("contacts_by_robot", "contacts_by_people", "contacts_with_walls"))
    return {
        "contacts_by_robot": sum(j.cause.robot for j in judged),
        "contacts_by_people": sum(not j.cause.robot for j in judged),
        "contacts_with_walls": sum(j.contact.with_wall for j in judged),
    }


def _clearance(episode: Episode, track: RobotTrack) -> Dict[str, Value]:
    if episode.occupancy is None:
        return {"static_clearance_min_m": None, "static_clearance_mean_m": None}
    thin = track.thinned(0.1)
    clearance = distances_to_obstacles(episode.occupancy, thin.position) - episode.robot_radius
    if not np.isfinite(clearance).all():
        return {"static_clearance_min_m": None, "static_clearance_mean_m": None}
    return {
        "static_clearance_min_m": float(clearance.min()),
        "static_clearance_mean_m": float(clearance.mean()),
    }


_SAFETY_KEYS = (
    "person_distance_min_m", "person_distance_mean_m", "speed_at_person_distance_min_mps", "near_misses",
    "ttc_min_s", "ttc_below_1.5_s_share", "ttc_below_3_s_share", "predicted_separation_min_m", "pet_min_s",
    "stopping_margin_min_m",
)  # fmt: skip


def _safety(
    episode: Episode, track: RobotTrack, around: Optional[_Around], p: EvaluationParams
) -> Dict[str, Value]:
    if around is None:
        return dict.fromkeys(_SAFETY_KEYS)
    seen = np.isfinite(around.nearest)
    closest = int(around.nearest.argmin())
    ttc = _absent_is_far(safety.time_to_collision(around.offset, around.velocity, around.radii)).min(axis=0)
    separation = safety.predicted_separation(
        around.offset, around.velocity, around.radii, p.prediction_horizon
    )
    near = safety.episodes_below(track.time, around.nearest, p.near_miss)
    touched = safety.episodes_below(track.time, around.nearest, 1e-9)
    pets = [_pet(track, person, episode.robot_radius) for person in episode.people]
    ahead = around.offset[..., 0] * track.velocity[:, 0] + around.offset[..., 1] * track.velocity[:, 1] > 0.0
    in_front = _absent_is_far(np.where(ahead, around.hull, np.inf)).min(axis=0)
    margin = safety.stopping_margin(in_front, np.abs(track.twist[:, 0]), p.reaction_time, p.deceleration)
    moving = np.isfinite(margin) & (np.abs(track.twist[:, 0]) > motion.STANDING[0])
    met = [abs(pet) for pet in pets if pet is not None]
    values = (
        float(around.nearest.min()), float(around.nearest[seen].mean()), float(abs(track.twist[closest, 0])),
        len(near) - len(touched), float(ttc.min()) if np.isfinite(ttc).any() else None,
        social.share_of_time(track.time, ttc < 1.5), social.share_of_time(track.time, ttc < 3.0),
        float(np.nanmin(separation)), min(met) if met else None,
        float(margin[moving].min()) if moving.any() else None,
    )  # fmt: skip
    return dict(zip(_SAFETY_KEYS, values))


def _pet(track: RobotTrack, person: PersonTrack, robot_radius: float) -> Optional[float]:
    thin = track.thinned(0.1)
    chosen = (person.time >= track.time[0] - 5.0) & (person.time <= track.time[-1])
    moving = chosen & (np.hypot(person.velocity[:, 0], person.velocity[:, 1]) > 0.1)
    reach = robot_radius + person.radius
    return safety.post_encroachment(
        thin.time, thin.position, person.time[moving], person.position[moving], reach
    )


def passings(track: RobotTrack, people: List[PersonTrack]) -> List[social.Passing]:
    """How the robot passed whom."""
    thin = track.thinned(0.1)
    found = []
    for person in people:
        position, velocity = person.at(thin.time)
        one = social.passing(thin.time, thin.position, thin.velocity, position, velocity)
        if one is not None:
            found.append(one)
    return found


_SOCIAL_KEYS = (
    "intimate_intrusion_share", "intimate_intrusions", "intimate_intrusion_depth_time_ms",
    "personal_intrusion_share", "personal_intrusions", "personal_intrusion_depth_time_ms",
    "space_compliance", "gaussian_cost_integral_s", "mean_speed_in_personal_space_mps",
    "robot_share_of_closing_speed", "passings", "passing_side_compliance", "cut_in_events",
    "group_space_time_s", "group_splits",
)  # fmt: skip


def _social(
    episode: Episode, track: RobotTrack, around: Optional[_Around], p: EvaluationParams
) -> Dict[str, Value]:
    if around is None:
        return dict.fromkeys(_SOCIAL_KEYS)
    time, nearest = track.time, around.nearest
    values: Dict[str, Value] = {}
    for name, threshold in (("intimate", social.INTIMATE), ("personal", social.PERSONAL)):
        values[f"{name}_intrusion_share"] = social.share_of_time(time, nearest < threshold)
        values[f"{name}_intrusions"] = len(safety.episodes_below(time, nearest, threshold))
        values[f"{name}_intrusion_depth_time_ms"] = social.depth_time(time, nearest, threshold)
    cost = [social.asymmetric_gaussian(-o, v) for o, v in zip(around.offset, around.person_velocity)]
    total = np.nan_to_num(np.array(cost)).sum(axis=0)
    inside = nearest < social.PERSONAL
    met = passings(track, episode.people)
    sides = [passing.compliant for passing in met if passing.compliant is not None]
    values["space_compliance"] = social.share_of_time(time, nearest >= p.compliance_distance)
    values["gaussian_cost_integral_s"] = float((total * motion.durations(time)).sum())
    values["mean_speed_in_personal_space_mps"] = (
        float(np.abs(track.twist[inside, 0]).mean()) if inside.any() else None
    )
    values["robot_share_of_closing_speed"] = _robot_share(track, around)
    values["passings"] = len(met)
    values["passing_side_compliance"] = float(np.mean(sides)) if sides else None
    values["cut_in_events"] = _cut_ins(episode, track, p)
    values.update(_groups(episode, track))
    return values


def _robot_share(track: RobotTrack, around: _Around) -> Optional[float]:
    """Whose doing intimate distances are: the robot's part of the closing speed while within them, 0..1."""
    rows, columns = np.nonzero(around.hull < social.INTIMATE)
    if len(rows) == 0:
        return None
    offset = around.offset[rows, columns]
    towards = offset / np.maximum(np.hypot(*offset.T), 1e-9)[:, None]
    by_robot = np.maximum((track.velocity[columns] * towards).sum(axis=1), 0.0)
    by_person = np.maximum(-(around.person_velocity[rows, columns] * towards).sum(axis=1), 0.0)
    total = by_robot.sum() + by_person.sum()
    return float(by_robot.sum() / total) if total > 1e-9 else None


def _cut_ins(episode: Episode, track: RobotTrack, p: EvaluationParams) -> int:
    """How often the robot used a place shortly before a person who crosses its way."""
    count = 0
    for person in episode.people:
        met = passings(track, [person])
        pet = _pet(track, person, episode.robot_radius)
        crossing = any(passing.encounter is social.Encounter.CROSSING for passing in met)
        count += crossing and pet is not None and -p.pet_limit < pet < 0.0
    return count


def _groups(episode: Episode, track: RobotTrack) -> Dict[str, Value]:
    names = sorted({person.group for person in episode.people if person.group})
    if not names:
        return {"group_space_time_s": None, "group_splits": None}
    time_inside, splits = 0.0, 0
    for name in names:
        members = [person.at(track.time)[0] for person in episode.people if person.group == name]
        seconds, crossings = social.group_space(track.time, track.position, members, episode.robot_radius)
        time_inside += seconds or 0.0
        splits += crossings
    return {"group_space_time_s": time_inside, "group_splits": splits}


def _system(episode: Episode) -> Dict[str, Value]:
    times = episode.planning_times
    ade, fde, horizon = forecast.displacement_errors(episode.predictions, episode.people)
    known = times is not None and len(times) > 0
    return {
        "planning_time_median_s": float(np.median(times)) if known else None,  # type: ignore[arg-type]
        "planning_time_p99_s": float(np.percentile(times, 99)) if known else None,  # type: ignore[arg-type]
        "planning_deadline_misses": episode.deadline_misses,
        "prediction_ade_m": ade,
        "prediction_fde_m": fde,
        "prediction_horizon_s": horizon,
    }


def evaluate(episode: Episode, params: EvaluationParams = EvaluationParams()) -> Dict[str, Dict[str, Value]]:
    """All metrics by group: outcome, efficiency, smoothness, safety, social, system."""
    track = episode.driven()
    if len(track.time) < 2:
        raise ValueError(f"the robot's track has {len(track.time)} poses between the first goal and the end")
    around = _around(track, episode.people, episode.robot_radius)
    ending = _outcome(episode, track, params)
    return {
        "outcome": ending,
        "efficiency": _efficiency(episode, track, bool(ending["success"]), params),
        "smoothness": _smoothness(episode, track, params),
        "safety": {
            **_contacts(episode),
            **_clearance(episode, track),
            **_safety(episode, track, around, params),
        },
        "social": _social(episode, track, around, params),
        "system": _system(episode),
    }
