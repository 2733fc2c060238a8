#!/usr/bin/env bash
# Renders a sequence on a Slurm farm: an array of tasks with some frames each, then a job that joins their tables and
# submits what is missing once more. docs/farm.md explains it.
#
#   submit.sh -o SHARED/NAME.####.png --sequence A-B [OPTIONS] SCENE [RENDER OPTIONS]
#   submit.sh --again SHARED [OPTIONS]     what is missing of a sequence that was submitted before
#
#   --chunk N     frames of a task (default 10): some minutes of work, many times what loading the scene takes
#   --at-once N   tasks that run at the same time (default: as many as Slurm lets)
#   --cpus N      processors of a task (default 4)
#   --memory M    of a task, as sbatch --mem takes it (default: the partition's)
#   --rounds N    how often in all the missing frames are submitted (default 3)
#   --program P   the hybridrt to run (default: the first in PATH)
#
# Partition, account and time limit come from sbatch's own variables: SBATCH_PARTITION, SBATCH_ACCOUNT, SBATCH_TIMELIMIT.
set -euo pipefail

fail() {
  echo "submit.sh: $*" >&2
  exit 2
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
chunk=10 at_once=0 cpus=4 memory='' rounds=3 round='' sequence='' pattern='' program='' again=''
while [ $# -gt 0 ]; do
  case $1 in -*) [ $# -gt 1 ] || fail "$1 has no value" ;; esac
  case $1 in
    -o | --output) pattern=$2 ;;
    --sequence) sequence=$2 ;;
    --chunk) chunk=$2 ;;
    --at-once) at_once=$2 ;;
    --cpus) cpus=$2 ;;
    --memory) memory=$2 ;;
    --rounds) rounds=$2 ;;
    --program) program=$2 ;;
    --again)
      again=$2 plan=$2/farm/plan
      [ -f "$plan" ] || fail "$2 holds no farm/plan; name the folder of a sequence that was submitted"
      # shellcheck source=/dev/null
      . "$plan"
      ;;
    --round) round=$2 ;;
    -*) fail "$1: not known before SCENE; see the head of this file" ;;
    *) break ;;
  esac
  shift 2
done

# Frames as render takes them, one chunk of $2 frames a line.
chunks_of() {
  awk -v frames="$1" -v size="$2" '
    function flush_run() { if (first != "") text = text (text == "" ? "" : ",") (first == last ? first : first "-" last); first = "" }
    function flush_chunk() { flush_run(); if (text ~ /^[0-9]+$/) text = text "-" text; if (text != "") print text; text = ""; count = 0 }
    function add(frame) {
      if (first != "" && frame == last + 1) last = frame
      else { flush_run(); first = last = frame }
      if (++count == size) flush_chunk()
    }
    BEGIN {
      parts = split(frames, part, ",")
      for (i = 1; i <= parts; ++i) {
        split(part[i], range_step, ":"); split(range_step[1], bound, "-")
        end = bound[2] == "" ? bound[1] : bound[2]; step = range_step[2] == "" ? 1 : range_step[2]
        for (frame = bound[1] + 0; frame <= end + 0; frame += step) add(frame)
      }
      flush_chunk()
    }'
}

if [ -n "$again" ]; then
  # Exit code 3: no task has come so far as to write its tables.
  status=0
  frames=$("$program" merge "$folder" --missing) || status=$?
  [ "$status" -ne 3 ] || frames=$sequence
  [ -n "$frames" ] || { echo "nothing is missing in $folder"; exit 0; }
  for ((last = 1; ; ++last)); do [ -e "$folder/farm/chunks.$last" ] || break; done
  round=${round:-$last}
else
  [[ $sequence =~ ^[0-9]+-[0-9]+$ ]] || fail "--sequence '$sequence': the first and the last frame are needed, like 1-240"
  [[ $chunk =~ ^[1-9][0-9]*$ ]] || fail "--chunk $chunk: must be at least 1"
  [ $# -gt 0 ] || fail "which SCENE? See the head of this file"
  case $pattern in
    *'{'*/*) fail "-o $pattern: the folder must be the same for all frames" ;;
    */*'#'*) ;;
    *) fail "-o '$pattern': write a folder that all nodes share and a name, like /shared/car/car.####.png" ;;
  esac
  program=${program:-$(command -v hybridrt)} || fail "no hybridrt in PATH; name it by --program"
  words=("$@")
  # All nodes must draw alike: without a --gl those with a GPU would not.
  case " $* " in *' --gl'*) ;; *) words+=(--gl off) ;; esac
  folder=${pattern%/*}
  mkdir -p "$folder/farm"
  folder=$(cd "$folder" && pwd)
  pattern=$folder/${pattern##*/}
  directory=$PWD frames=$sequence round=1
  rm -f "$folder"/farm/chunks.*
  plan=$folder/farm/plan
  declare -p words sequence pattern folder chunk at_once cpus memory rounds program here directory |
    sed 's/^declare -- //' >"$plan.new"
  mv "$plan.new" "$plan"
fi

chunks_of "$frames" "$chunk" >"$folder/farm/chunks.$round"
tasks=$(wc -l <"$folder/farm/chunks.$round")
limit='' memory_option=()
[ "$at_once" -eq 0 ] || limit=%$at_once
[ -z "$memory" ] || memory_option=(--mem="$memory")

# A task whose node dies or is taken away is queued again by --requeue; it goes on where it was.
array=$(sbatch --parsable --requeue --array="0-$((tasks - 1))$limit" --cpus-per-task="$cpus" "${memory_option[@]}" \
  --job-name=hybridrt --chdir="$directory" --open-mode=append --output="$folder/farm/task.$round.%a.log" \
  "$here/task.sh" "$folder" "$round")
joining=$(sbatch --parsable --dependency="afterany:$array" --cpus-per-task=1 --job-name=hybridrt-merge \
  --chdir="$directory" --output="$folder/farm/merge.$round.log" "$here/merge.sh" "$folder" "$round")
echo "frames $frames: $tasks tasks (job $array), then merge (job $joining); logs in $folder/farm"
