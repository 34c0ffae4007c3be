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

# Ruckig is measured from C++, which only its source package has.
ruckig=$(grep '^ruckig==' tests/peers/requirements.txt)
sources=.venv-bench/${ruckig/==/-}
if [[ ! -d $sources ]]; then
  if .venv-bench/bin/python -m pip download --quiet --disable-pip-version-check --no-deps \
    --no-binary :all: --dest .venv-bench "$ruckig" >&2; then
    tar -xzf "$sources.tar.gz" -C .venv-bench
  else
    echo "Left out: the sources of $ruckig cannot be had here" >&2
  fi
fi
