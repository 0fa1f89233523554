"""Faults in contact, and what kills them."""

from __future__ import annotations

from tests.mutations import contact_faults as m
from tests.mutations.mutation import Mutation
from tests.mutations.planting import Plant

# Both models ask the same law at a point, each in its own way: what is planted there must show in each.
MODELS = ("spatial", "discrete")


def _in(
    models: tuple[str, ...], name: str, fault: str, law: str, plant: Plant, *, slow: bool = False
) -> list[Mutation]:
    """One fault in several models."""
    return [Mutation(f"{name}, {model}", fault, model, law, plant, slow=slow) for model in models]


MUTATIONS = (
    *_in(MODELS, "friction without stick", "a step forgets its anchors", "held by friction", m.WITHOUT_STICK),
    *_in(MODELS, "friction without stick, in time", "the same", "held by friction in motion", m.WITHOUT_STICK),
    *_in(
        MODELS,
        "slip measured against the fixed frame",
        "the way in space, not on the wall",
        "drawn forth and back",
        m.FIXED_FRAME,
    ),
    *_in(MODELS, "slip measured against the fixed frame, in time", "the same", "belt", m.FIXED_FRAME),
    *_in(MODELS, "normal not unit", "1.1 in length", "lying", m.NOT_UNIT),
    *_in(MODELS, "gap from the centreline", "φ in place of φ − radius", "lying", m.FROM_THE_CENTRELINE),
    *_in((*MODELS, "planar"), "missing friction moment", "forces only", "moments of friction", m.NO_MOMENT),
    *_in(MODELS, "adhesive wall", "p = ε (g_0 − g) beyond g_0, too", "lifted", m.ADHESIVE),
    *_in(MODELS, "contact never lost", "what was pressed once stays so", "lifted", m.NEVER_RELEASED),
    *_in(MODELS, "friction not tangential", "anchors pull along the normal, too", "lying and rough", m.NOT_TANGENTIAL),
    *_in(MODELS, "limit of the last step", "|t| ≤ μ p with p before the step", "drawn forth and back", m.LIMIT_BEFORE),
    *_in(MODELS, "anchors that stay", "they do not follow what slides", "drawn forth and back", m.ANCHORS_STAY),
    *_in(MODELS, "anchors held in space", "they do not turn with the wall", "carried along", m.ANCHORS_IN_SPACE),
    *_in(MODELS, "turn of the wall left out", "of that of sections against it", "carried along", m.WALL_DOES_NOT_TURN),
    *_in(MODELS, "forces in axes of the wall", "taken for those of space", "carried along", m.IN_AXES_OF_THE_WALL),
    *_in(MODELS, "onset share left out", "what lands has rubbed on all of its way", "landed", m.TOUCHED_ALL_THE_WAY),
    *_in(MODELS, "multipliers not renewed", "one solve is enough", "penetration", m.NOT_RENEWED),
    *_in(MODELS, "contact stays soft", "as on the way to what is pressed", "pressures of a hard wall", m.STAYS_SOFT),
    *_in(MODELS, "contact energy missing", "none is stored", "energy of contact", m.NOTHING_STORED),
    *_in(MODELS, "friction booked in space", "traction times the way in space", "belt", m.RUBBED_IN_SPACE),
    *_in(MODELS, "no geometric stiffness", "∂(p n)/∂x without p ∂n/∂x", "few iterations on a drum", m.AS_ON_A_PLANE),
    *_in(MODELS, "curvature missing", "of a cylinder", "few iterations on a drum", m.NO_CURVATURE),
    Mutation("no geometric stiffness, at a point", "the same", "spatial", "slopes of contact", m.AS_ON_A_PLANE),
    Mutation("curvature missing, at a point", "the same", "spatial", "slopes of contact", m.NO_CURVATURE),
    Mutation("no tangent of friction", "∂t = 0", "spatial", "slopes of contact", m.NO_TANGENT_OF_FRICTION),
    Mutation("whole end nodes, continuum", "twice their share", "spatial", "lying", m.WHOLE_ENDS),
    Mutation("whole end nodes, discrete", "the same", "discrete", "lying", m.WHOLE_DISCRETE_ENDS),
    *_in(("spatial", "planar"), "turns since the beginning", "not over the step", "carried along", m.TURNS_IN_ONE),
    Mutation("turns since the beginning, discrete", "the same", "discrete", "carried along", m.DISCRETE_TURNS_IN_ONE),
    Mutation("pressure at the end", "not the mean over a step", "planar", "impact by midpoint", m.AT_THE_END),
    Mutation("pressure at the start", "the same", "planar", "impact by midpoint", m.AT_THE_START),
    Mutation("pressure half way", "the same", "planar", "impact by midpoint", m.HALF_WAY),
    Mutation(
        "multipliers of a failed attempt", "the next begins with them", "spatial", "tried again", m.STALE_MULTIPLIERS
    ),
    Mutation("memory lost, cut steps", "anchors and multipliers begin anew", "spatial", "tried again", m.FORGOTTEN),
    *_in(MODELS, "memory lost, going on", "the same in a start from a result", "gone on", m.FORGOTTEN),
    *_in(MODELS, "memory lost, going on in motion", "the same", "gone on in motion", m.FORGOTTEN, slow=True),
)
