# SPDX-License-Identifier: BSD-3-Clause
"""Networks against their equations written out in numpy, for one state at a time."""

from __future__ import annotations

import dataclasses
from typing import Any, Dict, Tuple

import numpy as np
import pytest
import torch

from sarn_rl.joint_state import JointState
from sarn_rl.networks.base import ValueNetwork
from sarn_rl.networks.factory import make_network
from sarn_rl.networks.packed import can_pack, packed
from sarn_rl.networks.params import NetworkParams
from sarn_rl.observation import Observation, encode
from sarn_rl.policies.value_policy import network_values
from sarn_rl.undisturbed import Undisturbed

ALL = [
    NetworkParams("sarl"),
    NetworkParams("sarl", map_cells=4),
    NetworkParams("cadrl"),
    NetworkParams("lstm_rl"),
    NetworkParams("sarl", mirror_mean=True),
]
UNDISTURBED = Undisturbed(0.9, success=1.5, turn_rate=2.0)
Weights = Dict[str, np.ndarray]


def network(params: NetworkParams, robot_size: int = 6) -> ValueNetwork:
    torch.manual_seed(11)
    return make_network(params, robot_size, UNDISTURBED).eval()


def weights(net: ValueNetwork) -> Weights:
    named = net.named_parameters()
    return {name.replace("inner.", ""): value.detach().double().numpy() for name, value in named}


def layers(w: Weights, name: str, x: np.ndarray, last_relu: bool = False) -> np.ndarray:
    numbers = sorted(int(key.split(".")[1]) for key in w if key.startswith(name) and key.endswith("weight"))
    for number in numbers:
        x = w[f"{name}.{number}.weight"] @ x + w[f"{name}.{number}.bias"]
        if number != numbers[-1] or last_relu:
            x = np.maximum(x, 0.0)
    return x


def sarl_value(w: Weights, s: np.ndarray, people: np.ndarray, maps: np.ndarray) -> float:
    e = [layers(w, "embedding", np.concatenate([s, p, m]), True) for p, m in zip(people, maps)]  # Eq. 2
    h = [layers(w, "interaction", x) for x in e]  # Eq. 3
    mean = sum(e) / len(e)
    scores = np.array([layers(w, "attention", np.concatenate([mean, x]))[0] for x in e])  # Eq. 4
    share = np.exp(scores - scores.max())
    crowd = sum(a * x for a, x in zip(share / share.sum(), h))  # Eq. 5
    return float(layers(w, "value", np.concatenate([s, crowd]))[0])  # Eq. 6


def neighbourhood_map(people: np.ndarray, i: int, cells: int, size: float) -> np.ndarray:
    """Equation 1."""
    out = np.zeros((cells, cells, 3))
    for j, other in enumerate(people):
        cell = np.floor((other[:2] - people[i, :2]) / size + cells / 2).astype(int)
        if j != i and (cell >= 0).all() and (cell < cells).all():
            out[cell[0], cell[1]] += [1.0, other[2], other[3]]
    return out.reshape(-1)


def lstm_value(w: Weights, s: np.ndarray, people: np.ndarray) -> float:
    h, c = np.zeros(50), np.zeros(50)
    for person in people[np.argsort(-people[:, 5], kind="stable")]:
        x = np.concatenate([s, person])
        gates = (
            w["lstm.weight_ih_l0"] @ x
            + w["lstm.bias_ih_l0"]
            + w["lstm.weight_hh_l0"] @ h
            + w["lstm.bias_hh_l0"]
        )
        i, f, g, o = np.split(gates, 4)
        c = c / (1 + np.exp(-f)) + np.tanh(g) / (1 + np.exp(-i))
        h = np.tanh(c) / (1 + np.exp(-o))
    return float(layers(w, "value", np.concatenate([s, h]))[0])


def expected(params: NetworkParams, w: Weights, s: np.ndarray, people: np.ndarray) -> float:
    if len(people) == 0:
        return 1.5 * 0.9 ** (max(0.0, s[0] - s[4]) + s[1] * abs(s[5]) / 2.0)
    if params.mirror_mean:
        plain = dataclasses.replace(params, mirror_mean=False)
        image = expected(plain, w, s * [1, 1, 1, -1, 1, -1], people * [1, -1, 1, -1, 1, 1, 1])
        return 0.5 * (expected(plain, w, s, people) + image)
    if params.kind == "sarl":
        maps = [neighbourhood_map(people, i, params.map_cells, 1.0) for i in range(len(people))]
        return sarl_value(w, s, people, np.array(maps))
    if params.kind == "cadrl":
        pairs = [layers(w, "value", np.concatenate([s, person]))[0] for person in people]
        return float(min(pairs))
    return lstm_value(w, s, people)


def observation(state: JointState) -> Observation:
    return encode(state.robots, state.people, state.present, with_theta=True)


@pytest.mark.parametrize("params", ALL, ids=str)
def test_value_is_that_of_the_equations(params: NetworkParams, crowd: JointState) -> None:
    net, seen = network(params), observation(crowd)
    w = weights(net)
    values = [
        expected(params, w, robot.astype(float), people[there].astype(float))
        for robot, people, there in zip(seen.robot, seen.people, seen.present)
    ]
    assert network_values(net, seen) == pytest.approx(values, abs=2e-5)


