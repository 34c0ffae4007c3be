#!/usr/bin/env bash
# Formatting and the project's rules; with a build folder also the public headers alone, and static analysis. All of them
# run before it says no, and each says how long it took.
# Usage: lint.sh [BUILD], a configured build folder with compile_commands.json
set -uo pipefail
cd "$(dirname "$0")/.." || exit
build=${1:-}
PATH=$PWD/.venv-lint/bin:$PATH  # clang-format and clang-tidy of scripts/lint_requirements.txt
. scripts/steps.sh

formatting() { scripts/sources.sh | xargs clang-format --dry-run -Werror; }
generated() { cmake --build "$build" --target header_texts; }

step "formatting" formatting
step "scripts" shellcheck scripts/*.sh packaging/*.sh .ci/run
step "layers" python3 -B tests/layers.py
step "lengths" python3 -B scripts/lengths.py
step "words" python3 -B scripts/words.py
if [[ -n $build ]]; then
  step "public headers alone" python3 -B scripts/headers.py "$build"
  step "generated sources" generated
  step "clang-tidy" python3 -B scripts/tidy.py "$build"
fi

refuse_failed lint
