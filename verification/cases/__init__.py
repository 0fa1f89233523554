"""The cases, one file a family."""

from verification.cases import (
    bar,
    bend45,
    cable,
    curved,
    elastica,
    follower,
    heavy,
    helix,
    inside,
    parabola,
    postbuckling,
    rollup,
    several,
    spans,
    spring,
    strip,
)

__all__ = [
    "CASES",
    "HEADLINES",
    "bar",
    "bend45",
    "cable",
    "curved",
    "elastica",
    "follower",
    "heavy",
    "helix",
    "inside",
    "parabola",
    "postbuckling",
    "rollup",
    "several",
    "spans",
    "spring",
    "strip",
]

CASES = (
    *elastica.CASES,
    *follower.CASES,
    *heavy.CASES,
    *cable.CASES,
    *rollup.CASES,
    *bar.CASES,
    *bend45.CASES,
    *parabola.CASES,
    *postbuckling.CASES,
    *helix.CASES,
    *spring.CASES,
    *strip.CASES,
    *curved.CASES,
    *inside.CASES,
    *spans.CASES,
    *several.CASES,
)

# The case of a family that is studied in depth; of a family without one here, its first.
HEADLINES = ("elastica-10", "follower-10", "heavy-10", "rollup-0.5", "bend45-600-kirchhoff")
