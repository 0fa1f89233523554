"""Faults in rods that touch rods, and what kills them."""

from __future__ import annotations

from tests.mutations import meeting_faults as m
from tests.mutations.mutation import Mutation
from tests.mutations.planting import Plant

__all__ = ["MUTATIONS"]


def _of(name: str, fault: str, law: str, plant: Plant) -> Mutation:
    """In the law that every model asks, which no scene is solved for."""
    return Mutation(name, fault, "spatial", law, plant)


MUTATIONS = (
    _of("force on one rod only", "what the other would feel is lost", "third law of rods", m.ON_ONE_ROD),
    _of("missing lever arm", "friction acts at the centrelines", "third law of rough rods", m.NO_COUPLES),
    _of("missing lever arm, exchanged", "that of the other rod", "gears", m.ARMS_EXCHANGED),
    _of(
        "missing lever arm, signs",
        "couples of either rod against each other",
        "third law of rough rods",
        m.COUPLES_ASTRAY,
    ),
    _of("wrong segment parameter", "pushed beside the point of contact", "third law of rods", m.ELSEWHERE),
    _of("wrong segment parameter, projection", "not the closest point", "crossing rods", m.NOT_PROJECTED),
    _of("one of two directions", "the rod named first looks for the other", "order of rods", m.ONE_DIRECTION),
    _of("normal not unit, rods", "1.1 in length", "rods side by side", m.NOT_UNIT),
    _of("normal inwards, rods", "they draw each other in", "rods side by side", m.INWARDS),
    _of("gap from the centreline, rods", "D in place of D − r_A − r_B", "rods side by side", m.FROM_CENTRELINES),
    _of("contact at nodes only", "wherever it is between them", "crossing rods", m.AT_NODES),
    _of("contact on whole spans", "Gauss points beyond the interval", "crossing rods", m.WHOLE_SPANS),
    _of("no contact with oneself", "pairs of one rod are dropped", "a rod on itself", m.OTHERS_ONLY),
    _of("pairs kept for ever", "neighbours are not looked for again", "a rod from afar", m.KEPT_PAIRS),
    _of("friction without stick, rods", "a step forgets its anchors", "held by a rod", m.NO_ANCHORS),
    _of("friction with the slip", "traction of the other sign", "held by a rod", m.TOWARDS_THE_SLIP),
    _of("anchors held in space, rods", "they do not turn with the rods", "turned together", m.ANCHORS_IN_SPACE),
    _of("onset share left out, rods", "what lands has rubbed on all of its way", "landed on a rod", m.ALL_THE_WAY),
    _of("weights that stay", "∂w(s_B) left out of the tangent", "slopes of rods", m.WEIGHTS_STAY),
    _of("opposite that stays", "ds_B left out of the tangent", "slopes of rods", m.OPPOSITE_STAYS),
    _of("opposite that stays, crossing", "the same", "slopes of crossing rods", m.OPPOSITE_STAYS),
    _of("blocks transposed", "rows for columns", "slopes of rough rods", m.TRANSPOSED),
    _of("pressure at the end, rods", "not the mean over a step", "work between rods", m.AT_THE_END),
    _of("contact energy missing, rods", "none is stored", "work between rods", m.NOTHING_STORED),
    _of("memory lost, rods", "anchors begin anew", "remembered by rods", m.FORGOTTEN),
    _of("passed through unseen", "no step is too long", "shots through rods", m.NEVER_THROUGH),
    _of("passed by as if through", "every step is too long", "shots through rods", m.ALWAYS_THROUGH),
    Mutation("rods counted twice, continuum", "forces on either rod by two", "spatial", "stacked", m.COUNTED_TWICE),
    Mutation("turns since the beginning, rods", "not over the step", "spatial", "turned on a rod", m.TURNS_IN_ONE),
    Mutation(
        "half of the coupling, continuum",
        "between rods, in the tangent",
        "spatial",
        "few iterations of crossed rods",
        m.HALF_LINKED,
    ),
    Mutation("rods counted twice, discrete", "the same", "discrete", "stacked", m.DISCRETE_TWICE, slow=True),
    Mutation(
        "turns since the beginning, rods, discrete", "the same", "discrete", "turned on a rod", m.DISCRETE_TURNS_IN_ONE
    ),
    Mutation(
        "half of the coupling, discrete",
        "the same",
        "discrete",
        "few iterations of crossed rods",
        m.DISCRETE_HALF_LINKED,
    ),
)
