"""All that a report shows: the runs, sorted, and the films of those that it is about."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from dolfinrod.groove.film import Film
from dolfinrod.groove.page.acceptance import Judged, acceptance
from dolfinrod.groove.page.settings import Setting, settings
from dolfinrod.groove.runs import Folder, Run

__all__ = ["SIDES", "Show"]

# From the left to the right, as the paper sets them side by side.
SIDES = ("intermediate", "lateral", "lateral_steep")


@dataclass(frozen=True, eq=False)
class Show:
    """What a report shows.

    Args:
        runs: All of the folder.
        settings: Those of the runs, first the one that pictures and verdict are about.
        films: Of its runs that have an end, by kind from the left to the right of the page, seeds ascending.
        judged: The acceptance.
    """

    runs: tuple[Run, ...]
    settings: tuple[Setting, ...]
    films: dict[str, tuple[Film, ...]]
    judged: tuple[Judged, ...]

    @classmethod
    def of(cls, folder: Folder, runs: Sequence[Run]) -> Show:
        """Read the films and judge.

        Args:
            folder: Where they are.
            runs: All of it, at least one of which has an end.
        """
        found = settings(runs)
        base = found[0]
        kinds = sorted(base.kinds, key=SIDES.index)
        films = {kind: tuple(folder.film(run.key) for run in base.of(kind)) for kind in kinds}
        return cls(tuple(runs), found, films, acceptance(found, folder))

    @property
    def base(self) -> Setting:
        """What pictures and verdict are about."""
        return self.settings[0]

    @property
    def shown(self) -> dict[str, tuple[Run, Film]]:
        """The run of each kind that single pictures show: of the lowest seed that all have, or else its lowest."""
        seeds = [{run.seed for run in self.base.of(kind)} for kind in self.base.kinds]
        common = set.intersection(*seeds)
        found = {}
        for kind, films in self.films.items():
            runs = self.base.of(kind)
            seed = min(common or {run.seed for run in runs})
            at = next(i for i, run in enumerate(runs) if run.seed == seed)
            found[kind] = runs[at], films[at]
        return found
