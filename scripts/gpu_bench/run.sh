#!/usr/bin/env bash
# Checks hybridrt's OpenGL passes on this machine against the CPU's, times them, and writes a table. Part of the pack of
# scripts/gpu_bench.sh; needs no Python.
#
#   ./run.sh [-o gpu.md] [--frames 20] [--sizes "500k 5M"] [--scenes "spheres chess thin"] [--size 1024x768] [--software]
#
# Each picture must have the CPU's ids at every pixel, and at least 60 dB to the CPU's picture. --software also measures an
# OpenGL that is none of a GPU's. Exit code 4: no GPU; 6: a picture differs, or a reference picture of the project.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
table=gpu.md frames=20 sizes="500k 5M" scenes="spheres chess thin" size=1024x768 hardware=--require-hardware least_db=60
while [ $# -gt 0 ]; do
  case $1 in
    -o) table=$2; shift ;;
    --frames) frames=$2; shift ;;
    --sizes) sizes=$2; shift ;;
    --scenes) scenes=$2; shift ;;
    --size) size=$2; shift ;;
    --software) hardware= ;;
    *) echo "run.sh: $1: not known; the options are at the top of this file" >&2; exit 2 ;;
  esac
  shift
done

# Libraries: ours first; the GL loader's only where the machine has none.
export LD_LIBRARY_PATH="$here/lib/hybridrt${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
has_loader() { ldconfig -p 2>/dev/null | grep -q 'libEGL\.so\.1 '; }
has_loader || export LD_LIBRARY_PATH="$LD_LIBRARY_PATH:$here/lib/glvnd"
hybridrt=$here/bin/hybridrt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$hybridrt" doctor
# shellcheck disable=SC2086  # no word where a software GL will do
"$hybridrt" render scene:spheres,triangles=10k --size 64x48 --gl egl $hardware -q -o "$work/first.png" || exit 4
value_of() { sed -n "s/.*\"$2\": *\"\([^\"]*\)\".*/\1/p" "$1" | head -n 1; } # text of a key of run.json
renderer=$(value_of "$work/run.json" renderer)
processor=$(value_of "$work/run.json" processor)
failed=0

golden=$("$hybridrt" golden check --gl egl -o "$work/golden" 2>&1) || failed=6
golden=$(grep -v '^$' <<<"$golden" | tail -n 1)
golden=${golden%%; report:*}

median_of() { # of a column of a timings.csv, over the frames after the first
  awk -F, -v name="$2" 'NR == 1 {for (i = 1; i <= NF; ++i) if ($i == name) at = i} NR > 2 {print $at}' "$1" | sort -g |
    awk '{v[NR] = $1} END {printf "%.2f", NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2}'
}
render() { # SCENE SHADOWS GL FRAMES FOLDER
  "$hybridrt" render "$1" --size "$size" --shadows "$2" --gl "$3" --frames "$4" --sequence 1-100 --aov id -q \
    -o "$5/frame.####.png" --timings "$5/timings.csv"
}
# The least PSNR, dB, of the GPU's first two frames to the CPU's, "inf" if they are equal.
psnr_of() { # PICTURE, in both folders
  local least=inf db frame answer code
  for frame in 0001 0002; do
    code=0
    answer=$("$hybridrt" compare "$work/gl/${1/FRAME/$frame}" "$work/cpu/${1/FRAME/$frame}" --json) || code=$?
    [ $code -eq 0 ] || [ $code -eq 6 ] || exit $code
    db=$(sed -n 's/.*"psnr_db":\([^,]*\).*/\1/p' <<<"$answer")
    case $db in
      null | *inf*) ;;
      *) least=$(awk -v a="$least" -v b="$db" 'BEGIN {printf "%.1f", (a == "inf" || b < a) ? b : a}') ;;
    esac
  done
  echo "$least"
}
is_alike() { # DB
  awk -v db="$1" -v least=$least_db 'BEGIN {exit !(db == "inf" || db + 0 >= least)}'
}

passes="shadow_map id mark readback trace upload shade download"
{
  echo "$renderer; $processor; $("$hybridrt" --version | head -n 1). $size, medians of $frames frames after the first, ms."
  echo "Reference pictures of the project, drawn here: $golden"
  echo
  echo "| scene | shadows | passes on | 1 shadow map | 2 ids | 3 marking | readback | 4 rays | upload | 5 shading | download | from frame to frame | least PSNR |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
} >"$work/table"
for scene in $scenes; do
  for triangles in $sizes; do
    for shadows in exact blur; do
      source=scene:$scene,triangles=$triangles
      render "$source" "$shadows" off 2 "$work/cpu"
      render "$source" "$shadows" egl "$frames" "$work/gl"
      psnr=$(psnr_of frame.FRAME.png)
      # "exact" corrects the ids that OpenGL drew. "blur" does not, and its map's texels are the driver's: told, not held.
      if [ "$shadows" = exact ]; then
        is_alike "$psnr" || { failed=6; psnr="**$psnr**"; }
        [ "$(psnr_of frame.id.FRAME.png)" = inf ] || { failed=6; psnr+=", **other ids**"; }
      fi
      for form in gl cpu; do
        cells=
        for pass in $passes; do cells+=" $(median_of "$work/$form/timings.csv" "${pass}_ms") |"; done
        [ $form = gl ] && told=$psnr || told=
        echo "| $scene, $triangles | \`$shadows\` | $form |$cells $(median_of "$work/$form/timings.csv" wall_ms) | $told |" >>"$work/table"
      done
      rm -rf "$work/cpu" "$work/gl"
      echo "$source, $shadows: $psnr" >&2
    done
  done
done
cp "$work/table" "$table"
cat "$table"
exit $failed
