"""Rigid surfaces: their signed distances, normals and curvatures; NumPy only."""

from dolfinrod.scene.surfaces.corner import refuse_sharp
from dolfinrod.scene.surfaces.cylinder import Cylinder
from dolfinrod.scene.surfaces.groove import Groove
from dolfinrod.scene.surfaces.plane import Plane
from dolfinrod.scene.surfaces.surface import Closest, Surface
from dolfinrod.scene.surfaces.wall import REST, Pose, WallMotion

__all__ = [
    "REST",
    "SURFACES",
    "Closest",
    "Cylinder",
    "Groove",
    "Plane",
    "Pose",
    "Surface",
    "WallMotion",
    "refuse_sharp",
]

SURFACES = (Plane, Cylinder, Groove)
