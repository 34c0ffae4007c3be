#!/usr/bin/env bash
# Makes the virtual environment .venv with the packages that tests/peers compares with. Does nothing
# when it is there already.
set -euo pipefail
cd "$(dirname "$0")/.."

stamp=.venv/requirements.txt
if [[ -x .venv/bin/python ]] && cmp --silent tests/peers/requirements.txt "$stamp"; then exit 0; fi

# A python3 of one's own may stand first in the path without the modules that it takes.
for python in python3 /usr/bin/python3; do
  if "$python" -c 'import ensurepip, venv' 2>/dev/null; then break; fi
done

echo "Making .venv with $("$python" --version)"
rm -rf .venv
"$python" -m venv .venv
.venv/bin/python -m pip install --quiet --disable-pip-version-check -r tests/peers/requirements.txt
cp tests/peers/requirements.txt "$stamp"
