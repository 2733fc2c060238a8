#!/usr/bin/env bash
# shellcheck disable=SC2154 # variables of the plan
# One task of the array: renders its chunk's frames; what an earlier try has finished is kept. Submitted by submit.sh.
#   task.sh FOLDER ROUND
set -uo pipefail

most_restarts=3
# shellcheck source=/dev/null
. "$1/farm/plan"  # sets folder, program, words, sequence, pattern
frames=$(sed -n "$((SLURM_ARRAY_TASK_ID + 1))p" "$folder/farm/chunks.$2")
memory=()
[ -z "${SLURM_MEM_PER_NODE:-}" ] || memory=(--max-memory "${SLURM_MEM_PER_NODE}M")
echo "frames $frames, try $((${SLURM_RESTART_COUNT:-0} + 1)), on ${SLURMD_NODENAME:-$(hostname)}"

# --signal and preemption send SIGTERM to all of the step: render then finishes its frame, and bash must outlive it.
trap : TERM
"$program" render "${words[@]}" -q --frames "$frames" --sequence "$sequence" -o "$pattern" --existing resume \
  --threads "${SLURM_CPUS_PER_TASK:-1}" "${memory[@]}" &
render=$!
status=0
wait "$render" || status=$?
while kill -0 "$render" 2>/dev/null; do  # the trap has ended the wait, not the render
  status=0
  wait "$render" || status=$?
done

# Killed (by the kernel for its memory, by hand): once more, elsewhere perhaps. What it says itself is final.
if [ "$status" -gt 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt "$most_restarts" ]; then
  echo "ended by signal $((status - 128)); queued again"
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID" && sleep 60
fi
exit "$status"
