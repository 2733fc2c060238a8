#!/usr/bin/env bash
# Renders the pictures of docs/gallery.md: the default view of well-known scenes, which are not part of the project.
#
#   scripts/gallery.sh SCENES   where teapot/teapot.obj, sibenik/sibenik.obj and so on lie
set -euo pipefail
scenes=$(realpath "$1")
cd "$(dirname "$0")/.."

# NAME SCENE [OPTIONS]: its picture, and the one from the other side of the turntable.
picture() {
  local name=$1 frame
  shift
  for frame in 1 3; do
    build/release/bin/hybridrt render "$@" --frames $frame-$frame --sequence 1-4 --size 320x240 --samples 8 --quiet \
      --timings /dev/null -o "docs/gallery/$name.#.png"
  done
}

picture armadillo "$scenes/armadillo/armadillo.obj"
picture teapot "$scenes/teapot/teapot.obj"
picture sports_car "$scenes/sports_car/sportsCar.obj"
picture sports_car_ground "$scenes/sports_car/sportsCar.obj" --ground
picture scrub_pine "$scenes/scrub_pine/scrubPine.obj"
picture mori_knob "$scenes/mori_knob/testObj.obj"
picture cornell_box "$scenes/cornell_box/CornellBox-Mirror.obj"
picture cornell_box_glossy "$scenes/cornell_box/CornellBox-Glossy.obj"
picture sibenik "$scenes/sibenik/sibenik.obj"
picture holodeck "$scenes/holodeck/holodeck.obj"
picture delft "$scenes/delft_extent/extent_red.obj" --up-axis z
picture chess scene:chess
picture spheres scene:spheres
picture thin scene:thin
rm -f docs/gallery/run*.json docs/gallery/*.run*.json
