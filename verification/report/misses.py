"""What lies beyond its limit, in sentences."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

from verification.checks import Check
from verification.cold import Cold
from verification.contact import MOST_ITERATIONS, ContactStudy
from verification.contactmaps import ContactCell
from verification.crosscheck import BAND, CrossCheck
from verification.drift import KEPT, DriftStudy
from verification.explicitlimit import ExplicitLimit
from verification.frequency import FrequencyStudy
from verification.groovebench import LIMIT, GrooveSweep
from verification.grooveprofile import AGREES, SideBySide
from verification.hard import HardRow, Share
from verification.hardcontact import ContactRow
from verification.hardmotion import MotionRow
from verification.laws import LawRow
from verification.maps import Cell
from verification.motion import MotionStudy
from verification.onestep import OneStep
from verification.pace import PaperFibre
from verification.report.tables import figure, power, scientific
from verification.rigid import TopStudy
from verification.robustness import OneStepLoads, Steps
from verification.stability import Bracket, EigenStudy
from verification.twist import TwistStudy

__all__ = ["sentence"]


@singledispatch
def sentence(row: Any) -> str:
    """What was found, and what was asked for.

    Args:
        row: One that does not hold, of any table.

    Returns:
        The sentence without full stop.
    """
    words = getattr(row, "words", None)
    if not isinstance(words, str):
        raise TypeError(f"{type(row).__name__} is no row of the report")
    return words


@sentence.register
def _(row: Check) -> str:
    if row.quantity.startswith("order"):
        return f"{row.title}: {row.model} {row.quantity} {power(row.found)} ({row.mesh}), at least {power(row.limit)}"
    words = "least error" if row.quantity == "digits" else row.quantity
    asked = f"at most {scientific(row.limit, 0)}" + (", or the order of theory" if row.quantity == "digits" else "")
    return f"{row.title}: {row.model} {words} {scientific(row.found)} ({row.mesh}), {asked}"


@sentence.register
def _(row: Cold) -> str:
    return f"A process, {row.words}: {row.failure}"


@sentence.register
def _(row: OneStep) -> str:
    if row.failure:
        return f"{row.title}: {row.kinematics} {row.mesh} did not converge: {row.failure}"
    taken = f"{row.steps} load step(s) and {row.iterations} iterations, error {scientific(row.error)}"
    return f"{row.title}: {row.kinematics} {row.mesh} took {taken}; asked for one step and at most {row.limit}"


@sentence.register
def _(row: CrossCheck) -> str:
    if row.failure:
        return f"{row.title}: models not compared on {row.elements} discrete elements, {row.failure}"
    band = " to ".join(f"{factor:g}" for factor in BAND)
    return (
        f"{row.title}: models differ by {scientific(row.difference)} on {row.elements} discrete elements, estimated "
        f"{scientific(row.estimate)}; expected {band} times that"
    )


@sentence.register
def _(row: LawRow) -> str:
    return f"{row.title}: {row.model} violates it by {scientific(row.found)}, at most {scientific(row.bound, 0)}"


@sentence.register
def _(row: EigenStudy) -> str:
    found = f"{row.title}: {row.model} {row.quantity} {figure(row.found[-1])} instead of {figure(row.reference)}"
    if row.failure:
        return f"{found}; {row.failure}"
    errors = " · ".join(f"{scientific(e)} ({n})" for n, e in zip(row.meshes, row.errors, strict=True))
    modes = f"{row.multiplicity} mode(s) of {row.expected}"
    return f"{found}; errors {errors}, order {power(row.order.observed)} of {row.order.theory}, {modes}"


@sentence.register
def _(row: Bracket) -> str:
    if row.failure:
        return f"{row.title}: {row.model} has no verdict on both sides of the critical load: {row.failure}"
    below, above = (verdict(stable) for stable in row.stable)
    lost = "not counted" if row.directions[1] is None else row.directions[1]
    return (
        f"{row.title}: {row.model} {below} below the critical load and {above} above, directions lost {lost}; "
        f"expected stable, unstable, {row.expected}"
    )


@sentence.register
def _(row: HardRow) -> str:
    found = f"{row.title}: {row.model} {row.mesh} ends {scientific(row.error)} off ({row.check}), {verdict(row.stable)}"
    return f"{found}, without a warning" + (f"; {row.reason}" if row.reason else "")


@sentence.register
def _(row: Share) -> str:
    return f"Hard cases: {row.converged} of {row.total} continuum rows converge, at least {100 * row.least:.0f} %"


@sentence.register
def _(row: OneStepLoads) -> str:
    return f"Largest load in one step: {row.model} takes {row.largest:g} EI/L², at least {row.least:g}"


@sentence.register
def _(row: Steps) -> str:
    if row.failure:
        return f"{row.title}: {row.model} on {row.mesh} elements did not converge: {row.failure}"
    asked = [
        f"at most {most} {what}"
        for most, what in ((row.most_steps, "step(s)"), (row.most_iterations, "iterations"))
        if most is not None
    ]
    taken = f"{row.steps} load step(s) and {row.iterations} iterations, error {scientific(row.error)}"
    return f"{row.title}: {row.model} on {row.mesh} elements took {taken}; {' and '.join(asked) or 'error too large'}"


@sentence.register
def _(row: ExplicitLimit) -> str:
    found = f"longest stable step {scientific(row.measured, 3)} s instead of {scientific(row.matrices, 3)} s"
    return f"Explicit limit, {row.wave}, elements of {1e3 * row.l:g} mm: {found}"


@sentence.register
def _(row: Cell) -> str:
    load = f"load within {1e3 * row.rise:g} ms" if row.rise else "load at once"
    place = f"{load}, steps of {row.dt:g} s on elements of {1e3 * row.l:g} mm"
    bound = "" if row.limit is None else f", 2/ω_max = {scientific(row.limit, 3)} s"
    return f"Stability map: {row.scheme}, {place}: {row.outcome}{bound}" + (f", {row.reason}" if row.reason else "")


@sentence.register
def _(row: MotionRow) -> str:
    return f"{row.title}: {row.solver} {row.outcome.lower()}, {row.reason}"


@sentence.register
def _(row: MotionStudy) -> str:
    failures = [r.failure for r in row.records if r.failure]
    if failures:
        return f"{row.title}: {row.model} on {row.mesh} could not take a step: {failures[0]}"
    limit = "" if row.limit is None else f", at most {scientific(row.limit, 0)}"
    order = f", order {power(row.order)} in the time step of {row.theory}" if row.ordered else ""
    return f"{row.title}: {row.model} on {row.mesh} is {scientific(row.rest)} off{limit}{order}"


@sentence.register
def _(row: FrequencyStudy) -> str:
    found = f"{figure(row.found[-1])} rad/s instead of {figure(row.reference)}"
    beside = f"{scientific(row.apart)} beside the spectrum, order {power(row.order.observed)} of {row.order.theory}"
    return f"{row.title}: {row.model} vibrates with {found}, {beside}"


@sentence.register
def _(row: DriftStudy) -> str:
    changes = f"linear momentum by {scientific(max(row.linear))}, angular by {scientific(max(row.angular))}"
    energy = f"energy with order {power(row.order.observed)} of {row.order.theory}"
    return f"Free flight: {row.model} changes {changes}, {energy}; momenta at most {scientific(KEPT, 0)}"


@sentence.register
def _(row: PaperFibre) -> str:
    apart, gap = scientific(max(row.apart)), scientific(max(row.open))
    return f"The paper's fibre: models are {apart} apart, ledgers open by {gap}"


@sentence.register
def _(row: TopStudy) -> str:
    orders = ", ".join(power(o.observed) for o in (row.spin_order, row.attitude_order, row.energy_order))
    found = (
        f"orders {orders} of {row.theory} in spin, attitude and energy, momentum off by {scientific(max(row.momentum))}"
    )
    return f"{row.title}: {row.integrator} has {found}, largest gain of energy {scientific(row.gain)}"


@sentence.register
def _(row: ContactCell) -> str:
    place = f"steps of {row.dt:g} s, ε_N = {row.eps_N:g} N/m², elements of {1e3 * row.l:g} mm"
    found = f"Contact map: {row.scheme}, {place}: {row.outcome}"
    return found + (f", {row.reason}" if row.reason else "")


@sentence.register
def _(row: ContactRow) -> str:
    if row.outcome == "converged":
        return f"{row.title}: {row.solver} took {row.a_step:.1f} iterations a step, at most {MOST_ITERATIONS:g}"
    return f"{row.title}: {row.solver} {row.outcome.lower()}, {row.reason}"


@sentence.register
def _(row: GrooveSweep) -> str:
    failures = [p.failure for p in row.points if p.failure]
    if failures:
        return f"{row.title}: {row.solver} over {row.over} was refused: {failures[0]}"
    off = scientific(row.points[-1].error)
    return f"{row.title}: {row.solver} over {row.over} is {off} off the other model, at most {LIMIT:g}"


@sentence.register
def _(row: TwistStudy) -> str:
    asked = f"at most {scientific(row.limit, 0)}"
    if row.order is None:
        return f"{row.title}: {row.measure} is {scientific(max(row.errors))} off, {asked}"
    found = f"order {power(row.order.observed)} of {row.order.theory}, extrapolated {scientific(row.extrapolated)} off"
    return f"{row.title}: {row.measure} has {found}, {asked}"


@sentence.register
def _(row: SideBySide) -> str:
    return f"{row.title}: forces of contact of the models differ by {scientific(row.forces)}, at most {AGREES:g}"


def verdict(stable: bool | None) -> str:
    """In a word."""
    return "not judged" if stable is None else "stable" if stable else "unstable"


@sentence.register
def _(row: ContactStudy) -> str:
    found = f"{row.title}: {row.model}, {row.label}"
    for one in row.records:
        if one.missed:
            return f"{found}, {one.level} {row.unit}: {one.missed}"
    if row.limit is not None and row.records[-1].error > row.limit:
        at = f"{scientific(row.records[-1].error)} off for {row.records[-1].level} {row.unit}"
        return f"{found}, {at}, at most {scientific(row.limit, 0)}"
    return f"{found}, errors fall with order {power(row.order)}, at least {power(row.least)}"
