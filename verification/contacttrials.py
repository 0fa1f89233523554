"""Cases of contact as units of work."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import partial

from verification import contacts, meetings
from verification.contact import contactstudy
from verification.contactcase import ContactCase
from verification.ledger import Unit

__all__ = ["CONTACT", "MEETINGS", "ContactTrials"]

Key = tuple[str | int | float, ...]


@dataclass(frozen=True)
class ContactTrials:
    """Cases that are chosen like a family: one of them as "name:CASE", those of a family as "name:FAMILY".

    Args:
        name: Of them all.
        words: What they are, for people.
        topic: Of the report.
        cases: In its order.
    """

    name: str
    words: str
    topic: str
    cases: tuple[ContactCase, ...] = field(repr=False)

    def names(self) -> tuple[str, ...]:
        """Whatever may be asked for by name."""
        families = (case.family for case in self.cases)
        return (self.name, *dict.fromkeys(map(self.asked_as, (*families, *(case.name for case in self.cases)))))

    def asked_as(self, name: str) -> str:
        """Under which a case or a family is asked for."""
        return f"{self.name}:{name.removeprefix(f'{self.name}-').replace(' ', '-')}"

    def chosen(self, asked: tuple[str, ...]) -> tuple[ContactCase, ...]:
        """Cases that names out of `names()` stand for; others are passed over."""
        wanted = set(asked)
        return tuple(
            case for case in self.cases if {self.name, self.asked_as(case.family), self.asked_as(case.name)} & wanted
        )

    def listing(self, asked: tuple[str, ...]) -> Iterator[tuple[str, str]]:
        """Name and title of what is asked for, a line each, members indented."""
        chosen = self.chosen(asked)
        if chosen:
            yield self.name, self.words
        for case in chosen:
            yield f"  {self.asked_as(case.name)}", case.title

    def units(self, asked: tuple[str, ...], *, quick: bool) -> Iterator[Unit]:
        """What is to be done, in the order of the report; of quick ones only the runs that are marked."""
        for case in self.chosen(asked):
            for run in case.runs:
                if run.quick or not quick:
                    words = f"{case.title}: {run.model}, {run.label}"
                    key: Key = (case.name, run.model, run.label, *run.levels)
                    yield Unit(self.topic, words, key, partial(contactstudy, case, run))


CONTACT = ContactTrials("contact", "rods on rigid surfaces, by both models", "contact", contacts.CASES)
MEETINGS = ContactTrials("meetings", "rods on rods, by both models", "meeting", meetings.CASES)
