#!/usr/bin/env bash
# Builds the wheel, FOLDER/*.whl, with the libraries that it needs inside, and tries it in a fresh environment of each
# Python from 3.10 on that is installed.
# Usage: wheel.sh FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$1
max_bytes=6000000
if [[ ! -f build/web/saved.html ]]; then
  echo "$0: the wheel carries the page: make web" >&2
  exit 1
fi

scripts/venv.sh .venv-wheel python/requirements.txt
python=.venv-wheel/bin/python
rm -rf "$folder"
"$python" -m pip wheel --quiet --no-deps --no-build-isolation --wheel-dir "$folder/unrepaired" \
  --config-settings=cmake.define.BEELINE_SHIP_LIBRARIES=OFF .
site=$("$python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
PATH=$PWD/.venv-wheel/bin:$PATH LD_LIBRARY_PATH=$PWD/.venv-wheel/lib:$site/cmeel.prefix/lib \
  "$python" -m auditwheel repair --strip --wheel-dir "$folder" "$folder"/unrepaired/*.whl
wheel=$(echo "$folder"/*.whl)
policy=$("$python" -c 'import sys; print(*sorted(sys.argv[1].split("-")[-1][:-4].split(".")))' "$wheel")
bytes=$(stat --format=%s "$wheel")
echo "The wheel: $wheel, $bytes bytes, for $policy"
if ((bytes > max_bytes)); then
  echo "$0: more than $max_bytes bytes" >&2
  exit 1
fi
if ! [[ $policy =~ manylinux_2_([0-9]+)_ ]] || ((BASH_REMATCH[1] > 34)); then
  echo "$0: it needs a glibc newer than 2.34" >&2
  exit 1
fi

tried=" "
for candidate in "$HOME"/.pyenv/versions/3.1[0-9]*/bin/python /usr/bin/python3 python3.1{0..5} python3; do
  "$candidate" -c 'import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 10))' 2>/dev/null || continue
  version=$("$candidate" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
  if [[ $tried == *" $version "* ]]; then continue; fi
  tried+="$version "
  fresh=$(mktemp --directory)
  "$candidate" -m venv "$fresh/venv"
  "$fresh/venv/bin/python" -m pip install --quiet --disable-pip-version-check "$wheel"
  (cd "$fresh" && venv/bin/python -I "$OLDPWD/tests/python/wheel.py")
  rm -rf "$fresh"
done
if [[ $tried == " " ]]; then
  echo "$0: no Python from 3.10 on to try it with" >&2
  exit 1
fi
echo "Tried with Python$tried"
