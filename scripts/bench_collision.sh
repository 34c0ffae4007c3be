#!/usr/bin/env bash
# The collision certificate beside coal and HPP, and paths around obstacles beside OMPL, one pinned core: prints tables in
# Markdown. Run by scripts/bench.sh, or alone after `make bench` has built the programs. Scenes are the problems of
# MotionBenchMaker in BENCH_PROBLEMS, a folder with panda_problems.tar.xz and panda_spherized.urdf; what is not there is left
# out and said to be. BENCH_EDGES (edges of a scene from random configurations, and from its goal), BENCH_SCENES, BENCH_REFINE
# (division of an interval of 0.05 rad for the referee), BENCH_PLANNED (problems that OMPL solves, in ten minutes),
# BENCH_PAIRS (of every two kinds of shapes) change what is run; BENCH_FOLDER replaces build/bench.
set -uo pipefail
cd "$(dirname "$0")/.." || exit
folder=${BENCH_FOLDER:-build/bench}
source=${BENCH_PROBLEMS:-../shared/data/motion_bench_maker}
problems=$folder/motion_bench_maker
edges=${BENCH_EDGES:-2} scenes=${BENCH_SCENES:-1000} refine=${BENCH_REFINE:-50}
prefix=$(echo .venv-bench/lib/python3*/site-packages/cmeel.prefix)
robots=$prefix/share/example-robot-data/robots
status=0

section() {
  printf '\n### %s\n\n' "$1"
}

# edges TITLE ARM [OPTION...]: certified and sampled edges.
edges() {
  section "Edges of 1 rad: $1"
  if [[ ! -f $2 ]]; then
    echo "Left out: $2 is not there"
    return
  fi
  "$folder/bench_edges" "${@:2}" --edges "$edges" --scenes "$scenes" --refine "$refine" || status=1
}

# paths TITLE ARM: paths around the obstacles of the problems, BENCH_PLANNED of them by OMPL too.
paths() {
  section "Paths around obstacles: $1"
  if [[ ! -f $2 ]]; then
    echo "Left out: $2 is not there"
    return
  fi
  "$folder/bench_free_paths" "$2" "$problems" --out "$folder/paths.jsonl" || status=1
  section "The same problems, by OMPL: $1"
  if .venv-bench/bin/python -c 'import ompl' 2>/dev/null; then
    PYTHONPATH=build/python .venv-bench/bin/python -B bench/collision/ompl_paths.py "$folder/paths.jsonl" "$2" \
      --problems "${BENCH_PLANNED:-1000}" || status=1
  else
    echo "Left out: OMPL is not installed"
  fi
}

section "Certified clearance of a line of 1 m, and of edges of 1 rad"
"$folder/bench_clearance" || status=1
section "Distances of random pairs: coal beside the bounds that are proved"
"$folder/bench_distances" "${BENCH_PAIRS:-2000}" || status=1

if [[ -f $source/panda_problems.tar.xz ]]; then
  mkdir -p "$problems"
  tar -xJf "$source/panda_problems.tar.xz" -C "$problems"
  spheres=$source/panda_spherized.urdf
  edges "MotionBenchMaker, Panda as 59 spheres" "$spheres" --problems "$problems" --out "$folder/edges.jsonl"
  section "The same edges, validated by HPP"
  LD_LIBRARY_PATH=$prefix/lib .venv-bench/bin/python -B bench/collision/hpp_edges.py "$folder/edges.jsonl" "$spheres" ||
    echo "Left out: hpp-python cannot run here"
  edges "MotionBenchMaker, Panda as hulls" "$robots/panda_description/urdf/panda.urdf" --problems "$problems"
  paths "Panda as 59 spheres" "$spheres"
  paths "Panda as hulls" "$robots/panda_description/urdf/panda.urdf"
else
  echo "Left out: problems of MotionBenchMaker, which $source lacks"
fi
scenes=${BENCH_BOX_SCENES:-100}
edges "20 random boxes, UR5 as hulls" "$robots/ur_description/urdf/ur5_robot.urdf"
exit "$status"
