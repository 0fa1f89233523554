"""Labels in diagrams: all are there, none covers another one."""

from __future__ import annotations

import re
from itertools import combinations, pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from verification.report.canvas import BROAD, LETTER, Curve, log_log

WORDS = ("continuum", "discrete")


def drawn(*starts):
    """Left ends, baselines and widths of the labels of steep curves that begin at these times."""
    curves = [
        Curve(kind, (x, 2.0 * x), (1e-2, 1e-6), "", label=label, at=0)
        for kind, label, x in zip(("p3", "chord"), WORDS, starts, strict=True)
    ]
    found = re.findall(r'<text x="([\d.]+)" y="([\d.]+)" class="[^"]+">(\w+)<', log_log(curves, x="s", y="", alt=""))
    return [(float(x), float(y), BROAD * len(words), words) for x, y, words in found]


@given(st.floats(0.01, 100.0), st.floats(0.01, 100.0))
def test_two_labels_are_both_there_and_cover_nothing(first, second):
    labels = drawn(first, second)
    assert sorted(words for *_, words in labels) == sorted(WORDS)
    for (x, y, wide, _), (a, b, w, _) in combinations(labels, 2):
        assert abs(y - b) > LETTER - 0.1 or x + wide <= a + 0.1 or a + w <= x + 0.1


def test_a_label_stands_at_its_point_where_nothing_is_in_its_way():
    (one,) = [label for label in drawn(0.1, 10.0) if label[3] == "continuum"]
    (other,) = [label for label in drawn(0.1, 20.0) if label[3] == "continuum"]
    assert one[1] == other[1]


def test_a_label_gives_way_to_lines():
    """One that goes down from its first point to the right, and one that another begins above."""
    falls = Curve("chord", (10.0, 12.0, 100.0), (1e-3, 9e-4, 1e-4), "", label="falls", at=0)
    drops = Curve("p3", (14.0, 15.0), (1e-1, 1e-8), "", label="drops", at=0)
    page = log_log([falls, drops, Curve("p2", (0.5, 0.6), (1e-7, 1e-8), "")], x="s", y="", alt="")
    boxes = re.findall(r'<text x="([\d.]+)" y="([\d.]+)" class="[^"]+">(?:falls|drops)<', page)
    lines = [
        np.array([p.split(",") for p in points.split()], float) for points in re.findall(r'points="([^"]+)"', page)
    ]
    dots = np.concatenate([a + (b - a) * np.linspace(0, 1, 400)[:, None] for p in lines for a, b in pairwise(p)])
    assert len(boxes) == 2
    for x, y in ((float(x), float(y)) for x, y in boxes):
        across = (dots[:, 0] > x) & (dots[:, 0] < x + BROAD * len("falls"))
        assert not (across & (dots[:, 1] > y - LETTER) & (dots[:, 1] < y)).any()
