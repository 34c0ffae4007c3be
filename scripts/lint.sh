#!/usr/bin/env bash
# Formatting and the project's rules; with a build folder also the public headers alone, and static analysis. All of them
# run before it says no, and each says how long it took.
# Usage: lint.sh [BUILD], a configured build folder with compile_commands.json
set -uo pipefail
cd "$(dirname "$0")/.." || exit
build=${1:-}
PATH=$PWD/.venv-lint/bin:$PATH  # clang-format and clang-tidy of scripts/lint_requirements.txt
failed=()

check() {  # NAME COMMAND...
  local name=$1 begin=$SECONDS
  shift
  "$@" || failed+=("$name")
  echo "$name: $((SECONDS - begin)) s"
}

formatting() { scripts/sources.sh | xargs clang-format --dry-run -Werror; }
headers() { cmake --build "$build" --target all_verify_interface_header_sets; }

check "formatting" formatting
check "scripts" shellcheck scripts/*.sh .ci/run
check "layers" python3 -B tests/layers.py
check "lengths" python3 -B scripts/lengths.py
check "words" python3 -B scripts/words.py
if [[ -n $build ]]; then
  check "headers alone" headers
  check "clang-tidy" python3 -B scripts/tidy.py "$build"
fi

if ((${#failed[@]})); then
  printf 'lint failed: %s\n' "${failed[*]}" >&2
  exit 1
fi
