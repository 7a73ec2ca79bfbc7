# SPDX-License-Identifier: BSD-3-Clause
"""Networks that only decide: their weights in the order in which the processor's matrix product reads them.

oneDNN adds bias and ReLU within the product, so a layer is one pass over memory (what torch's own
compiler emits on CPUs). A third less time a decision than layer by layer; the values are the same but for
rounding. A small product is over before oneDNN has found it in its cache, so those are left to the plain
one. Where torch has no oneDNN, a network is used as it is.
"""

from __future__ import annotations

import copy
from typing import List, Optional, Tuple

import torch
from torch import nn

from sarn_rl.networks.base import Mlp, ValueNetwork

# Numbers in the input up to which the plain product is quicker: 6 us against 16 us for 12 x 100, 18 us
# against 22 us for 60 x 100, but 87 us against 54 us for 240 x 150.
SMALL = 10_000


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
        self._parts: Optional[Tuple[int, _Layer, _Layer]] = None

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        for layer in self._layers:
            x = layer(x)
        return x

    def split(self, shared: torch.Tensor, own: torch.Tensor) -> torch.Tensor:
        """See Mlp."""
        _, of_shared, of_own = self._first_parts(shared.shape[-1])
        x = of_own(own).add_(of_shared(shared).unsqueeze(-2))
        if self._layers[0].relu:
            x.relu_()
        for layer in self._layers[1:]:
            x = layer(x)
        return x

    def _first_parts(self, size: int) -> Tuple[int, _Layer, _Layer]:
        if self._parts is None or self._parts[0] != size:
            weight, bias = self._first_weight, self._layers[0].bias
            of_shared = _Layer(weight[:, :size].contiguous(), bias, False)
            self._parts = (size, of_shared, _Layer(weight[:, size:].contiguous(), None, False))
        return self._parts

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
        if self._packed is None or x.numel() <= SMALL:
            out = nn.functional.linear(x, self.weight, self.bias)
            return out.relu_() if self.relu else out
        result: torch.Tensor = torch.ops.mkldnn._linear_pointwise(
            x, self._packed, self.bias, self._after, [], ""
        )
        return result


__all__ = ["PackedMlp", "can_pack", "packed"]
