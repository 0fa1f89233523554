"""Bundles and ensembles on more ranks: measured on one and two, estimated beyond from work and communication."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, log2

import numpy as np

from verification.bundles import Bundle, BundleRanks, compared
from verification.processes import said

__all__ = ["ASKED", "RANKS", "EnsembleScaling", "Scaling", "ensembles", "scaled"]

# Times by which two ranks should be quicker, told and never judged: clocks depend on who else is at work.
ASKED = {"bundle": 1.5, "ensemble": 1.8}
# For which times are estimated.
RANKS = (4, 8, 16, 32)
RUN, ENSEMBLE_RUN = "verification.scalingrun", "verification.ensemblerun"


@dataclass(frozen=True)
class Scaling:
    """A bundle on one rank and on two, and a half of it on one.

    Of a step, one rank works T₁ = w + s: w is shared out by fibres, s is what every rank does for itself. Two ranks
    take T₂ = w/2 + s + c with the communication c, so w = 2(T₁ − T₂ + c). On p ranks it takes about

        T(p) = w ⌈n/p⌉/n + s + k (α log₂ p + 2 (1 − 1/p) b/β)

    with k exchanges of b bytes a step, a latency α and a rate β as measured between two ranks of this machine (Thakur,
    Rabenseifner & Gropp 2005, doi:10.1177/1094342005051521).

    Args:
        fibres: How many, n.
        steps: Taken.
        one: Time of a step on one rank, T₁ [s].
        two: And on two, T₂ [s].
        half: And of half as many fibres on one [s].
        talk: Of T₂, exchanging what all ranks know of nodes, c [s].
        calls: Exchanges a step, k.
        size: Of an exchange, b [bytes].
        latency: α [s].
        rate: β [bytes/s].
        failure: Why one ended early; empty: none did.
    """

    fibres: int
    steps: int
    one: float
    two: float
    half: float
    talk: float
    calls: float
    size: float
    latency: float
    rate: float
    failure: str = ""

    @property
    def shared(self) -> float:
        """Work that ranks share out, w, at most all of it [s]."""
        return min(2.0 * (self.one - self.two + self.talk), self.one)

    @property
    def strong(self) -> float:
        """Times by which two ranks are quicker than one."""
        return self.one / self.two

    @property
    def weak(self) -> float:
        """Part of the time that half the bundle takes alone of the time that both halves take on two ranks."""
        return self.half / self.two

    def estimated(self, ranks: int) -> float:
        """Times by which so many ranks should be quicker than one: an estimate, not a measurement."""
        most = ceil(self.fibres / ranks) / self.fibres
        sent = self.latency * log2(ranks) + 2.0 * (1.0 - 1.0 / ranks) * self.size / self.rate
        return self.one / (self.shared * most + self.one - self.shared + self.calls * sent)

    @property
    def words(self) -> str:
        """How much quicker."""
        quicker = f"{self.strong:.2f} times as quick on two ranks, at least {ASKED['bundle']:g} asked"
        return f"Bundle of {self.fibres}, {self.steps} steps: {self.failure or quicker}"

    @property
    def holds(self) -> bool:
        """Whether all ran to their ends: time never decides."""
        return not self.failure


@dataclass(frozen=True)
class EnsembleScaling:
    """An ensemble on one rank and on two.

    Args:
        runs: How many.
        seconds: On one rank and on two, by the clock [s].
        each: Of the runs on one rank, by the processor [s].
        failure: Why one ended early; empty: none did.
    """

    runs: int
    seconds: tuple[float, float]
    each: tuple[float, ...]
    failure: str = ""

    @property
    def strong(self) -> float:
        """Times by which two ranks are quicker than one."""
        return self.seconds[0] / self.seconds[1]

    def estimated(self, ranks: int) -> float:
        """Times by which so many ranks should be quicker: who is free takes the next run; an estimate."""
        busy = np.zeros(ranks)
        for seconds in self.each:
            busy[busy.argmin()] += seconds
        return sum(self.each) / float(busy.max())

    @property
    def words(self) -> str:
        """How much quicker."""
        quicker = f"{self.strong:.2f} times as quick on two ranks, at least {ASKED['ensemble']:g} asked"
        return f"Ensemble of {self.runs} runs: {self.failure or quicker}"

    @property
    def holds(self) -> bool:
        """Whether all ran to their ends: time never decides."""
        return not self.failure


def scaled(who: Bundle, fibres: int, steps: int) -> tuple[Scaling, BundleRanks]:
    """A bundle on one rank and on two, and half of it on one: time, and where it ends on one and on two."""
    mesh = who.elements, who.degree
    one, two, half = (said(RUN, (*mesh, n, steps), ranks) for n, ranks in ((fibres, 1), (fibres, 2), (fibres // 2, 1)))
    same = compared(who, fibres, one, two, "seconds")
    failure = next((told["failure"] for told in (one, two, half) if "failure" in told), "")
    if failure:
        two = dict.fromkeys(("seconds", "talk", "calls", "size", "latency", "rate"), float("nan"))
        one = half = two
    scaling = Scaling(
        fibres=fibres,
        steps=steps,
        one=one["seconds"] / steps,
        two=two["seconds"] / steps,
        half=half["seconds"] / steps,
        talk=two["talk"] / steps,
        calls=two["calls"] / steps,
        size=two["size"] / two["calls"],
        latency=two["latency"],
        rate=two["rate"],
        failure=failure,
    )
    return scaling, same


def ensembles(runs: int, steps: int) -> EnsembleScaling:
    """An ensemble of small bundles in the groove on one rank and on two."""
    one, two = (said(ENSEMBLE_RUN, (runs, steps), ranks) for ranks in (1, 2))
    if failure := one.get("failure", "") or two.get("failure", ""):
        return EnsembleScaling(runs, (float("nan"), float("nan")), (), failure)
    return EnsembleScaling(runs, (one["seconds"], two["seconds"]), tuple(one["each"]))
