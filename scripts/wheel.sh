#!/usr/bin/env bash
# Builds the wheel, FOLDER/*.whl, with the libraries that it needs in it, and tries it in a fresh environment of each
# Python from 3.10 on that is installed.
# Usage: wheel.sh FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$1
bin=$PWD/.venv-wheel/bin

scripts/venv.sh .venv-wheel python/requirements.txt
rm -rf "$folder/linux" "$folder"/*.whl
"$bin/python" -m pip wheel --quiet --no-deps --no-build-isolation --wheel-dir "$folder/linux" \
  --config-settings=cmake.define.BEELINE_SHIP_LIBRARIES=OFF .
site=$("$bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
PATH=$bin:$PATH LD_LIBRARY_PATH=.venv-wheel/lib:$site/cmeel.prefix/lib "$bin/auditwheel" repair --strip --wheel-dir "$folder" "$folder"/linux/*.whl
wheel=$(echo "$folder"/*.whl)
"$bin/auditwheel" show "$wheel"
ls -l "$wheel"
