"""Rods that touch rods: the one law that both models share; NumPy only, and SciPy's tree for neighbours."""

from dolfinrod.scene.meeting.coupling import Coupling, Felt, Nodal
from dolfinrod.scene.meeting.meeting import Meeting
from dolfinrod.scene.meeting.passing import PASSED
from dolfinrod.scene.meeting.strands import Strands

__all__ = ["PASSED", "Coupling", "Felt", "Meeting", "Nodal", "Strands"]
