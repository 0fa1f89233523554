"""How fibres twist: about one another, about an axis, about themselves.

X is the machine direction, from A to B. Turns and twist are positive where they are right-handed about +X (Z twist),
lengths in metres, twist in turns per metre.

Curves are points joined by straight lines, on which every measure is exact; `smooth` and `centrelines` lay points on
smooth curves as closely as one likes. How much a measure of the points differs from that of the curve falls with the
square of their distance; windings from end to end do not differ at all, as long as no fibre is taken to pass another on
the wrong side. Where points are too far apart to tell that, `TooCoarse` says so.

    import dolfinrod as dr

    bundle = dr.twist.of(result)           # of a result of either model
    bundle.T_pair, bundle.T_axis           # turns per metre
    dr.twist.winding(r_k, r_l).turns       # of two curves, shapes (n, 3)

| measure | of what | |
|---|---|---|
| `winding`, `pairs` | fibres about one another | turns; T = their mean over length |
| `axis_winding`, `profile`, `delivered` | a bundle about an axis | T, T(X), T of the last 10 mm |
| `crossings`, `exchanges` | fibres seen from above | who is on top, which way; who has crossed whom |
| `outflow` | what leaves through a plane in time | T of the strand delivered |
| `twist`, `frame_twist`, `material_twist` | a ribbon, a rod about itself | turns |
| `writhe`, `link` | a curve's coiling; two closed curves | turns; Lk = Tw + Wr |
"""

from dolfinrod.twist.axis import AxisWinding, Profile, axis_winding, delivered, profile
from dolfinrod.twist.bundle import Bundle, centrelines, of, refined, smooth
from dolfinrod.twist.coarse import TooCoarse
from dolfinrod.twist.crossing import Crossing, Exchange, crossings, exchanges
from dolfinrod.twist.flow import Outflow, outflow
from dolfinrod.twist.linking import link
from dolfinrod.twist.pairing import Pairs, Winding, pairs, winding
from dolfinrod.twist.torsion import frame_twist, material_twist, twist
from dolfinrod.twist.writhing import writhe

__all__ = [
    "AxisWinding",
    "Bundle",
    "Crossing",
    "Exchange",
    "Outflow",
    "Pairs",
    "Profile",
    "TooCoarse",
    "Winding",
    "axis_winding",
    "centrelines",
    "crossings",
    "delivered",
    "exchanges",
    "frame_twist",
    "link",
    "material_twist",
    "of",
    "outflow",
    "pairs",
    "profile",
    "refined",
    "smooth",
    "twist",
    "winding",
    "writhe",
]
