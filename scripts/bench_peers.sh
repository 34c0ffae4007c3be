#!/usr/bin/env bash
# Makes .venv-bench with the peers of the benchmarks that PyPI has; one that cannot be had is left out
# and said to be.
set -euo pipefail
cd "$(dirname "$0")/.."

stamp=.venv-bench/requirements.txt
if ! cmp --silent bench/requirements.txt "$stamp"; then
  # A python3 of one's own may stand first in the path without the modules that it takes.
  for python in python3 /usr/bin/python3; do
    if "$python" -c 'import ensurepip, venv' 2>/dev/null; then break; fi
  done
  echo "Making .venv-bench with $("$python" --version)" >&2
  rm -rf .venv-bench
  "$python" -m venv .venv-bench
  while read -r peer; do
    .venv-bench/bin/python -m pip install --quiet --disable-pip-version-check "$peer" >&2 ||
      echo "Left out: $peer cannot be installed here" >&2
  done < <(grep -v '^#' bench/requirements.txt)
  cp bench/requirements.txt "$stamp"
fi
