#!/usr/bin/env bash
# Runs each fuzz target for some minutes from the stored corpus, some at a time, and prints a line for each.
# New inputs stay in BUILD/corpus, what fails in BUILD/crashes: move that to tests/fuzz/corpus/TARGET once it is mended.
# Usage: fuzz.sh BUILD MINUTES JOBS
set -euo pipefail
build=$1 minutes=$2 jobs=$3
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$build" && pwd)

fuzz() {
  local name=${1##*/fuzz_} log
  log=$build/crashes/$name.log
  mkdir -p "$build/corpus/$name"
  "$1" -max_total_time="$(awk "BEGIN { print int(60 * $minutes) }")" -timeout=60 -report_slow_units=60 -rss_limit_mb=2048 -malloc_limit_mb=1024 -max_len=4096 -print_final_stats=1 \
    -artifact_prefix="$build/crashes/$name-" "$build/corpus/$name" "$root/tests/fuzz/corpus/$name" >"$log" 2>&1 || echo "$name" >>"$build/crashes/failed"
  local runs coverage
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -1)
  coverage=$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' "$log" | tail -1)
  echo "$name: ${runs:-?} executions, ${coverage:-?} edges covered, $(find "$build/crashes" -name "$name-*" | wc -l) findings"
}
export -f fuzz
export build root minutes

mkdir -p "$build/crashes"
rm -f "$build/crashes/failed"
find "$build" -type f -name 'fuzz_*' -perm -u+x -print0 | sort -z | xargs -0 -P "$jobs" -I{} bash -c 'fuzz {}'
if [[ -f $build/crashes/failed ]]; then
  echo "Findings in $build/crashes: $(sort -u "$build/crashes/failed" | tr '\n' ' ')" >&2
  exit 1
fi
