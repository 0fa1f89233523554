"""What is said when a scene cannot be."""

from __future__ import annotations

__all__ = ["SceneError", "quoted"]

MOST_CHARACTERS = 1000


class SceneError(ValueError):
    """Input that poses no mechanical problem, in the user's words: the field, the rule, the value and its unit.

    An object knows its own field only (`Section.EI must be positive, got -1.0 N m²`); whoever knows where the
    object stands says so by `within` (`rods[0].section.EI must be …`).

    Args:
        message: The rule and the offending value; the whole sentence if `field` is empty.
        field: Dotted name of the field, its owner first, as in `Section.EI`.
    """

    def __init__(self, message: str, *, field: str = "") -> None:
        message, field = _short(message), _short(field)
        super().__init__(f"{field} {message}" if field else message)
        self.message = message
        self.field = field

    def within(self, path: str) -> SceneError:
        """The same complaint, its owner's name replaced by the place where the owner stands.

        Args:
            path: Where the owner stands, such as `loads[1].point_force`.

        Returns:
            The error to raise instead.
        """
        _, dot, rest = self.field.partition(".")
        return SceneError(self.message, field=path + dot + rest)


def quoted(value: object) -> str:
    """A value as it is quoted in a complaint.

    Args:
        value: Whatever was given.

    Returns:
        As Python writes it, but for whole numbers of thousands of digits, which Python refuses to write.
    """
    try:
        return repr(value)
    except ValueError:
        return "more digits than can be written"


def _short(text: str) -> str:
    """The text, without its middle where a quoted value makes it endless."""
    half = MOST_CHARACTERS // 2
    return text if len(text) <= MOST_CHARACTERS else f"{text[:half]} … {text[-half + 3 :]}"
