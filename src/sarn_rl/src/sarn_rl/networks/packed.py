# SPDX-License-Identifier: BSD-3-Clause
"""Networks that only decide: their weights in the order in which the processor's matrix product reads them.

oneDNN adds bias and ReLU within the product, so a layer is one pass over memory (what torch's own
compiler emits on CPUs). A third less time a decision than layer by layer; the values are the same but for
rounding. Where torch has no oneDNN, a network is used as it is.
"""

from __future__ import annotations

import copy
from typing import List, Optional, Tuple

import torch
from torch import nn

from sarn_rl.networks.base import Mlp, ValueNetwork


def can_pack() -> bool:
    """Whether this torch has what is needed."""
    return torch.backends.mkldnn.is_available() and hasattr(torch.ops.mkldnn, "_linear_pointwise")


def packed(network: ValueNetwork) -> ValueNetwork:
    """A copy to decide with: later changes of the network's weights do not reach it."""
    frozen = copy.deepcopy(network).requires_grad_(False).eval()
    if can_pack():
        _pack_children(frozen)
    return frozen


def _pack_children(module: nn.Module) -> None:
    for name, child in list(module.named_children()):
        if isinstance(child, Mlp):
            setattr(module, name, PackedMlp(child))
        else:
            _pack_children(child)


class PackedMlp(nn.Module):
    """The same as an Mlp, without gradients."""

    def __init__(self, layers: Mlp) -> None:
        super().__init__()
        self._layers: List[_Layer] = []
        modules = list(layers)
        for place, module in enumerate(modules):
            if isinstance(module, nn.Linear):
                relu = place + 1 < len(modules)
                self._layers.append(_Layer(module.weight.data, module.bias.data, relu))
        first = modules[0]
        assert isinstance(first, nn.Linear)
        self._first_weight = first.weight.data
        self._own: Optional[Tuple[int, _Layer]] = None

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        for layer in self._layers:
            x = layer(x)
        return x

    def split(self, shared: torch.Tensor, own: torch.Tensor) -> torch.Tensor:
        """See Mlp."""
        size = shared.shape[-1]
        if self._own is None or self._own[0] != size:
            self._own = (size, _Layer(self._first_weight[:, size:].contiguous(), None, False))
        first = self._layers[0]
        common = nn.functional.linear(shared, self._first_weight[:, :size], first.bias)
        x = self._own[1](own).add_(common.unsqueeze(-2))
        if first.relu:
            x.relu_()
        for layer in self._layers[1:]:
            x = layer(x)
        return x

    def hidden(self, x: torch.Tensor) -> torch.Tensor:
        """See Mlp."""
        for layer in self._layers[:-1]:
            x = layer(x)
        return x

    def last(self, x: torch.Tensor, bias_weight: Optional[torch.Tensor] = None) -> torch.Tensor:
        """See Mlp."""
        layer = self._layers[-1]
        if bias_weight is None:
            return layer(x)
        assert layer.bias is not None
        return nn.functional.linear(x, layer.weight) + bias_weight * layer.bias


class _Layer:
    """x W^T + b, and ReLU if asked. A single output is not worth the packing."""

    def __init__(self, weight: torch.Tensor, bias: Optional[torch.Tensor], relu: bool) -> None:
        self.weight, self.bias, self.relu = weight.clone(), bias, relu
        self._after = "relu" if relu else "none"
        self._packed = torch.ops.mkldnn._reorder_linear_weight(self.weight) if weight.shape[0] > 1 else None

    def __call__(self, x: torch.Tensor) -> torch.Tensor:
        if self._packed is None:
            out = nn.functional.linear(x, self.weight, self.bias)
            return out.relu_() if self.relu else out
        result: torch.Tensor = torch.ops.mkldnn._linear_pointwise(
            x, self._packed, self.bias, self._after, [], ""
        )
        return result


__all__ = ["PackedMlp", "can_pack", "packed"]
