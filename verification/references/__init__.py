"""The numbers the models are held against, each with its address.

`tabulated.json` holds values from `shared/reference` (shooting, elliptic functions; no finite elements), `peers.json`
the times published for other people's solvers; `elastica`, `follower` and `helix` closed forms, `heavy` and `cable`
collocations, for any load and stiffness. `bvp` solves any one rod of uniform curvature with its supports and loads,
`scenes` reads them off a scene, `retrace` checks the solution, `solved` keeps it in `bvp.json`. `spectra.json` holds
critical loads and frequencies (`scalar`), those of `lateral` among them, `robustness.json` what load steps other
people's solvers take.
"""

from verification.references.cable import Cable, catenary, catenary_tension
from verification.references.elastica import cantilever_tip, circle, elastica
from verification.references.follower import follower, follower_tip
from verification.references.heavy import heavy
from verification.references.helix import Coil
from verification.references.peers import Peer, peers, peers_measured
from verification.references.reference import Reference, cantilever, tabulated
from verification.references.scenes import rod_problem
from verification.references.solved import Solved, solved

__all__ = [
    "Cable",
    "Coil",
    "Peer",
    "Reference",
    "Solved",
    "cantilever",
    "cantilever_tip",
    "catenary",
    "catenary_tension",
    "circle",
    "elastica",
    "follower",
    "follower_tip",
    "heavy",
    "peers",
    "peers_measured",
    "rod_problem",
    "solved",
    "tabulated",
]
