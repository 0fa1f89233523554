"""`python -m dolfinrod.cli`, the same as `dolfinrod`."""

import sys

from dolfinrod.cli import main

sys.exit(main())
