"""`python -m verification.meetings`: compute the references of meetings.json anew."""

from __future__ import annotations

import json
from pathlib import Path

from verification import references
from verification.references.meetings import solved_anew

__all__ = ["main"]


def main() -> None:
    """Solve them by both methods and write the file."""
    path = Path(references.__file__).with_name("meetings.json")
    path.write_text(json.dumps(solved_anew(), indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
