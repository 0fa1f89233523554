"""Fibre bundles in the pneumatic groove of compact spinning: lateral against intermediate, and the additional twist.

    import dolfinrod as dr

    scenario = dr.groove.Scenario("lateral", fibres=5, seed=1)
    result = scenario.run("discrete")
    dr.groove.measure(result, scenario).T_pair

The paper gives the fibre, one angle and little else; what else a bundle in a groove needs is a named parameter with an
assumed value, marked [I] where it is described.
"""

from dolfinrod.groove import toml
from dolfinrod.groove.air import LineSink
from dolfinrod.groove.bundle import Bundle
from dolfinrod.groove.clock import Progress
from dolfinrod.groove.comparison import Comparison, Measured, Verdict, compare, difference, measured, verdict
from dolfinrod.groove.core import FixedCore, RollingCore
from dolfinrod.groove.course import Course, course
from dolfinrod.groove.delivery import delivery
from dolfinrod.groove.ends import Ends
from dolfinrod.groove.ensemble import Ensemble, ensemble
from dolfinrod.groove.film import Film, filmed
from dolfinrod.groove.measures import Along, Measures, measure
from dolfinrod.groove.page import report
from dolfinrod.groove.parameters import Parameter, parameters
from dolfinrod.groove.pressing import Pressing
from dolfinrod.groove.rows import rows, write_rows
from dolfinrod.groove.runs import Folder, Run
from dolfinrod.groove.scenario import Scenario
from dolfinrod.groove.sections import CrossSection
from dolfinrod.groove.statistics import Interval, Test
from dolfinrod.groove.sweep import grid, sweep
from dolfinrod.groove.table1 import INTERMEDIATE, LATERAL, Yarn
from dolfinrod.groove.variants import VARIANTS, variant, varied

__all__ = [
    "INTERMEDIATE",
    "LATERAL",
    "VARIANTS",
    "Along",
    "Bundle",
    "Comparison",
    "Course",
    "CrossSection",
    "Ends",
    "Ensemble",
    "Film",
    "FixedCore",
    "Folder",
    "Interval",
    "LineSink",
    "Measured",
    "Measures",
    "Parameter",
    "Pressing",
    "Progress",
    "RollingCore",
    "Run",
    "Scenario",
    "Test",
    "Verdict",
    "Yarn",
    "compare",
    "course",
    "delivery",
    "difference",
    "ensemble",
    "filmed",
    "grid",
    "measure",
    "measured",
    "parameters",
    "report",
    "rows",
    "sweep",
    "toml",
    "varied",
    "variant",
    "verdict",
    "write_rows",
]
