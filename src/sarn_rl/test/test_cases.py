# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import numpy as np
import pytest

from sarn_rl.envs.cases import CaseParams, case_seed, make_case


def test_first_person_of_a_case_follows_from_the_seed() -> None:
    random = np.random.RandomState(1003)
    angle, noise_x, noise_y = random.random_sample(), random.random_sample(), random.random_sample()
    x = 4.0 * np.cos(2.0 * np.pi * angle) + (noise_x - 0.5)
    y = 4.0 * np.sin(2.0 * np.pi * angle) + (noise_y - 0.5)
    case = make_case(CaseParams(people=1), case_seed("test", 3))
    assert case.people_start[0] == pytest.approx([x, y])
    assert case.people_goal[0] == pytest.approx([-x, -y])
    assert case.robot_start.tolist() == [0.0, -4.0] and case.robot_goal.tolist() == [0.0, 4.0]


@pytest.mark.parametrize("crowd", ["circle_crossing", "square_crossing", "mixture"])
def test_starts_and_goals_are_clear_of_one_another(crowd: str) -> None:
    for seed in range(30):
        case = make_case(CaseParams(crowd=crowd, people=8), seed)
        for points in (
            np.vstack([case.robot_start, case.people_start]),
            np.vstack([case.robot_goal, case.people_goal]),
        ):
            gaps = np.linalg.norm(points[:, None] - points[None], axis=-1) + 10.0 * np.eye(len(points))
            assert gaps.min() >= 0.8 - 1e-9


def test_square_crossing_leads_to_the_other_side() -> None:
    for seed in range(20):
        case = make_case(CaseParams(crowd="square_crossing", people=6), seed)
        assert (case.people_start[:, 0] * case.people_goal[:, 0] < 0.0).all()
        assert np.abs(case.people_start).max() <= 5.0


def test_same_seed_same_case_and_other_seed_other_case() -> None:
    params = CaseParams(people=5)
    assert np.array_equal(make_case(params, 8).people_start, make_case(params, 8).people_start)
    assert not np.array_equal(make_case(params, 8).people_start, make_case(params, 9).people_start)


def test_splits_do_not_overlap_and_end() -> None:
    assert [case_seed("validation", 99), case_seed("test", 0), case_seed("test", 499)] == [99, 1000, 1499]
    assert case_seed("training", 10_000) == 12_000
    for split, number in (("validation", 100), ("test", 500), ("training", -1)):
        with pytest.raises(ValueError, match=f"{split} has no case {number}"):
            case_seed(split, number)
    with pytest.raises(ValueError, match="'exam' is none of"):
        case_seed("exam", 0)


def test_people_who_do_not_fit_are_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sarn_rl.envs.cases.MOST_DRAWS", 2000)
    with pytest.raises(ValueError, match="people: 40 do not fit"):
        make_case(CaseParams(people=40), 0)
