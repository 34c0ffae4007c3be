#!/usr/bin/env bash
# Makes a virtual environment with the packages of a requirements file. Does nothing when it is there
# already.
# Usage: venv.sh FOLDER REQUIREMENTS, such as .venv tests/peers/requirements.txt
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$1
requirements=$2

# One at a time, as steps that run beside each other use the same one; this file is the lock.
if command -v flock >/dev/null; then
  exec 9<scripts/venv.sh
  flock 9
fi
stamp=$folder/requirements.txt
if [[ -x $folder/bin/python ]] && cmp --silent "$requirements" "$stamp"; then exit 0; fi

# A python3 of one's own may stand first in the path without the modules that it takes.
for python in python3 /usr/bin/python3; do
  if "$python" -c 'import ensurepip, venv' 2>/dev/null; then break; fi
done

echo "Making $folder with $("$python" --version)"
rm -rf "$folder"
"$python" -m venv "$folder"
"$folder/bin/python" -m pip install --quiet --disable-pip-version-check -r "$requirements"
cp "$requirements" "$stamp"
