"""Numbers in sentences."""

from __future__ import annotations

from dolfinrod.groove.statistics import Interval

__all__ = ["counted", "interval", "plain", "signed"]

NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")


def plain(value: float, digits: int = 1) -> str:
    """A number with a true minus, and no minus before zero."""
    text = f"{value:.{digits}f}"
    return text.lstrip("-") if float(text) == 0.0 else text.replace("-", "−")


def signed(value: float, digits: int = 1) -> str:
    """A number with its sign, zero without."""
    text = plain(value, digits)
    return text if text.startswith("−") or float(text) == 0.0 else f"+{text}"


def interval(of: Interval, digits: int = 1) -> str:
    """An estimate with the ends of its interval; one value that all runs share has none."""
    if of.low == of.high:
        return f"{plain(of.value, digits)} (no scatter)"
    return f"{plain(of.value, digits)} ({plain(of.low, digits)} to {plain(of.high, digits)})"


def counted(n: int, what: str) -> str:
    """Such as "two runs"."""
    number = NUMBERS[n] if n < len(NUMBERS) else str(n)
    return f"{number} {what}{'' if n == 1 else 's'}"
