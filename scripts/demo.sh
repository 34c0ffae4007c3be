#!/usr/bin/env bash
# The main job on the chapter's planar arm and on a Panda, with pictures.
# Usage: demo.sh COMMAND FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
beeline=$1
folder=$2
mkdir -p "$folder"

run() {
  echo "\$ beeline $*"
  "$beeline" "$@"
  echo
}

run line rrr --from 0,90,0 --degrees --through examples/waypoints_rrr.csv \
  --out "$folder/rrr.csv" --draw "$folder/rrr.svg"
run line panda --from 0,-45,0,-135,0,90,45 --degrees --through examples/waypoints_panda.csv \
  --out "$folder/panda.csv" --draw "$folder/panda.svg"

# The same on the URDF of a real arm, where `make test` has installed one.
for urdf in .venv/lib/python3*/site-packages/cmeel.prefix/share/example-robot-data/robots/panda_description/urdf/panda.urdf; do
  [[ -f $urdf ]] || continue
  run line "$urdf" --tip panda_hand_tcp --from 0,-45,0,-135,0,90,45 --degrees \
    --through examples/waypoints_panda.csv --out "$folder/panda_urdf.csv" --draw "$folder/panda_urdf.svg"
done

for figure in 1.3 1.6 1.7 1.8 1.9; do
  "$beeline" figure "$figure" --out "$folder/figure_$figure.svg" >/dev/null
done
echo "Pictures: $(cd "$folder" && pwd)"
ls "$folder"
