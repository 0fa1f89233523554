"""The numbers the models are held against, each with its address.

`tabulated.json` holds values from `shared/reference` (shooting, elliptic functions; no finite elements), `peers.json`
the times published for other people's solvers; `elastica` and `follower` closed forms, `heavy` a collocation, for any
load and stiffness.
"""

from verification.references.elastica import cantilever_tip, circle, elastica
from verification.references.follower import follower, follower_tip
from verification.references.heavy import heavy
from verification.references.peers import Peer, peers, peers_measured
from verification.references.reference import Reference, cantilever, tabulated

__all__ = [
    "Peer",
    "Reference",
    "cantilever",
    "cantilever_tip",
    "circle",
    "elastica",
    "follower",
    "follower_tip",
    "heavy",
    "peers",
    "peers_measured",
    "tabulated",
]
