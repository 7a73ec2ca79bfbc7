# SPDX-License-Identifier: BSD-3-Clause
"""Networks by name."""

from __future__ import annotations

from sarn_rl.networks.base import ValueNetwork
from sarn_rl.networks.cadrl import CadrlNetwork
from sarn_rl.networks.lstm_rl import LstmNetwork
from sarn_rl.networks.mirror_mean import MirrorMean
from sarn_rl.networks.params import KINDS, NetworkParams
from sarn_rl.networks.sarl import SarlNetwork
from sarn_rl.undisturbed import Undisturbed


def make_network(params: NetworkParams, robot_size: int, undisturbed: Undisturbed) -> ValueNetwork:
    """A new network with random weights (of torch's global generator)."""
    network = _plain_network(params, robot_size, undisturbed)
    return MirrorMean(network) if params.mirror_mean else network


def _plain_network(params: NetworkParams, robot_size: int, undisturbed: Undisturbed) -> ValueNetwork:
    if params.kind == "cadrl":
        return CadrlNetwork(robot_size, undisturbed)
    if params.kind == "lstm_rl":
        return LstmNetwork(robot_size, undisturbed)
    if params.kind == "sarl":
        return SarlNetwork(robot_size, undisturbed, params.map_cells, params.map_cell_size)
    raise ValueError(f"network kind '{params.kind}' is none of {', '.join(KINDS)}")
