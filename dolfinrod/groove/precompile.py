"""Kernels of contact and air compiled ahead of any solve: `python -m dolfinrod.groove.precompile`.

Numba keeps what it has compiled beside the modules, or in the user's cache folder where these cannot be written.
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace
from typing import TYPE_CHECKING

from dolfinrod.groove.bundle import Bundle
from dolfinrod.groove.scenario import MODELS, Scenario

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["BLINK", "compiled"]

# Two fibres side by side, half a micrometre apart and from the left flank, within reach of the law of either: walls,
# core, air and fibres all ask for their kernels within three steps.
BLINK = Scenario(
    fibres=2,
    elements=8,
    t_end=3e-6,
    output=3e-6,
    bundle=replace(Bundle(), pitch=2.05e-5, height=1.05e-5, offset=-2e-3, noise=0.0),
)


def compiled() -> Iterator[str]:
    """Compile the kernels that rods in a groove call, by either model, or find them compiled.

    Yields:
        What there is now, and the seconds on the processor that it took, in words.
    """
    for model in reversed(MODELS):
        start = time.process_time()
        BLINK.run(model)
        yield f"contact, friction and air, {model} model: {time.process_time() - start:.1f} s"


if __name__ == "__main__":
    for words in compiled():
        sys.stdout.write(f"{words}\n")
