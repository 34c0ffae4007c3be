#!/usr/bin/env bash
# Builds and runs, with half of the cases, the tests whose results have reasons, except the tests of the sentences themselves.
# Usage: test_reasons.sh BUILD JOBS, a folder configured with BEELINE_SENTENCES=OFF
set -euo pipefail
build=$1 jobs=$2
names=(certificate control doctor house inverse kinematics planning reach reason timing trajectory)
cmake --build "$build" --parallel "$jobs" --target "${names[@]/%/_test}"
pattern=$(printf '|%s' "${names[@]}")
GTEST_FILTER='-Sentence.*' BEELINE_CASES=0.5 ctest --test-dir "$build" --parallel "$jobs" --tests-regex "^(${pattern:1})\$" \
  --output-on-failure
