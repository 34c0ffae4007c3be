#!/usr/bin/env bash
# Beeline beside others on the same poses, one pinned thread: prints tables in Markdown and writes
# build/bench/results.json. Peers that cannot be had are left out and said to be.
# Then looks for solutions that Beeline missed and for wrong ones, and compares with
# bench/baseline.json; fails where it finds any or Beeline lost. BENCH_COUNT (poses an arm),
# BENCH_PASSES (rounds), BENCH_REPETITIONS, BENCH_CORE, BENCH_ARMS, BENCH_COMPLETE (poses an arm),
# BENCH_HONEST (poses in all), BENCH_MARKET (poses an arm of ssik's), BENCH_SPLINES and BENCH_STEPS (of the servo) change
# what is run;
# BENCH_FOLDER replaces build/bench.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${BENCH_FOLDER:-build/bench}
results=$folder/results.json
python=.venv-bench/bin/python
count=${BENCH_COUNT:-1000}
passes=${BENCH_PASSES:-3}
read -ra arms <<<"${BENCH_ARMS:-puma560 ur5 stanford general_6r panda iiwa14 panda_q7 iiwa14_q7}"
status=0

# section TITLE: a heading, and on the terminal how long everything has taken so far.
section() {
  printf '\n### %s\n\n' "$1"
  printf '%d:%02d  %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$1" >&2
}

# google PROGRAM: repetitions in mixed order, so that what disturbs the machine meets Beeline and its
# peers alike, and shows as spread.
google() {
  "$folder/bench_$1" --benchmark_enable_random_interleaving=true \
    --benchmark_repetitions="${BENCH_REPETITIONS:-9}" --benchmark_min_time=0.02 \
    --benchmark_out="$folder/$1.json" --benchmark_out_format=json >"$folder/$1.log" ||
    { cat "$folder/$1.log" && return 1; }
  python3 -B bench/kinematics/report.py "$results" "$folder/$1.json"
}

# draw FILE.md XLABEL YLABEL
draw() {
  "$python" -B bench/draw_growth.py "$2" "$3" "${1%.md}.svg" <"$1" &&
    echo -e "\nDrawn: ${1%.md}.svg"
}

section "Instructions of a single call (AVX2)"
python3 -B bench/kinematics/count.py "$folder/bench_instructions" "$folder/instructions.json" ||
  status=1

rm -f "$folder"/*/*.jsonl
for ((round = 1; round <= passes; ++round)); do
  section "Inverse kinematics, round $round of $passes"
  for arm in "${arms[@]}"; do
    "$folder/bench_inverse" "$arm" --count "$count" --passes 1 --folder "$folder" >&2
    mv "$folder/$arm/native.jsonl" "$folder/$arm/native.$round.jsonl"
  done
  "$python" -B bench/inverse/peers.py "${arms[@]/#/$folder/}" --passes 1 >&2
  for arm in "${arms[@]}"; do mv "$folder/$arm/peers.jsonl" "$folder/$arm/peers.$round.jsonl"; done
done
model=$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -n 1)
echo "Machine: ${model:-unknown processor}, $(nproc) cores, $(uname -sm), $("${CXX:-c++}" --version | head -n 1)," \
  "$("$python" --version); one pinned thread, $count poses an arm, median of $passes rounds"
"$python" -B bench/inverse/table.py "$folder"

section "Completeness: exhaustive numerical search against \`all solutions\`"
"$folder/bench_inverse_completeness" --count "${BENCH_COMPLETE:-100}" || status=1
section "Honesty: every configuration returned, put through forward kinematics"
"$folder/bench_inverse_honesty" --count "${BENCH_HONEST:-100000}" || status=1
section "Cost of an iteration of the numerical solver by the number of joints"
"$folder/bench_inverse_growth" | tee "$folder/inverse_growth.md" || status=1
draw "$folder/inverse_growth.md" joints "µs an iteration" || status=1
section "Arms on rails and mobile bases"
"$folder/bench_moving_base" || status=1

section "Kinematics, one configuration at a time, nanoseconds"
google kinematics || status=1
section "Kinematics of many configurations, nanoseconds a configuration"
"$folder/bench_peak"
echo
google batch || status=1
section "Forward kinematics by the number of joints"
"$folder/bench_kinematics_growth" joints | tee "$folder/forward_by_joints.md"
draw "$folder/forward_by_joints.md" joints "ns a call" || status=1
section "Forward kinematics by the number of configurations"
"$folder/bench_kinematics_growth" configurations | tee "$folder/forward_by_configurations.md"
draw "$folder/forward_by_configurations.md" configurations µs || status=1
section "Motions from rest to rest, nanoseconds"
google point_to_point || status=1
section "Time-optimal scaling of splines"
"$python" -B bench/motion/retime.py "$folder/bench_retime" --count "${BENCH_SPLINES:-50}" || status=1
section "Joint motions through waypoints, beside toppra and ruckig"
PYTHONPATH=build/python "$python" -B bench/motion/through.py --paths "${BENCH_PATHS:-1}" || status=1
section "A step of the servo"
"$folder/bench_servo" "${BENCH_STEPS:-1000000}"

section "Collisions"
scripts/bench_collision.sh || status=1

section "Formulas: operations"
"$python" -B bench/formula/operations.py build/beeline || status=1
section "Formulas: forward kinematics and Jacobian"
"$python" -B bench/formula/timing.py build/beeline build || status=1

section "Calls from Python, microseconds"
PYTHONPATH=build/python "$python" -B bench/python/calls.py "$folder" || status=1

section "Inverse kinematics of the arms that ssik brings along, called from Python"
PYTHONPATH=build/python "$python" -B bench/inverse/market.py --poses "${BENCH_MARKET:-100}" || status=1

section "Against bench/baseline.json"
python3 -B bench/baseline.py check "$results" "$folder/instructions.json" bench/baseline.json ||
  status=1
exit "$status"
