"""Kernels answer as their functions do, and Ctrl-C ends them as it ends everything else."""

from __future__ import annotations

import numpy as np
import pytest

from dolfinrod.scene.compiled import compiled

SCALE = 3.0


def grown(x):
    return SCALE * x


def grown_twice(x):
    return kernel(kernel(x))


kernel, twice = compiled(grown), compiled(grown_twice)


def test_a_kernel_answers_as_its_function_and_calls_others():
    x = np.arange(4.0)
    np.testing.assert_array_equal(kernel(x), grown(x))
    np.testing.assert_array_equal(twice(x), grown(grown(x)))


@pytest.mark.parametrize(
    ("cause", "seen"), [(KeyboardInterrupt(), KeyboardInterrupt), (MemoryError(), SystemError), (None, SystemError)]
)
def test_ctrl_c_while_an_answer_is_handed_over_is_an_interruption(cause, seen):
    """Python then says "returned a result with an exception set"; whatever else it says so of stays what it is."""

    def handing_over(_):
        try:
            raise SystemError("_numba_unpickle returned a result with an exception set") from cause
        except SystemError as error:
            raise SystemError("returned a result with an exception set") from error

    interrupted = compiled(grown)
    vars(interrupted)["_kernel"] = handing_over
    with pytest.raises(seen):
        interrupted(1.0)
