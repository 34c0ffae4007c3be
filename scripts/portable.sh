#!/usr/bin/env bash
# What a new user does, on each Debian, with nothing installed: the demonstration, the tests, the Python module, the page.
# Then compiles the command by the oldest and newest GCC and Clang that Beeline is for. Prints a line for each.
# Usage: portable.sh [SUITE...]; default: bookworm trixie
set -uo pipefail
cd "$(dirname "$0")/.." || exit
mkdir -p build-bare
(($#)) || set -- bookworm trixie
failed=()

# try SUITE NAME KEEP SCRIPT
try() {
  local log="build-bare/$1-${2// /-}.log" begin=$SECONDS result=works
  KEEP=$3 scripts/bare_debian.sh "$1" bash -euo pipefail -c "$4" >"$log" 2>&1 || { result="fails: $log" && failed+=("$1: $2"); }
  printf '%-10s %-22s %5d s  %s\n' "$1" "$2" $((SECONDS - begin)) "$result"
}

# The compilers of a suite besides the one that `make` takes.
compilers() {
  local newest='sort --version-sort | tail -n 1'
  echo g++-11 clang-14
  KEEP=1 scripts/bare_debian.sh "$1" bash -c "apt-cache pkgnames | grep -x 'g++-[0-9]*' | $newest; apt-cache pkgnames | grep -x 'clang-[0-9]*' | $newest"
}

# shellcheck disable=SC2016  # expands inside
compiled='apt-get --quiet --quiet install --yes --no-install-recommends $0 >/dev/null || exit
  cmake -G Ninja -B build-$0 -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DBEELINE_TESTS=ON -DCMAKE_CXX_COMPILER=${0/clang/clang++}
  cmake --build build-$0 --parallel $(nproc)
  build-$0/beeline fk rrr --q 0,0,0'

# As docs/install.md says.
module='apt-get --quiet --quiet update
  apt-get --quiet --quiet install --yes --no-install-recommends g++ python3-dev python3-venv libhwy-dev libcli11-dev libfast-float-dev >/dev/null
  python3 -m venv /tmp/venv
  /tmp/venv/bin/pip install --quiet .
  /tmp/venv/bin/python -I -m beeline fk rrr --q 0,0,0'

for suite in "$@"; do
  try "$suite" "pip install ." "" "$module"
  try "$suite" "make demo" "" "make demo"
  try "$suite" "make test" 1 "make test"
  try "$suite" "make web" 1 "make web"
  for compiler in $(compilers "$suite" | tr ' ' '\n' | sort -u); do
    if KEEP=1 scripts/bare_debian.sh "$suite" apt-cache show "$compiler" >/dev/null 2>&1; then
      try "$suite" "$compiler" 1 "${compiled//\$0/$compiler}"
    fi
  done
done
if ((${#failed[@]})); then
  printf 'fails: %s\n' "${failed[@]}" >&2
  exit 1
fi