@pytest.mark.parametrize("params", ALL, ids=str)
def test_order_and_padding_do_not_matter(params: NetworkParams, crowd: JointState) -> None:
    net, seen = network(params), observation(crowd)
    order = [2, 0, 3, 1]
    shuffled = Observation(seen.robot, seen.people[:, order], seen.present[:, order])
    assert network_values(net, shuffled) == pytest.approx(network_values(net, seen), abs=2e-6)
    rubbish = np.concatenate([seen.people, np.full((4, 2, 7), 3.0, dtype=np.float32)], axis=1)
    padded = Observation(
        seen.robot, rubbish, np.concatenate([seen.present, np.zeros((4, 2), dtype=bool)], axis=1)
    )
    assert network_values(net, padded) == pytest.approx(network_values(net, seen), abs=2e-6)


@pytest.mark.parametrize("params", ALL, ids=str)
def test_empty_crowd_equals_no_rows_at_all(params: NetworkParams, crowd: JointState) -> None:
    net, seen = network(params), observation(crowd)
    nobody = Observation(seen.robot, np.zeros((4, 0, 7), np.float32), np.zeros((4, 0), dtype=bool))
    absent = Observation(seen.robot, seen.people, np.zeros((4, 4), dtype=bool))
    assert np.isfinite(network_values(net, nobody)).all()
    assert network_values(net, absent) == pytest.approx(network_values(net, nobody), abs=1e-6)


@pytest.mark.parametrize("params", ALL, ids=str)
def test_where_somebody_is_the_value_is_the_learned_one_to_the_bit(
    params: NetworkParams, crowd: JointState
) -> None:
    net, seen = network(params), observation(crowd)
    inner = net.inner if params.mirror_mean else net
    somebody = seen.present.any(axis=1)
    assert not somebody.all()
    arguments = [torch.from_numpy(np.array(array)) for array in seen]
    with torch.no_grad():
        values, learned = inner(*arguments).numpy(), inner.among(*arguments).numpy()  # type: ignore[operator]
        np.testing.assert_array_equal(values[somebody], learned[somebody])
        assert (values[~somebody] != learned[~somebody]).all()
        everybody = [arguments[0], arguments[1], torch.ones_like(arguments[2])]
        learned = inner.among(*everybody).numpy()  # type: ignore[operator]
        np.testing.assert_array_equal(inner(*everybody).numpy(), learned)


@pytest.mark.parametrize("params", ALL, ids=str)
def test_gradients_of_masked_batches_are_finite(params: NetworkParams, crowd: JointState) -> None:
    net, seen = network(params), observation(crowd)
    net(*(torch.from_numpy(np.array(array)) for array in seen)).sum().backward()
    gradients = [p.grad for p in net.parameters() if p.grad is not None]
    assert gradients and all(bool(torch.isfinite(g).all()) for g in gradients)


@pytest.mark.parametrize(
    "kind, robot_size, count",
    [("sarl", 6, 96502), ("lstm_rl", 6, 46851), ("cadrl", 6, 27401), ("sarl", 5, 96502 - 150 - 150)],
)
def test_networks_have_the_published_size(kind: str, robot_size: int, count: int) -> None:
    assert sum(p.numel() for p in network(NetworkParams(kind), robot_size).parameters()) == count


def test_attention_weights_are_shares(crowd: JointState) -> None:
    net, seen = network(NetworkParams("sarl")), observation(crowd)
    arguments: Tuple[Any, ...] = tuple(torch.from_numpy(np.array(array)) for array in seen)
    share = net.crowd(*arguments)[1].detach().numpy()  # type: ignore[operator]
    assert share.sum(axis=1) == pytest.approx([0.0, 1.0, 1.0, 1.0], abs=1e-6)
    assert not share[~crowd.present].any()


def test_unknown_or_contradictory_parameters_are_named() -> None:
    assert "kind" in NetworkParams("gcn").problems()[0]
    assert "map_cells" in NetworkParams("cadrl", map_cells=4).problems()[0]
    with pytest.raises(ValueError, match="gcn"):
        make_network(NetworkParams("gcn"), 6, UNDISTURBED)


@pytest.mark.skipif(not can_pack(), reason="this torch has no oneDNN")
@pytest.mark.parametrize("params", ALL, ids=str)
@pytest.mark.parametrize("count", [0, 1, 5])
def test_packed_network_has_the_same_values_and_keeps_its_weights(params: NetworkParams, count: int) -> None:
    net = network(params)
    random = np.random.default_rng(5)
    robot = random.uniform(-3.0, 3.0, (40, 6)).astype(np.float32)
    people = random.uniform(-3.0, 3.0, (40, count, 7)).astype(np.float32)
    everybody = np.ones((40, count), dtype=bool)
    some = random.random((40, count)) < 0.6
    quick = packed(net)
    for present in (everybody, some):
        observation = Observation(robot, people, present)
        expected = network_values(net, observation)
        np.testing.assert_allclose(network_values(quick, observation), expected, atol=1e-5)
    before = network_values(quick, Observation(robot, people, everybody))
    with torch.no_grad():
        for value in net.parameters():
            value.add_(0.1)
    np.testing.assert_array_equal(network_values(quick, Observation(robot, people, everybody)), before)
