#!/usr/bin/env bash
# The main job, on the chapter's arm and on a real one: the tool moves through poses in straight
# lines, and out come a joint trajectory, a picture and a report of how straight it was.
# Usage: demo.sh BEELINE FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
beeline=$1
folder=$2
mkdir -p "$folder"

# line ARM... : shows the command as one would type it, then runs it.
line() {
  local name=$1
  shift
  local command=("$beeline" line "$@" --degrees
                 --out "$folder/$name.csv" --draw "$folder/$name.svg")
  echo "\$ ${command[*]}"
  "${command[@]}"
  echo
}

ready=0,-45,0,-135,0,90,45
line rrr rrr --from 0,90,0 --through examples/waypoints_rrr.csv
line panda panda --from "$ready" --through examples/waypoints_panda.csv

# The same on the maker's own description, where the tests' environment has brought it.
urdf=$(find .venv -path '*/example-robot-data/robots/panda_description/urdf/panda.urdf' \
         2>/dev/null || true)
if [[ -n $urdf ]]; then
  line panda_urdf "$urdf" --tip panda_hand_tcp --from "$ready" \
    --through examples/waypoints_panda.csv
fi

"$beeline" figure all --out "$folder" >/dev/null
for figure in 1.7 1.9; do
  "$beeline" figure "$figure" --animate "$folder/figure_${figure}_moving.svg" >/dev/null
done

echo "Pictures, the chapter's figures among them:"
printf '  %s\n' "$folder"/*.svg
