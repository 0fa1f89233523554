"""One rigid body through each rotation integrator of the two models: no rod, no elements, no loads but a weight.

`top`      the bodies, K7 and K8 of the references
`section`  as a section of the continuum model turns: backward Euler and the variational midpoint rule
`node`     as a node of the discrete model turns: backward Euler, rotations multiplied or added
`turned`   a body as an integrator has turned it, held against its reference
"""

from verification.rigidbodies.node import Node
from verification.rigidbodies.section import Section
from verification.rigidbodies.top import TOPS, Integrator, State, Top
from verification.rigidbodies.turned import Turned

__all__ = ["INTEGRATORS", "TOPS", "Integrator", "Node", "Section", "State", "Top", "Turned"]

INTEGRATORS: tuple[Integrator, ...] = (Section.midpoint(), Section.euler(), Node(added=False), Node(added=True))
