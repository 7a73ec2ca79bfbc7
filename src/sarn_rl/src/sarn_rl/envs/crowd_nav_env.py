# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark as a Gymnasium environment."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

import gymnasium
import numpy as np
from gymnasium import spaces

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.envs.cases import SPLIT_SIZES, case_seed, make_case
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.worlds import Outcome, Worlds
from sarn_rl.joint_state import JointState
from sarn_rl.lookahead import Lookahead
from sarn_rl.observation import Observation
from sarn_rl.reward import RewardParams

ENVIRONMENT_ID = "CrowdNav-v0"


class CrowdNavEnv(gymnasium.Env):
    """A robot crosses a crowd.

    Observation: a dict of float32 arrays in the robot's frame, x towards the goal (see observation.py):
    `robot` (S,), `people` (P, 7), and `present` (P,) int8.
    Action: number of an action of the action set; 0 is to stop.
    Reward: see reward.py.
    Start: a case of the split. `reset(options={"case": k})` takes case k; otherwise cases follow one another
    in the training split and are drawn at random in the others. `reset(seed=...)` begins anew.
    End: terminated on success and collision, truncated at the time limit. `info["outcome"]` is running,
    success, collision or timeout, `info["min_separation"]` [m] the smallest rim to rim distance of the step.

    Args:
        params: of the world.
        actions: the action set.
        reward: what steps are worth.
        split: training, validation or test.
        render_mode: None or rgb_array.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 4}  # noqa: RUF012

    def __init__(
        self,
        params: Optional[EnvironmentParams] = None,
        actions: Optional[ActionParams] = None,
        reward: Optional[RewardParams] = None,
        split: str = "training",
        render_mode: Optional[str] = None,
    ) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode: '{render_mode}' is not rgb_array")
        case_seed(split, 0)
        self.render_mode = render_mode
        self._params = params or EnvironmentParams()
        actions = actions or ActionParams()
        reward = reward or RewardParams()
        self._split = split
        # The discount does not matter here: values belong to policies.
        self._lookahead = Lookahead(actions, reward, 0.9, self._params.time_step)
        self._worlds = Worlds(self._params, reward, actions.kinematics, 1)
        self._next_case = 0
        self._over = True
        people = self._params.cases.people
        features = 5 if actions.kinematics is Kinematics.HOLONOMIC else 6
        self.observation_space = spaces.Dict(
            {
                "robot": spaces.Box(-np.inf, np.inf, (features,), np.float32),
                "people": spaces.Box(-np.inf, np.inf, (people, 7), np.float32),
                "present": spaces.Box(0, 1, (people,), np.int8),
            }
        )
        self._begin(0)
        self.action_space = spaces.Discrete(self._lookahead.actions(self._worlds.state).shape[1])
        self._over = True

    @property
    def state(self) -> JointState:
        """The world as policies take it, in the world's frame."""
        return self._worlds.state

    def reset(
        self, *, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None
    ) -> Tuple[Dict[str, np.ndarray], Dict[str, Any]]:
        super().reset(seed=seed)
        if seed is not None:
            self._next_case = int(self.np_random.integers(1_000_000)) if self._split == "training" else 0
        case = (options or {}).get("case")
        self._begin(self._choose_case() if case is None else int(case))
        return self._observe(), {"outcome": "running", "case": self._case, "time": 0.0}

    def step(self, action: int) -> Tuple[Dict[str, np.ndarray], float, bool, bool, Dict[str, Any]]:
        if self._over:
            raise RuntimeError("step: the episode is over; call reset first")
        chosen = self._lookahead.actions(self._worlds.state)[:, int(action)]
        steps = self._worlds.step(chosen)
        outcome = Outcome(steps.outcomes[0])
        self._over = outcome is not Outcome.RUNNING
        info = {
            "outcome": outcome.name.lower(),
            "case": self._case,
            "time": float(self._worlds.times[0]),
            "min_separation": float(steps.min_separation[0]),
        }
        terminated = outcome in (Outcome.SUCCESS, Outcome.COLLISION)
        return self._observe(), float(steps.rewards[0]), terminated, outcome is Outcome.TIMEOUT, info

    def render(self) -> Optional[np.ndarray]:  # type: ignore[override]
        if self.render_mode is None:
            return None
        from sarn_rl.envs.drawing import draw_frame

        return draw_frame(self._worlds.state, float(self._worlds.times[0]))

    def _choose_case(self) -> int:
        size = SPLIT_SIZES.get(self._split)
        if size is not None:
            return int(self.np_random.integers(size))
        self._next_case += 1
        return self._next_case - 1

    def _begin(self, number: int) -> None:
        seed = case_seed(self._split, number)
        self._worlds.begin([0], [make_case(self._params.cases, seed)], [seed])
        self._case, self._over = number, False

    def _observe(self) -> Dict[str, np.ndarray]:
        seen: Observation = self._lookahead.encode(self._worlds.state)
        return {"robot": seen.robot[0], "people": seen.people[0], "present": seen.present[0].astype(np.int8)}


def register() -> None:
    """Makes gymnasium.make("CrowdNav-v0") work."""
    if ENVIRONMENT_ID not in gymnasium.registry:
        gymnasium.register(id=ENVIRONMENT_ID, entry_point=f"{__name__}:CrowdNavEnv")
