"""`python -m verification.motions`: compute the references of moving.json anew that a method of lines gives."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from verification import references
from verification.motions import swing

__all__ = ["main"]


def main() -> None:
    """Solve them on two polynomials and write the file, other entries as they are."""
    path = Path(references.__file__).with_name("moving.json")
    kept = json.loads(path.read_text(encoding="utf-8"))
    for name, (fine, coarse) in swing.solved_anew().items():
        kept[name]["quantities"] = dict(zip("xyz", fine.tolist(), strict=True))
        agreement = float(np.linalg.norm(fine - coarse))
        kept[name]["agreement"] = float(f"{agreement:.1e}")
        kept[name]["digits_trusted"] = int(-np.log10(agreement))
    path.write_text(json.dumps(kept, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
