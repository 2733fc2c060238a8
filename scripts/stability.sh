#!/usr/bin/env bash
# Measures where methods fail, in both forms of the passes, and writes docs/stability.md: about four minutes.
#
#   scripts/stability.sh [OUT]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-out/stability}
hybridrt=build/release/bin/hybridrt

"$hybridrt" sweep --preset stability --gl off -o "$out/cpu"
"$hybridrt" sweep --preset stability --gl egl --no-charts -o "$out/gl"
python=python3
"$python" -c "import matplotlib" 2>/dev/null || python=/usr/bin/python3
"$python" scripts/stability_page.py "$out" docs/stability.md
