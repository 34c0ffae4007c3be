#!/usr/bin/env bash
# Beeline beside others on the same poses, one pinned thread: prints tables in Markdown and writes
# build/bench/results.json. Peers that cannot be had are left out and said to be.
# Then looks for solutions that Beeline missed and for wrong ones; fails if there are any.
# BENCH_COUNT (poses an arm), BENCH_PASSES (rounds), BENCH_CORE, BENCH_ARMS, BENCH_COMPLETE (poses an arm),
# BENCH_HONEST (poses in all) and BENCH_STEPS (of the servo) change what is run.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=build/bench
count=${BENCH_COUNT:-10000}
passes=${BENCH_PASSES:-3}
read -ra arms <<<"${BENCH_ARMS:-puma560 ur5 stanford general_6r panda iiwa14 panda_q7 iiwa14_q7}"

# Round by round and arm by arm, so that what disturbs the machine meets Beeline and its peers alike,
# and shows as spread.
rm -f "$folder"/*/*.jsonl
for ((round = 1; round <= passes; ++round)); do
  for arm in "${arms[@]}"; do
    "$folder/bench_inverse" "$arm" --count "$count" --passes 1 --folder "$folder" >&2
    .venv-bench/bin/python -B bench/inverse/peers.py "$folder/$arm" --passes 1 >&2
    mv "$folder/$arm/native.jsonl" "$folder/$arm/native.$round.jsonl"
    mv "$folder/$arm/peers.jsonl" "$folder/$arm/peers.$round.jsonl"
  done
done

model=$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -n 1)
echo "Machine: ${model:-unknown processor}, $(nproc) cores, $(uname -sm), $("${CXX:-c++}" --version | head -n 1)," \
  "$(.venv-bench/bin/python --version); one pinned thread, $count poses an arm, median of $passes rounds"
.venv-bench/bin/python -B bench/inverse/table.py "$folder"

status=0
echo -e "\n### Completeness: exhaustive numerical search against \`all solutions\`\n"
"$folder/bench_inverse_completeness" --count "${BENCH_COMPLETE:-1000}" || status=1
echo -e "\n### Honesty: every configuration returned, put through forward kinematics\n"
"$folder/bench_inverse_honesty" --count "${BENCH_HONEST:-1000000}" || status=1
echo -e "\n### Cost of an iteration of the numerical solver by the number of joints\n"
"$folder/bench_inverse_growth" | tee "$folder/inverse_growth.md" || status=1
.venv-bench/bin/python -B bench/draw_growth.py joints "µs an iteration" \
  "$folder/inverse_growth.svg" <"$folder/inverse_growth.md" || status=1
echo -e "\nDrawn: $folder/inverse_growth.svg"

echo -e "\n### Kinematics, one configuration at a time, nanoseconds\n"
"$folder/bench_kinematics" --benchmark_enable_random_interleaving=true \
  --benchmark_repetitions="${BENCH_REPETITIONS:-9}" --benchmark_min_time=0.05 \
  --benchmark_out="$folder/kinematics.json" --benchmark_out_format=json >&2
python3 -B bench/kinematics/report.py "$folder/results.json" "$folder/kinematics.json"
echo -e "\n### Kinematics of many configurations, nanoseconds a configuration\n"
"$folder/bench_peak"
echo
"$folder/bench_batch" --benchmark_enable_random_interleaving=true \
  --benchmark_repetitions="${BENCH_REPETITIONS:-9}" --benchmark_min_time=0.05 \
  --benchmark_out="$folder/batch.json" --benchmark_out_format=json >&2
python3 -B bench/kinematics/report.py "$folder/results.json" "$folder/batch.json"
echo -e "\n### A step of the servo\n"
"$folder/bench_servo" "${BENCH_STEPS:-10000000}"
for by in joints configurations; do
  echo -e "\n### Forward kinematics by the number of $by\n"
  "$folder/bench_kinematics_growth" "$by" | tee "$folder/forward_by_$by.md"
  what="ns a call"
  if [[ $by == configurations ]]; then what=µs; fi
  .venv-bench/bin/python -B bench/draw_growth.py "$by" "$what" \
    "$folder/forward_by_$by.svg" <"$folder/forward_by_$by.md" || status=1
  echo -e "\nDrawn: $folder/forward_by_$by.svg"
done
echo -e "\n### Motions from rest to rest, nanoseconds\n"
"$folder/bench_point_to_point" --benchmark_enable_random_interleaving=true \
  --benchmark_repetitions="${BENCH_REPETITIONS:-9}" --benchmark_min_time=0.05 \
  --benchmark_out="$folder/point_to_point.json" --benchmark_out_format=json >&2 || status=1
python3 -B bench/kinematics/report.py "$folder/results.json" "$folder/point_to_point.json"
echo -e "\n### Time-optimal laws along splines\n"
.venv-bench/bin/python -B bench/motion/retime.py "$folder/bench_retime" || status=1
echo -e "\n### Instructions of a single call (AVX2)\n"
python3 -B bench/kinematics/count.py "$folder/bench_instructions" "$folder/instructions.json" ||
  status=1
echo
python3 -B bench/baseline.py check "$folder/results.json" "$folder/instructions.json" \
  bench/baseline.json || status=1
exit "$status"
