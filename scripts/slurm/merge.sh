#!/usr/bin/env bash
# shellcheck disable=SC2154 # variables of the plan
# After the array, however its tasks ended: joins their tables, and submits the missing frames while there are rounds
# left. Its exit code is that of merge. Submitted by submit.sh.
#   merge.sh FOLDER ROUND
set -uo pipefail

# shellcheck source=/dev/null
. "$1/farm/plan"  # sets folder, program, rounds, here
status=0
"$program" merge "$folder" || status=$?
# 1: frames are missing or made otherwise; 3: no task has left its tables.
if { [ "$status" -eq 1 ] || [ "$status" -eq 3 ]; } && [ "$2" -lt "$rounds" ]; then
  "$here/submit.sh" --round "$(($2 + 1))" --again "$folder"
fi
exit "$status"
