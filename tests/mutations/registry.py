"""The faults that the suite must notice, and what notices each of them."""

from __future__ import annotations

from tests.mutations import (
    contact_mutations,
    continuum_mutations,
    discrete_mutations,
    form_mutations,
    meeting_mutations,
    motion_mutations,
    twist_mutations,
)

__all__ = ["MUTATIONS", "mutations"]

MUTATIONS = (
    *discrete_mutations.MUTATIONS,
    *continuum_mutations.MUTATIONS,
    *form_mutations.MUTATIONS,
    *motion_mutations.MUTATIONS,
    *contact_mutations.MUTATIONS,
    *twist_mutations.MUTATIONS,
    *meeting_mutations.MUTATIONS,
)


def mutations() -> list[tuple[str, str, str]]:
    """Rows for a report: name, what the fault is, what kills it."""
    return [(m.name, m.fault, f"{m.law} ({m.solver})") for m in MUTATIONS]
