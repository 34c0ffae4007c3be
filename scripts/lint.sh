#!/usr/bin/env bash
# Formatting, the house's rules and static analysis. All of them run before it says no.
# Usage: lint.sh BUILD, a configured build folder with compile_commands.json
set -uo pipefail
cd "$(dirname "$0")/.." || exit
build=$1
status=0

scripts/sources.sh | xargs clang-format-14 --dry-run -Werror || status=1
shellcheck scripts/*.sh .ci/run || status=1
python3 -B tests/layers.py || status=1

# A file that nobody can take in at once is two files.
long=$(find Makefile CMakeLists.txt cmake scripts beeline bench cli examples tests -type f \
         \( -name 'Makefile' -o -name '*.txt' -o -name '*.cmake' -o -name '*.h' -o -name '*.cpp' \
            -o -name '*.py' -o -name '*.sh' \) -exec awk 'ENDFILE {
              if (FNR > 300) print FILENAME ": " FNR " lines; 300 is the most" }' {} +)
if [[ -n $long ]]; then
  echo "$long" >&2
  status=1
fi

python3 -B scripts/tidy.py "$build" || status=1
exit "$status"
