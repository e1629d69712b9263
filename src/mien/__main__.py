"""``python -m mien``."""

from .cli import main

raise SystemExit(main())
