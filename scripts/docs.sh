#!/usr/bin/env bash
# Builds the documentation, FOLDER/html, from docs/, the public headers, the Python module, and the help and the pictures
# of the command. Any warning and any dead link fails. FOLDER/external_links.txt lists the links to other places.
# Usage: docs.sh BUILD FOLDER, a build with the command and the Python module
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(realpath "$1")
folder=$2
python=.venv-docs/bin/python
source=$folder/source
export PYTHONPATH=$build/python

mkdir -p "$source"
rsync --archive --delete --exclude=/cpp --exclude=/python --exclude=/command_line --exclude=/doxygen --exclude=/sessions --exclude=/examples \
  --exclude=__pycache__ docs/ "$source/docs/"
rsync --archive --delete examples tests CHANGELOG.md CONTRIBUTING.md README.md "$source/"
rm -rf "$source"/docs/{doxygen,cpp,python,command_line,sessions,examples} "$folder/html"
mkdir -p "$source/docs/doxygen"
cp docs/sphinx/GALLERY_HEADER.rst "$source/examples/"

{ cat docs/Doxyfile; echo "OUTPUT_DIRECTORY = $source/docs/doxygen"; } | doxygen -
"$python" -B docs/sphinx/cpp_reference.py . "$source/docs/doxygen/xml" "$source/docs/cpp"
"$python" -B docs/sphinx/python_reference.py . "$source/docs/doxygen/xml" "$source/docs/python"
"$python" -B docs/sphinx/command_line.py "$build/beeline" "$source/docs/command_line"
"$python" -B docs/sphinx/sessions.py "$build" "$source/docs" "$source/docs/sessions"
"$python" -B docs/sphinx/embedded_page.py build/web "$folder/html/page.html" "$source/docs/embedded_page.md"

"$python" -B -m sphinx --quiet --fresh-env --fail-on-warning --keep-going "$source/docs" "$folder/html"
"$python" -B docs/sphinx/links.py "$folder/html" >"$folder/external_links.txt"
echo "The documentation: $folder/html/index.html"
