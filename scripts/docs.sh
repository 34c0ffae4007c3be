#!/usr/bin/env bash
# Builds the documentation, FOLDER/html, from docs/, the public headers, and the help and the pictures of the command.
# Any warning and any dead link fails. FOLDER/external_links.txt lists the links to other places.
# Usage: docs.sh BEELINE FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."
beeline=$(realpath "$1")
folder=$2
python=.venv-docs/bin/python
source=$folder/source

mkdir -p "$source"
rsync --archive --delete --exclude=/cpp --exclude=/command_line --exclude=/doxygen --exclude=/sessions \
  --exclude=__pycache__ docs/ "$source/docs/"
rsync --archive --delete examples CHANGELOG.md "$source/"
mkdir -p "$source/docs/doxygen"

{ cat docs/Doxyfile; echo "OUTPUT_DIRECTORY = $source/docs/doxygen"; } | doxygen -
"$python" -B docs/sphinx/cpp_reference.py . "$source/docs/doxygen/xml" "$source/docs/cpp"
"$python" -B docs/sphinx/command_line.py "$beeline" "$source/docs/command_line"
"$python" -B docs/sphinx/sessions.py "$(dirname "$beeline")" "$source/docs" "$source/docs/sessions"

"$python" -B -m sphinx --quiet --fail-on-warning --keep-going "$source/docs" "$folder/html"
"$python" -B docs/sphinx/links.py "$folder/html" >"$folder/external_links.txt"
echo "The documentation: $folder/html/index.html"
