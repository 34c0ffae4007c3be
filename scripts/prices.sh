#!/usr/bin/env bash
# What Beeline costs: its public headers, lines by folder, and the bytes of the page's modules and of the wheel where they
# are built. `.ci/run` prints the times.
# Usage: prices.sh
set -euo pipefail
cd "$(dirname "$0")/.."

lines() { find "$1" -type f \( -name '*.h' -o -name '*.cpp' -o -name '*.py' -o -name '*.ts' \) -print0 | xargs -0 cat | wc -l; }

echo "public headers: $(grep -c '^#include' beeline/beeline.h)"
for folder in beeline/*/ cli/ mpi/ python/ web/src/ web/core/; do
  printf 'lines of %-20s %6d\n' "$folder" "$(lines "$folder")"
done
printf 'lines of %-20s %6d\n' tests/ "$(($(lines tests/) + $(lines web/tests/)))" bench/ "$(lines bench/)" examples/ "$(lines examples/)"
find build-web-core/web -name '*.wasm' -printf 'bytes of %f: %s\n' 2>/dev/null | sort || true
find build-wheel/dist -maxdepth 1 -name '*.whl' -printf 'bytes of %f: %s\n' 2>/dev/null || true
