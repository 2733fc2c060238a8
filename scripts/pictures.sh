#!/usr/bin/env bash
# Renders every picture that README.md and docs/ show, into docs/images/.
set -euo pipefail
cd "$(dirname "$0")/.."
hybridrt=build/release/bin/hybridrt
out=docs/images

# By OpenGL, as in the paper.
render() { "$hybridrt" render "$@" --gl egl --quiet --timings /dev/null; }

render scene:chess,triangles=600000 --fov 33 --size 1280x720 --reflection-depth 8 --samples 16 -o "$out/chess.png"
render scene:thin --size 800x600 --samples 16 -o "$out/thin.png"

# The whole picture, and what each pass contributes (the paper's figure 3).
render scenes/still_life.obj --size 800x600 -o "$out/still_life.png" --reflection-depth 8 --samples 16
render scenes/still_life.obj --size 320x240 --shadows blur -o "$out/passes.png" --aov id,shadow,marked,traced

# Textures and holes.
render scenes/fronds.obj --size 640x480 --eye 2.6,2.2,3.6 --target -0.3,0.8,-0.6 --light 0.5,1,0.4 --samples 16 \
  -o "$out/fronds.png"

# Shadow boundaries without and with refinement (the paper's figures 8 and 9).
for shadows in map blur; do
  render scenes/still_life.obj --size 400x300 --eye 0.2,1.5,5.2 --target -1.9,0.15,1.6 --fov 26 --shadow-map 256 \
    --shadow-warp uniform --shadows "$shadows" -o "$out/shadows_$shadows.png"
done

# Glass and a polished board by generations of rays: none, one (the paper's figures), the default.
for depth in 0 1 4; do
  render scene:chess,triangles=600000 --size 1200x900 --crop 560,250,400,300 --reflection-depth "$depth" \
    -o "$out/depth_$depth.png"
done

# Thin casters: the paper's blur and what it gets wrong, the exact shadows, and what was traced for them.
thin=(scene:thin --size 1024x768 --crop 300,330,420,320)
render "${thin[@]}" --shadows blur -o "$out/triptych_blur.png" --aov shadow
render "${thin[@]}" --method reference -o "$out/triptych_truth.png" --aov shadow
render "${thin[@]}" --shadows exact -o "$out/triptych_exact.png" --aov marked
"$hybridrt" compare "$out/triptych_blur.shadow.png" "$out/triptych_truth.shadow.png" --diff "$out/triptych_errors.png" >/dev/null ||
  [ $? = 6 ] # they differ, which is what is shown
rm "$out"/triptych_blur*.png "$out"/triptych_truth*.png

# The paper's measuring scene.
render scene:spheres,triangles=500000,reflective=10 --size 800x600 --samples 16 -o "$out/spheres.png"
rm -f "$out"/*run.json
