# SPDX-License-Identifier: BSD-3-Clause
"""Whether a checkpoint was trained for the robot that is to be driven."""

from __future__ import annotations

from pathlib import Path

from sarn_rl.contract import Contract
from sarn_rl.declared import differences, to_dict
from sarn_rl.deployment.params import Expectation


class DisagreementError(ValueError):
    """One line: the file and what differs."""


def find_checkpoint(models: Path, kind: str, kinematics: str) -> Path:
    """The first KIND_..._KINEMATICS_....pt of a directory. DisagreementError when there is none."""
    if not models.is_dir():
        raise DisagreementError(f"models: {models} is not a directory; give checkpoint:=FILE")
    for path in sorted(models.glob(f"{kind}*.pt")):
        if kinematics in path.stem.split("_"):
            return path
    there = ", ".join(path.name for path in sorted(models.glob("*.pt"))) or "none"
    raise DisagreementError(
        f"{models}: no checkpoint {kind}_*_{kinematics}_*.pt for this planner (there: {there}); "
        "give checkpoint:=FILE"
    )


def require_agreement(where: str, contract: Contract, kind: str, expected: Expectation) -> None:
    """DisagreementError, one line, when the contract is not what the robot needs."""
    trained = {key: to_dict(contract)[key] for key in to_dict(expected)}
    unlike = differences(trained, to_dict(expected))
    if contract.network.kind != kind:
        unlike.insert(0, f"network.kind: '{contract.network.kind}' is not '{kind}'")
    if unlike:
        raise DisagreementError(
            f"{where}: contract differs from what this robot expects: {'; '.join(unlike)}"
        )
