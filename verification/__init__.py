"""What the two models are worth: errors against independent references, errors against time, each against the other.

    python -m verification [--quick] [--out report]

`case`          a problem, what is read off, and its reference with provenance
`cases`         elastica, follower force, heavy cantilever, roll-up, 45° bend, parabola
`references`    the numbers and where they come from; closed forms
`models`        adapters that solve a scene with either model
`workprecision` the only clock
`order`         observed orders
`onestep`       whole loads in one step: Newton iterations against limits
`speed`         milliseconds against limits and against other people's solvers
`crosscheck`    both models against each other, no reference involved
`checks`        numbers that must hold
`suite`         all of it, as one record
`report`        the record as a page and as JSON

Nothing is imported here: the thread count is settled (`__main__`) before NumPy loads.
"""

__all__: list[str] = []
