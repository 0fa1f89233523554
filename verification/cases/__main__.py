"""`python -m verification.cases`: compute the references of verification/references/bvp.json anew."""

from __future__ import annotations

import json
from pathlib import Path

from verification import references
from verification.cases import CASES, spans
from verification.references.solved import Solved, computed

__all__ = ["main"]


def main() -> None:
    """Solve every boundary-value problem that a case refers to, and write the file."""
    known = [case.reference for case in (*CASES, *spans.ALIGNED, *spans.FAR)]
    entries = {one.id: computed(one.problem, one.at) for one in known if isinstance(one, Solved)}
    path = Path(references.__file__).with_name("bvp.json")
    path.write_text(json.dumps(entries, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
