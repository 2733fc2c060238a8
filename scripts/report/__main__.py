"""Started as `python3 scripts/report DIR`: Python then sees this folder's files, not the package that they form."""
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parent.parent)

from report.command import main  # noqa: E402, the path comes first

sys.exit(main(sys.argv[1:]))
