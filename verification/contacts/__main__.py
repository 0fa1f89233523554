"""`python -m verification.contacts`: compute the references of contact.json anew that are problems of this project."""

from __future__ import annotations

import json
from pathlib import Path

from verification import references
from verification.references.contact import solved_anew

__all__ = ["main"]


def main() -> None:
    """Solve them twice and write the file, other entries as they are."""
    path = Path(references.__file__).with_name("contact.json")
    kept = json.loads(path.read_text(encoding="utf-8"))
    kept |= solved_anew()
    path.write_text(json.dumps(kept, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
