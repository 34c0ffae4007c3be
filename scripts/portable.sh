#!/usr/bin/env bash
# Tries what a new user does in bare Debian systems: the Python module and the demonstration, each with nothing installed,
# then the tests and the page; and compiles with GCC 11, Clang 14, and the newest of both that the system has. Prints a
# line for each.
# Usage: portable.sh [SUITE...]; default: bookworm trixie
set -uo pipefail
cd "$(dirname "$0")/.." || exit
mkdir -p build-bare
(($#)) || set -- bookworm trixie
failed=()

# try SUITE NAME KEEP SCRIPT [ARGUMENT]: runs the script, its $0 the argument.
try() {
  local log="build-bare/$1-${2// /-}.log" begin=$SECONDS result=works
  if ! KEEP=$3 scripts/bare_debian.sh "$1" bash -euo pipefail -c "$4" "${5:-bash}" >"$log" 2>&1; then
    result="fails: $log"
    failed+=("$1: $2")
  fi
  printf '%-10s %-22s %5d s  %s\n' "$1" "$2" $((SECONDS - begin)) "$result"
}

# The packages that the system has: in_suite SUITE PATTERN.
in_suite() { KEEP=1 scripts/bare_debian.sh "$1" bash -c "apt-cache pkgnames | grep -x '$2'" | sort --version-sort; }

# As docs/install.md says.
module='apt-get --quiet --quiet update
  apt-get --quiet --quiet install --yes --no-install-recommends \
    g++ python3-dev python3-venv libhwy-dev libcli11-dev libfast-float-dev >/dev/null
  python3 -m venv /tmp/venv
  /tmp/venv/bin/pip install --quiet .
  /tmp/venv/bin/python -I -m beeline fk rrr --q 0,0,0'
# shellcheck disable=SC2016  # expands inside
compiled='apt-get --quiet --quiet install --yes --no-install-recommends "$0" >/dev/null
  cmake -G Ninja -B "build-$0" -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DBEELINE_TESTS=ON \
    -DCMAKE_CXX_COMPILER="${0/clang/clang++}"
  cmake --build "build-$0" --parallel "$(nproc)"
  "build-$0/beeline" fk rrr --q 0,0,0'

for suite in "$@"; do
  try "$suite" "pip install ." "" "$module"
  try "$suite" "make demo" "" "make demo"
  try "$suite" "make test" 1 "make test"
  try "$suite" "make web" 1 "make web"
  for compiler in g++-11 clang-14 "$(in_suite "$suite" 'g++-[0-9]*' | tail -n 1)" "$(in_suite "$suite" 'clang-[0-9]*' | tail -n 1)"; do
    if [[ -n $(in_suite "$suite" "$compiler") ]]; then
      try "$suite" "$compiler" 1 "$compiled" "$compiler"
    else
      printf '%-10s %-22s          not in this system\n' "$suite" "$compiler"
    fi
  done
done
if ((${#failed[@]})); then
  printf 'fails: %s\n' "${failed[@]}" >&2
  exit 1
fi
