# SPDX-License-Identifier: BSD-3-Clause
"""Networks by name."""

from __future__ import annotations

from sarn_rl.networks.base import ValueNetwork
from sarn_rl.networks.cadrl import CadrlNetwork
from sarn_rl.networks.lstm_rl import LstmNetwork
from sarn_rl.networks.mirror_mean import MirrorMean
from sarn_rl.networks.params import KINDS, NetworkParams
from sarn_rl.networks.sarl import SarlNetwork


def make_network(params: NetworkParams, robot_size: int, gamma: float) -> ValueNetwork:
    """A new network with random weights (of torch's global generator)."""
    network = _plain_network(params, robot_size, gamma)
    return MirrorMean(network) if params.mirror_mean else network


def _plain_network(params: NetworkParams, robot_size: int, gamma: float) -> ValueNetwork:
    if params.kind == "cadrl":
        return CadrlNetwork(robot_size, gamma)
    if params.kind == "lstm_rl":
        return LstmNetwork(robot_size)
    if params.kind == "sarl":
        return SarlNetwork(robot_size, params.map_cells, params.map_cell_size)
    raise ValueError(f"network kind '{params.kind}' is none of {', '.join(KINDS)}")
