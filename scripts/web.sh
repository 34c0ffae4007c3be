#!/usr/bin/env bash
# Installs Node's packages of web/ and builds the page, with the WebAssembly module of MODULE_FOLDER, into FOLDER.
# Usage: web.sh MODULE_FOLDER FOLDER
set -euo pipefail
cd "$(dirname "$0")/.."

PATH=$(scripts/node_path.sh)
if [[ ! web/package-lock.json -ot web/node_modules/.package-lock.json ]]; then
  (cd web && npm ci --silent)
fi
module=$(realpath "$1") folder=$(realpath --canonicalize-missing "$2")
cd web
npx tsc --noEmit
for mode in production saved; do  # the page; then saved.html, what saved pages are made of
  BEELINE_MODULE=$module npx vite build --mode "$mode" --logLevel warn --outDir "$folder.new"
done
rm -rf "$folder"
mv "$folder.new" "$folder"
echo "The page: $2/index.html (browsers open it from a server: beeline view, or python3 -m http.server)"
find "$folder" -type f -printf '%P\n' | sort | while read -r file; do
  printf '%-44s %8d bytes, %8d compressed\n' "$file" "$(wc -c <"$folder/$file")" "$(gzip -9 -c "$folder/$file" | wc -c)"
done
