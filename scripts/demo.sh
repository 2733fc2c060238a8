#!/usr/bin/env bash
# Shows what hybridrt does: sets up the machine, builds, renders a short sequence of mirroring balls, and prints the
# time of each pass and the paths of the results. Takes about a minute once built.
#
#   scripts/demo.sh [options of hybridrt render, like --frames 10 or --method raytrace]
set -euo pipefail
cd "$(dirname "$0")/.."

folder=out/demo
options=("$@")

# Adds no option that the user gave: the command line takes each only once.
default_option() {
  local given
  for given in "${options[@]}"; do
    case $given in "$1" | "$1"=*) return 0 ;; esac
  done
  options+=("$1" "$2")
}

# Frames get their names only when they are complete. The progress bar draws over itself: clear its line.
announce_first_image() {
  local images
  while true; do
    images=("$folder"/frame.*.png)
    if [ -e "${images[0]}" ]; then
      if [ -t 2 ]; then printf '\r\033[K' >&2; fi
      echo "first image: ${images[0]}" >&2
      return
    fi
    sleep 0.1
  done
}

scripts/setup.sh
scripts/build.sh release hybridrt

mkdir -p "$folder"
rm -f "$folder"/*.png
default_option --frames 1-72
default_option --size 1280x720

announce_first_image &
watcher=$!
trap 'kill "$watcher" 2>/dev/null || true' EXIT
build/release/bin/hybridrt render scene:spheres,triangles=200000,reflective=15 \
  -o "$folder/frame.####.png" --contact-sheet "$folder/contact_sheet.png" "${options[@]}"
